//! [`Border`]: the segments around a polygon, in bins, so that it is soon said what is inside, what is near, and what hides what.

use glam::DVec2;

use super::grid::{GRID, snap};
use crate::predicates::is_left_turn;

/// A border of straight segments in a domain [0, size]; the inside is on their left.
#[derive(Debug)]
pub(crate) struct Border {
    segments: Vec<[DVec2; 2]>,
    /// The area inside.
    pub area: f64,
    /// Places nearer to the border than this cannot be told from those on it.
    tolerance: f64,
    n_bins: [usize; 2],
    /// Bins to a unit along each axis.
    resolution: DVec2,
    /// The shorter side of a bin.
    side: f64,
    by_bin: Lists,
    by_row: Lists,
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

/// Lists of segments, one after the other.
#[derive(Debug)]
struct Lists {
    starts: Vec<u32>,
    members: Vec<u32>,
}

impl Lists {
    /// Each pair is a list's number and a member of it.
    fn new(n_lists: usize, pairs: impl Iterator<Item = (usize, u32)> + Clone) -> Self {
        let mut starts = vec![0u32; n_lists + 1];
        pairs.clone().for_each(|(list, _)| starts[list + 1] += 1);
        for list in 0..n_lists {
            starts[list + 1] += starts[list];
        }
        let mut ends = starts.clone();
        let mut members = vec![0; starts[n_lists] as usize];
        for (list, member) in pairs {
            members[ends[list] as usize] = member;
            ends[list] += 1;
        }
        Self { starts, members }
    }

    fn of(&self, list: usize) -> &[u32] {
        &self.members[self.starts[list] as usize..self.starts[list + 1] as usize]
    }
}

/// Where a way first meets the border.
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

impl Border {
    /// Segments that do not cross, in a domain of this size, around an area inside. Places nearer to them than `tolerance` count as on the border.
    pub fn new(segments: Vec<[DVec2; 2]>, size: DVec2, area: f64, tolerance: f64) -> Self {
        let wanted = (BINS * segments.len()).clamp(FEWEST_BINS, MOST_BINS) as f64;
        let square = (size.x * size.y / wanted).sqrt();
        let n_bins = (size / square).round().clamp(DVec2::ONE, DVec2::splat(wanted)).to_array().map(|n| n as usize);
        let resolution = DVec2::new(n_bins[0] as f64, n_bins[1] as f64) / size;
        let mut border = Self {
            area,
            tolerance: tolerance.max(4.0 * GRID),
            n_bins,
            resolution,
            side: (1.0 / resolution).min_element(),
            by_bin: Lists { starts: Vec::new(), members: Vec::new() },
            by_row: Lists { starts: Vec::new(), members: Vec::new() },
            bins: vec![Bin { clearance: FAR, is_inside: false }; n_bins[0] * n_bins[1]],
            segments,
        };
        let numbered = || (0u32..).zip(&border.segments);
        let rows = numbered().flat_map(|(k, segment)| border.rows(segment).map(move |row| (row, k)));
        let by_row = Lists::new(n_bins[1], rows);
        let reached = |row: usize, segment: &[DVec2; 2]| border.columns_in(row, segment).map(move |column| column + row * n_bins[0]);
        let in_bins =
            numbered().flat_map(|(k, segment)| border.rows(segment).flat_map(move |row| reached(row, segment)).map(move |bin| (bin, k)));
        let by_bin = Lists::new(n_bins[0] * n_bins[1], in_bins);
        (border.by_row, border.by_bin) = (by_row, by_bin);
        border.find_clearances();
        border.find_inside();
        border
    }

    fn find_clearances(&mut self) {
        let [n_columns, n_rows] = self.n_bins;
        for bin in 0..self.bins.len() {
            if !self.by_bin.of(bin).is_empty() {
                self.bins[bin].clearance = 0;
            }
        }
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
                self.bins[bin].is_inside = *before.get_or_insert_with(|| self.is_enclosed(centre, row));
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

    /// Whether an odd number of segments lies to the right of a place in a row of bins. Exact.
    fn is_enclosed(&self, p: DVec2, row: usize) -> bool {
        let is_right = |&k: &u32| {
            let [a, b] = self.segments[k as usize];
            let (is_up, is_down) = (a.y <= p.y && p.y < b.y, b.y <= p.y && p.y < a.y);
            (is_up && is_left_turn(b - a, p - a)) || (is_down && is_left_turn(a - b, p - b))
        };
        self.by_row.of(row).iter().filter(|k| is_right(k)).count() % 2 == 1
    }

    /// Whether a place on the grid lies inside. Exact, but on the border itself.
    pub fn contains(&self, p: DVec2) -> bool {
        let bin = self.bins[self.bin(p)];
        if bin.clearance > 0 { bin.is_inside } else { self.is_enclosed(p, self.row(p.y)) }
    }

    /// Whether a place lies inside or on the border, as far as that can be told.
    pub fn holds(&self, p: DVec2) -> bool {
        self.contains(p) || self.is_on(p, self.tolerance)
    }

    /// Whether a place is nearer to the border than this; less than a bin's side.
    fn is_on(&self, p: DVec2, distance: f64) -> bool {
        self.by_bin.of(self.bin(p)).iter().any(|&k| distance_to(p, self.segments[k as usize]) <= distance)
    }

    /// A place inside, clear of the border, next to `p`, which is held; or itself, if there is none.
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
        let found = found.find(|&(step, q)| is_good(q, (0.25 * step).min(self.side)) && self.sees(p, q));
        found.map_or(p, |(_, q)| q)
    }

    /// No segment is nearer than this to a place.
    #[inline]
    pub fn clearance(&self, p: DVec2) -> f64 {
        let bins = self.bins[self.bin(p)].clearance;
        f64::from(bins.saturating_sub(1)) * self.side
    }

    /// Leaves the segments in or near a box, each once.
    pub fn find_near(&self, low: DVec2, high: DVec2, found: &mut Vec<u32>) {
        found.clear();
        for row in self.row(low.y)..=self.row(high.y) {
            for column in self.column(low.x)..=self.column(high.x) {
                found.extend(self.by_bin.of(column + row * self.n_bins[0]));
            }
        }
        found.sort_unstable();
        found.dedup();
        found.retain(|&k| {
            let [a, b] = self.segments[k as usize];
            a.min(b).cmple(high).all() && a.max(b).cmpge(low).all()
        });
    }

    /// Whether all of a box lies outside.
    pub fn is_outside(&self, low: DVec2, high: DVec2) -> bool {
        !self.contains(snap(0.5 * (low + high))) && !self.reaches(low, high)
    }

    /// Whether a segment has a place in a box.
    pub fn reaches(&self, low: DVec2, high: DVec2) -> bool {
        let (centre, half) = (0.5 * (low + high), 0.5 * (high - low));
        self.clearance(centre) <= half.length()
            && (self.row(low.y)..=self.row(high.y)).any(|row| {
                (self.column(low.x)..=self.column(high.x)).any(|column| {
                    let segments = self.by_bin.of(column + row * self.n_bins[0]);
                    segments.iter().any(|&k| reaches_box(self.segments[k as usize], centre, half))
                })
            })
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
        let way = to - from;
        if self.clearance(from) > way.length() {
            return None;
        }
        let mut first: Option<Meeting> = None;
        for row in self.rows(&[from, to]) {
            for column in self.columns_in(row, &[from, to]) {
                for &k in self.by_bin.of(column + row * self.n_bins[0]) {
                    let segment = self.segments[k as usize];
                    if let Some(part) = meets(from, way, segment)
                        && first.is_none_or(|first| part < first.part)
                    {
                        first = Some(Meeting { part, segment });
                    }
                }
            }
        }
        first
    }

    /// Whether no segment stands between two places inside.
    pub fn sees(&self, a: DVec2, b: DVec2) -> bool {
        self.first_meeting(a, b).is_none()
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
