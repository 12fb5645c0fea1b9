//! [`Boundary`]: the segments around a polygon, so kept that it is soon said what is inside, what is near, and what hides what: in a tree; and bins tell how far the nearest are.

use glam::DVec2;

use super::grid::{GRID, snap};
use super::segment_tree::SegmentTree;
use crate::predicates::is_left_turn;

/// A boundary of straight segments in a domain [0, size]; the inside is on their left.
#[derive(Debug)]
pub(crate) struct Boundary {
    segments: Vec<[DVec2; 2]>,
    /// The part of the inside on each segment's left, and the parts' areas.
    parts: Vec<u32>,
    part_areas: Vec<f64>,
    /// The area inside.
    pub area: f64,
    /// Places nearer to the boundary than this cannot be told from those on it.
    tolerance: f64,
    n_bins: [usize; 2],
    /// Bins to a unit along each axis.
    resolution: DVec2,
    /// The shorter side of a bin.
    side: f64,
    tree: SegmentTree,
    bins: Vec<Bin>,
}

/// What is known of a bin.
#[derive(Debug, Clone, Copy)]
struct Bin {
    /// How many bins away the nearest is, along rows, columns and diagonals, that segments reach.
    clearance: u16,
    /// Whether it lies inside; where no segment reaches it.
    is_inside: bool,
}

/// Where a way first meets the boundary.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Meeting {
    /// The part of the way until there.
    pub part: f64,
    pub segment: [DVec2; 2],
}

/// Bins a segment, and the fewest and the most of them.
const BINS: usize = 4;
const FEWEST_BINS: usize = 1 << 14;
const MOST_BINS: usize = 1 << 22;
/// The largest clearance that is told.
const FAR: u16 = u16::MAX;
/// Directions in which the inside is looked for.
const DIRECTIONS: u32 = 16;
/// By so much it is looked for farther away each time, and so often.
const FARTHER: f64 = 4.0;
const TRIES: i32 = 40;

impl Boundary {
    /// Segments that do not cross, each with the part of the inside on its left, in a domain of this size, around parts of these areas. Places nearer to them than `tolerance` count as on the boundary.
    pub fn new(segments: Vec<[DVec2; 2]>, parts: Vec<u32>, part_areas: Vec<f64>, size: DVec2, tolerance: f64) -> Self {
        let wanted = (BINS * segments.len()).clamp(FEWEST_BINS, MOST_BINS) as f64;
        let square = (size.x * size.y / wanted).sqrt();
        let n_bins = (size / square).round().clamp(DVec2::ONE, DVec2::splat(wanted)).to_array().map(|n| n as usize);
        let resolution = DVec2::new(n_bins[0] as f64, n_bins[1] as f64) / size;
        let mut boundary = Self {
            area: part_areas.iter().sum(),
            parts,
            part_areas,
            tolerance: tolerance.max(4.0 * GRID),
            n_bins,
            resolution,
            side: (1.0 / resolution).min_element(),
            tree: SegmentTree::new(&segments),
            bins: vec![Bin { clearance: FAR, is_inside: false }; n_bins[0] * n_bins[1]],
            segments,
        };
        boundary.mark_bins();
        boundary.find_clearances();
        boundary.find_inside();
        boundary
    }

    /// Marks the bins that segments reach.
    fn mark_bins(&mut self) {
        let mut bins = std::mem::take(&mut self.bins);
        for segment in &self.segments {
            for row in self.rows(segment) {
                let columns = self.columns_in(row, segment);
                let first = row * self.n_bins[0];
                bins[first + columns.start()..=first + columns.end()].iter_mut().for_each(|bin| bin.clearance = 0);
            }
        }
        self.bins = bins;
    }

    fn find_clearances(&mut self) {
        let [n_columns, n_rows] = self.n_bins;
        // Forth with the neighbours before each bin, and back with those after it.
        let mut pass = |is_back: bool| {
            for k in 0..n_columns * n_rows {
                let (column, row) =
                    if is_back { (n_columns - 1 - k % n_columns, n_rows - 1 - k / n_columns) } else { (k % n_columns, k / n_columns) };
                let at = |dx: i64, dy: i64| {
                    let (x, y) = if is_back { (column as i64 - dx, row as i64 - dy) } else { (column as i64 + dx, row as i64 + dy) };
                    let is_there = (0..n_columns as i64).contains(&x) && (0..n_rows as i64).contains(&y);
                    is_there.then(|| x as usize + y as usize * n_columns)
                };
                let near = [(-1, 0), (-1, -1), (0, -1), (1, -1)].into_iter().filter_map(|(dx, dy)| at(dx, dy));
                let least = near.map(|bin| self.bins[bin].clearance).min().unwrap_or(FAR);
                let own = &mut self.bins[column + row * n_columns].clearance;
                *own = (*own).min(least.saturating_add(1));
            }
        };
        pass(false);
        pass(true);
    }

    fn find_inside(&mut self) {
        let [n_columns, n_rows] = self.n_bins;
        for row in 0..n_rows {
            let mut before = None;
            for column in 0..n_columns {
                let bin = column + row * n_columns;
                if self.bins[bin].clearance == 0 {
                    before = None;
                    continue;
                }
                let centre = snap((DVec2::new(column as f64, row as f64) + 0.5) / self.resolution);
                self.bins[bin].is_inside = *before.get_or_insert_with(|| self.has_odd_crossings(centre, f64::INFINITY));
            }
        }
    }

    /// The rows that a segment reaches.
    fn rows(&self, [a, b]: &[DVec2; 2]) -> std::ops::RangeInclusive<usize> {
        self.row(a.y.min(b.y) - self.tolerance)..=self.row(a.y.max(b.y) + self.tolerance)
    }

    /// The columns that a segment reaches in a row.
    fn columns_in(&self, row: usize, &[a, b]: &[DVec2; 2]) -> std::ops::RangeInclusive<usize> {
        let rise = b.y - a.y;
        let height = 1.0 / self.resolution.y;
        let x_at = |y: f64| if rise == 0.0 { a.x } else { a.x + (b.x - a.x) * ((y - a.y) / rise).clamp(0.0, 1.0) };
        let ends = [x_at(row as f64 * height - self.tolerance), x_at((row + 1) as f64 * height + self.tolerance)];
        let ends = if rise.abs() <= 2.0 * self.tolerance { [a.x, b.x] } else { ends };
        self.column(ends[0].min(ends[1]) - self.tolerance)..=self.column(ends[0].max(ends[1]) + self.tolerance)
    }

    fn column(&self, x: f64) -> usize {
        ((x * self.resolution.x).max(0.0) as usize).min(self.n_bins[0] - 1)
    }

    fn row(&self, y: f64) -> usize {
        ((y * self.resolution.y).max(0.0) as usize).min(self.n_bins[1] - 1)
    }

    fn bin(&self, p: DVec2) -> usize {
        self.column(p.x) + self.row(p.y) * self.n_bins[0]
    }

    /// Whether a place in a bin that segments reach lies inside. Exact.
    fn is_enclosed(&self, p: DVec2) -> bool {
        // As the next place on its right of which that is known, if an even number of segments lies in between.
        let first = self.row(p.y) * self.n_bins[0];
        let known = (self.column(p.x) + 1..self.n_bins[0]).find(|column| self.bins[first + column].clearance > 0);
        match known {
            Some(column) => {
                let end = snap(DVec2::new((column as f64 + 0.5) / self.resolution.x, p.y));
                self.has_odd_crossings(p, end.x) != self.bins[first + column].is_inside
            }
            None => self.has_odd_crossings(p, f64::INFINITY),
        }
    }

    /// Whether an odd number of segments crosses the line that goes to the right from a place to the x of
    /// its end. Exact.
    fn has_odd_crossings(&self, p: DVec2, end: f64) -> bool {
        let mut is_odd = false;
        let to = DVec2::new(end, p.y);
        let is_left_of = |p: DVec2, a: DVec2, b: DVec2| p.x < f64::INFINITY && is_left_turn(b - a, p - a);
        let may_hold = |low: DVec2, high: DVec2| low.y <= p.y && p.y < high.y && p.x <= high.x && low.x <= end;
        self.tree.find(may_hold, |[a, b], _| {
            let [low, high] = if a.y < b.y { [a, b] } else { [b, a] };
            if low.y <= p.y && p.y < high.y {
                is_odd ^= is_left_of(p, low, high) != is_left_of(to, low, high);
            }
            false
        });
        is_odd
    }

    /// Whether a place on the grid lies inside. Exact, but on the boundary itself.
    pub fn contains(&self, p: DVec2) -> bool {
        let bin = self.bins[self.bin(p)];
        if bin.clearance > 0 { bin.is_inside } else { self.is_enclosed(p) }
    }

    /// Whether a place lies inside or on the boundary, as far as that can be told.
    pub fn holds(&self, p: DVec2) -> bool {
        self.contains(p) || self.is_on(p, self.tolerance)
    }

    /// Whether a place is nearer to the boundary than this.
    fn is_on(&self, p: DVec2, distance: f64) -> bool {
        self.clearance(p) <= distance && self.any_in(p - distance, p + distance, |segment| distance_to(p, segment) <= distance)
    }

    /// Whether one of the segments near a box is what is looked for.
    fn any_in(&self, low: DVec2, high: DVec2, mut is_it: impl FnMut([DVec2; 2]) -> bool) -> bool {
        self.tree.find(|a, b| a.cmple(high).all() && b.cmpge(low).all(), |segment, _| is_it(segment))
    }

    /// A place inside, clear of the boundary, next to `p`, which is held; or itself, if there is none.
    pub fn inside(&self, p: DVec2) -> DVec2 {
        let is_good = |p: DVec2, margin: f64| self.contains(p) && !self.is_on(p, margin);
        if is_good(p, self.tolerance) {
            return p;
        }
        let directions = (0..DIRECTIONS).map(|k| DVec2::from_angle(std::f64::consts::TAU * (f64::from(k) + 0.3) / f64::from(DIRECTIONS)));
        let mut found = (0..TRIES).flat_map(|k| {
            let step = 4.0 * self.tolerance * FARTHER.powi(k);
            directions.clone().map(move |direction| (step, snap(p + step * direction)))
        });
        let found = found.find(|&(step, q)| is_good(q, 0.25 * step) && self.sees(p, q));
        found.map_or(p, |(_, q)| q)
    }

    /// No segment is nearer than this to a place.
    #[inline]
    pub fn clearance(&self, p: DVec2) -> f64 {
        let bins = self.bins[self.bin(p)].clearance;
        f64::from(bins.saturating_sub(1)) * self.side
    }

    /// Leaves the segments whose boxes meet a box.
    pub fn find_near(&self, low: DVec2, high: DVec2, found: &mut Vec<u32>) {
        found.clear();
        let meets = |a: DVec2, b: DVec2| a.cmple(high).all() && b.cmpge(low).all();
        self.tree.find(meets, |[a, b], number| {
            if meets(a.min(b), a.max(b)) {
                found.push(number);
            }
            false
        });
    }

    /// Whether the box of a segment meets a box.
    pub fn is_near(&self, low: DVec2, high: DVec2) -> bool {
        self.any_in(low, high, |[a, b]| a.min(b).cmple(high).all() && a.max(b).cmpge(low).all())
    }

    /// Whether all of a box lies outside.
    pub fn is_outside(&self, low: DVec2, high: DVec2) -> bool {
        !self.contains(snap(0.5 * (low + high))) && !self.reaches(low, high)
    }

    /// Whether a segment has a place in a box.
    pub fn reaches(&self, low: DVec2, high: DVec2) -> bool {
        let (centre, half) = (0.5 * (low + high), 0.5 * (high - low));
        self.clearance(centre) <= half.length() && self.any_in(low, high, |segment| reaches_box(segment, centre, half))
    }

    /// The length of all segments.
    pub fn length(&self) -> f64 {
        self.segments.iter().map(|[a, b]| a.distance(*b)).sum()
    }

    /// How many parts the inside has, which nowhere hang together.
    pub fn n_parts(&self) -> usize {
        self.part_areas.len()
    }

    /// The area of each part.
    pub fn part_areas(&self) -> &[f64] {
        &self.part_areas
    }

    /// The part on the left of a segment.
    pub fn part_at(&self, segment: usize) -> usize {
        self.parts[segment] as usize
    }

    /// The part in which a place inside lies: that of the first segment on its right.
    pub fn part_of(&self, p: DVec2) -> usize {
        let mut first = (f64::INFINITY, 0);
        let may_hold = |low: DVec2, high: DVec2| low.y <= p.y && p.y < high.y && p.x <= high.x;
        self.tree.find(may_hold, |[a, b], number| {
            // The inside is on the left, so what goes up bounds it on the right.
            if a.y <= p.y && p.y < b.y {
                let x = a.x + (b.x - a.x) * ((p.y - a.y) / (b.y - a.y));
                if x >= p.x - self.tolerance && x < first.0 {
                    first = (x, number);
                }
            }
            false
        });
        self.parts.get(first.1 as usize).map_or(0, |&part| part as usize)
    }

    /// All segments.
    pub fn segments(&self) -> &[[DVec2; 2]] {
        &self.segments
    }

    pub fn segment(&self, k: u32) -> [DVec2; 2] {
        self.segments[k as usize]
    }

    /// The first meeting of the way from `from` to `to` with a segment that it crosses from the inside.
    pub fn first_meeting(&self, from: DVec2, to: DVec2) -> Option<Meeting> {
        let mut first: Option<Meeting> = None;
        self.meets_any(from, to, |part, segment| {
            if first.is_none_or(|first| part < first.part) {
                first = Some(Meeting { part, segment });
            }
            false
        });
        first
    }

    /// Whether one of the segments that a way crosses from the inside, after so much of it, is what is looked for.
    #[inline]
    fn meets_any(&self, from: DVec2, to: DVec2, mut is_it: impl FnMut(f64, [DVec2; 2]) -> bool) -> bool {
        let way = to - from;
        if self.clearance(from) > way.length() {
            return false;
        }
        let (middle, half) = (0.5 * (from + to), 0.5 * way);
        let size = half.abs();
        let may_hold = |low: DVec2, high: DVec2| {
            // The separating axes of the way and a box.
            let (apart, extent) = (0.5 * (low + high) - middle, 0.5 * (high - low));
            apart.abs().cmple(extent + size).all() && apart.perp_dot(half).abs() <= extent.x * size.y + extent.y * size.x
        };
        self.tree.find(may_hold, |segment, _| meets(from, way, segment).is_some_and(|part| is_it(part, segment)))
    }

    /// Whether no segment stands between two places inside.
    pub fn sees(&self, a: DVec2, b: DVec2) -> bool {
        !self.meets_any(a, b, |_, _| true)
    }

    /// Whether no segment stands between a place inside and any place of a triangle that has none in it.
    pub fn sees_all(&self, from: DVec2, corners: [DVec2; 3]) -> bool {
        // What stands in between crosses the way to a corner, or begins in between.
        let (low, high) = corners.iter().fold((from, from), |(low, high), &corner| (low.min(corner), high.max(corner)));
        let [a, b, c] = corners;
        let is_between = |p: DVec2| [[a, b], [b, c], [c, a]].into_iter().any(|[a, b]| is_in_triangle(p, [from, a, b]));
        corners.iter().all(|&corner| self.sees(from, corner)) && !self.any_in(low, high, |[start, _]| is_between(start))
    }

    /// Where a point inside comes to that is to go to `to`: there, or along the segment that stands in its way, or up to it.
    pub fn land(&self, from: DVec2, to: DVec2) -> DVec2 {
        let Some(Meeting { part, segment: [a, b] }) = self.first_meeting(from, to) else {
            return if self.contains(to) { to } else { from };
        };
        let is_good = |q: DVec2| self.contains(q) && self.sees(from, q);
        let along = b - a;
        let foot = a + along * ((to - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        let inwards = along.perp().normalize_or_zero();
        let short = from + (part - 1e-9).max(0.0) * (to - from);
        let places = [foot + 64.0 * self.tolerance * inwards, short, from + 0.9 * (short - from)];
        places.into_iter().map(snap).find(|&q| is_good(q)).unwrap_or(from)
    }
}

/// The part of a way after which it crosses a segment from its left to its right, or touches it there. Ends of segments count as part of them.
fn meets(from: DVec2, way: DVec2, [a, b]: [DVec2; 2]) -> Option<f64> {
    let along = b - a;
    let against = along.perp_dot(way);
    // From left to right the cross product is negative.
    if against >= 0.0 {
        return None;
    }
    let to_start = a - from;
    let [part, place] = [along, way].map(|side| side.perp_dot(to_start) / against);
    ((0.0..=1.0).contains(&part) && (0.0..=1.0).contains(&place)).then_some(part)
}

/// Whether a place lies in a triangle, whichever way that runs.
fn is_in_triangle(p: DVec2, [a, b, c]: [DVec2; 3]) -> bool {
    let turns = [(b - a).perp_dot(p - a), (c - b).perp_dot(p - b), (a - c).perp_dot(p - c)];
    turns.iter().all(|&turn| turn >= 0.0) || turns.iter().all(|&turn| turn <= 0.0)
}

/// Whether a segment has a place in a box.
fn reaches_box([a, b]: [DVec2; 2], centre: DVec2, half: DVec2) -> bool {
    let (middle, way) = (0.5 * (a + b) - centre, 0.5 * (b - a));
    let (x, y) = (half.x + way.x.abs(), half.y + way.y.abs());
    middle.x.abs() <= x && middle.y.abs() <= y && middle.perp_dot(way).abs() <= half.x * way.y.abs() + half.y * way.x.abs()
}

fn distance_to(p: DVec2, [a, b]: [DVec2; 2]) -> f64 {
    let along = b - a;
    let part = ((p - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    p.distance(a + part * along)
}

#[cfg(test)]
mod tests {
    use crate::points::Random;
    use crate::space::snap;
    use crate::{Polygon, Space};
    use glam::DVec2;

    #[test]
    fn a_place_among_many_holes_is_inside_as_often_as_rings_are_crossed() {
        let mut rings = vec![vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]];
        let mut random = Random::new(1, 2);
        for k in 0..900 {
            let centre = [f64::from(k % 30), f64::from(k / 30)].map(|x| (x + 0.5) / 30.0);
            let turn = random.unit();
            let corner =
                |j: u32| DVec2::from_array(centre) + 0.015 * DVec2::from_angle(std::f64::consts::TAU * (turn + f64::from(j) / 3.0));
            rings.push((0..3).map(|j| corner(j).to_array()).collect());
        }
        let polygon = Polygon::from_rings(rings).unwrap();
        let domain = Space::from(&polygon).domain();
        let boundary = domain.boundary.as_ref().unwrap();
        for _ in 0..20_000 {
            let p = snap(DVec2::new(random.unit(), random.unit()) * domain.size);
            let crossed = boundary.segments().iter().filter(|[a, b]| {
                let [low, high] = if a.y < b.y { [a, b] } else { [b, a] };
                low.y <= p.y && p.y < high.y && (high - low).perp_dot(p - low) > 0.0
            });
            assert_eq!(boundary.contains(p), crossed.count() % 2 == 1, "{p}");
        }
    }
}
