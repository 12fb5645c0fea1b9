//! What a point in a polygon sees of its cell.
//!
//! The boundary hides what lies behind it. The part of a cell that its point sees need not be convex; a star's cell is: so rules are shown the hull of that part, in which a few
//! straight walls stand for the boundary, and measures what is really seen.

use glam::DVec2;

use super::spoke::MIRROR;
use super::walls::{Side, WallCell};
use crate::space::{Boundary, GRID};

/// Walls are so straight: they stand as much farther out as they must to have all of the hull before them, this part of the cell's radius at most.
const SMOOTH: f64 = 0.005;
/// Nothing is farther away than this, in normalised units.
const FAR: f64 = 4.0;
/// Places on a side differ from it by this part of the cell's radius at most.
const ON_SIDE: f64 = 1e-9;

/// What is seen of a cell; everything relative to its point.
#[derive(Default)]
pub(crate) struct Sight {
    /// The corners of what is seen, counter-clockwise.
    pub outline: Vec<DVec2>,
    /// The segments near the cell.
    near: Vec<u32>,
    /// The pieces of segments that stand in the cell with their fronts towards the point: each from its start to its end, counter-clockwise.
    fronts: Vec<[DVec2; 2]>,
    /// The ways in which something begins or ends, and the fronts that stand in the way in between.
    turns: Vec<Turn>,
    active: Vec<u32>,
    /// The outline from left to right.
    across: Vec<DVec2>,
    /// The corners of its hull, counter-clockwise, and the hull as a cell.
    hull: Vec<DVec2>,
    pub cell: WallCell,
}

/// Where a front begins or ends, or the cell has a corner.
#[derive(Clone, Copy)]
struct Turn {
    way: DVec2,
    angle: f64,
    front: Option<u32>,
}

/// What is seen of a cell, in numbers.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Moments {
    pub area: f64,
    pub centroid: DVec2,
    /// The squared distance from the point, integrated.
    pub second: f64,
}

impl Sight {
    /// Leaves what a point at `at` sees of its cell in `outline`, and the hull of it in `cell`. Whether that is less than the cell.
    pub(super) fn look(&mut self, at: DVec2, cell: &WallCell, boundary: &Boundary) -> bool {
        self.outline.clear();
        self.outline.extend(cell.sides.iter().map(|side| side.corner));
        let corners = self.outline.iter();
        let (low, high) = corners.fold((DVec2::ZERO, DVec2::ZERO), |(low, high), &corner| (low.min(corner), high.max(corner)));
        boundary.find_near(at + low, at + high, &mut self.near);
        self.fronts.clear();
        for &k in &self.near {
            self.fronts.extend(front(boundary.segment(k).map(|end| end - at), &cell.sides));
        }
        let is_less = !self.fronts.is_empty();
        if is_less {
            self.trace(&cell.sides);
            self.find_hull();
            self.find_sides(&cell.sides);
        }
        if !is_less || self.cell.sides.len() < 3 {
            self.cell.sides.clone_from(&cell.sides);
        }
        is_less
    }

    /// The distance of the farthest place that is seen.
    pub fn reach(&self) -> f64 {
        self.outline.iter().map(|corner| corner.length_squared()).fold(0.0, f64::max).sqrt()
    }

    /// The area of what is seen, its centroid, and the squared distance integrated over it.
    pub fn moments(&self) -> Moments {
        let ends = self.outline.iter().zip(self.outline.iter().cycle().skip(1));
        let mut moments = Moments::default();
        for (&a, &b) in ends {
            let area = 0.5 * a.perp_dot(b);
            moments.area += area;
            moments.centroid += area * (a + b) / 3.0;
            moments.second += area * (a.length_squared() + a.dot(b) + b.length_squared()) / 6.0;
        }
        moments.centroid = if moments.area > 0.0 { moments.centroid / moments.area } else { DVec2::ZERO };
        moments
    }

    /// Goes around, and finds how far it is to what stands nearest: just before each turn, and just after it.
    fn trace(&mut self, sides: &[Side]) {
        let Self { outline, fronts, turns, active, .. } = self;
        turns.clear();
        turns.extend(sides.iter().map(|side| Turn { way: side.corner, angle: around(side.corner), front: None }));
        active.clear();
        for (&[start, end], front) in fronts.iter().zip(0..) {
            let ends = [start, end].map(|way| Turn { way, angle: around(way), front: Some(front) });
            turns.extend(ends);
            // Where the turns begin some fronts are there already.
            if ends[0].angle > ends[1].angle {
                active.push(front);
            }
        }
        turns.sort_unstable_by(|a, b| a.angle.total_cmp(&b.angle));
        outline.clear();
        for together in turns.chunk_by(|a, b| a.angle == b.angle) {
            let way = together[0].way.normalize_or_zero();
            let to_sides = to_sides(way, sides);
            let before = to_fronts(way, fronts, active).min(to_sides);
            for front in together.iter().filter_map(|turn| turn.front) {
                match active.iter().position(|&other| other == front) {
                    Some(k) => _ = active.swap_remove(k),
                    None => active.push(front),
                }
            }
            let after = to_fronts(way, fronts, active).min(to_sides);
            for place in [before, after].map(|distance| distance * way) {
                if outline.last() != Some(&place) {
                    outline.push(place);
                }
            }
        }
    }

    /// The convex hull of the outline, counter-clockwise, by Andrew's chains.
    fn find_hull(&mut self) {
        let Self { outline, across, hull, .. } = self;
        across.clone_from(outline);
        across.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        across.dedup();
        hull.clear();
        for is_back in [false, true] {
            let first = hull.len();
            for k in 0..across.len() {
                let place = if is_back { across[across.len() - 1 - k] } else { across[k] };
                while let [.., a, b] = hull[first..]
                    && (b - a).perp_dot(place - a) <= 0.0
                {
                    hull.pop();
                }
                hull.push(place);
            }
            // The last of one chain is the first of the other.
            hull.pop();
        }
    }

    /// The sides of the hull: on a bisector with a neighbour, or a wall. Walls that make nearly one straight line are one.
    fn find_sides(&mut self, bisectors: &[Side]) {
        let Self { hull, cell: WallCell { sides, .. }, .. } = self;
        sides.clear();
        let radius = hull.iter().map(|corner| corner.length_squared()).fold(0.0, f64::max).sqrt();
        let n = hull.len();
        let is_on = |side: &Side, place: DVec2| (place.dot(side.direction) - 0.5 * side.way.dot(side.direction)).abs() <= ON_SIDE * radius;
        let of = |k: usize| bisectors.iter().find(|side| side.vertex != MIRROR && is_on(side, hull[k]) && is_on(side, hull[(k + 1) % n]));
        // Begin where a wall does not go on.
        let start = (0..n).find(|&k| of(k).is_some()).unwrap_or(0);
        let mut k = start;
        while k < start + n {
            let corner = hull[k % n];
            if let Some(bisector) = of(k % n) {
                // Two pieces of one side have a wall between them that the hull does not reach.
                if sides.last().is_none_or(|last: &Side| last.vertex != bisector.vertex) {
                    sides.push(Side { corner, ..*bisector });
                }
                k += 1;
                continue;
            }
            let mut end = k + 1;
            while end < start + n && of(end % n).is_none() {
                let to = hull[(end + 1) % n];
                let normal = (to - corner).perp().normalize_or_zero();
                let is_straight = (k + 1..=end).all(|j| (hull[j % n] - corner).dot(normal).abs() <= SMOOTH * radius);
                if !is_straight {
                    break;
                }
                end += 1;
            }
            let direction = -(hull[end % n] - corner).perp().normalize_or_zero();
            let distance = (k..=end).map(|j| hull[j % n].dot(direction)).fold(0.0, f64::max);
            if direction != DVec2::ZERO && (hull[end % n] - corner).length() > ON_SIDE * radius {
                sides.push(Side { corner, vertex: MIRROR, way: 2.0 * distance.max(GRID) * direction, direction });
            }
            k = end;
        }
        if let [first, .., last] = &mut sides[..]
            && first.vertex == last.vertex
            && first.vertex != MIRROR
        {
            first.corner = last.corner;
            sides.pop();
        }
    }
}

/// How far it is in a way to the nearest of a cell's sides; no farther than can be seen.
fn to_sides(way: DVec2, sides: &[Side]) -> f64 {
    let to_side = |side: &Side| {
        let towards = side.direction.dot(way);
        if towards > 0.0 { 0.5 * side.way.dot(side.direction) / towards } else { f64::INFINITY }
    };
    sides.iter().map(to_side).fold(FAR, f64::min)
}

/// How far it is in a way to the nearest of the fronts that stand there.
fn to_fronts(way: DVec2, fronts: &[[DVec2; 2]], active: &[u32]) -> f64 {
    let to_front = |&front: &u32| {
        let [a, b] = fronts[front as usize];
        let along = b - a;
        let across = way.perp_dot(along);
        if across > 0.0 { a.perp_dot(along) / across } else { a.length().min(b.length()) }
    };
    active.iter().map(to_front).fold(f64::INFINITY, f64::min)
}

/// What grows with the angle of a way.
fn around(way: DVec2) -> f64 {
    let along = way.x / (way.x.abs() + way.y.abs());
    if way.y < 0.0 { 3.0 + along } else { 1.0 - along }
}

/// The piece of a segment that stands in a cell, if its front is turned to the point.
fn front([a, b]: [DVec2; 2], sides: &[Side]) -> Option<[DVec2; 2]> {
    if a.perp_dot(b) <= 0.0 {
        return None;
    }
    let along = b - a;
    let (mut first, mut last) = (0f64, 1f64);
    for side in sides {
        let (excess, growth) = (a.dot(side.direction) - 0.5 * side.way.dot(side.direction), along.dot(side.direction));
        if growth > 0.0 {
            last = last.min(-excess / growth);
        } else if growth < 0.0 {
            first = first.max(-excess / growth);
        } else if excess > 0.0 {
            return None;
        }
    }
    let place = |part: f64| match part {
        0.0 => a,
        1.0 => b,
        _ => a + part * along,
    };
    (first < last).then(|| [place(first), place(last)])
}
