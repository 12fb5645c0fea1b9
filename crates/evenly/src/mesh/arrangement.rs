//! Segments become pieces where others cross them, and where points lie on them.

use std::collections::{HashMap, HashSet};

use glam::DVec2;

use super::outline::{Of, Segment};
use crate::predicates::is_left_turn;
use crate::space::{SegmentTree, nearest, snap};

/// Points this near to a segment or another point, in normalised units, count as on it.
pub(super) const ON_BOUNDARY: f64 = 1e-9;

/// Distinct points, by number.
pub(super) struct Places {
    pub points: Vec<DVec2>,
    /// So many of them, the first ones, are corners of the polygon.
    n_corners: usize,
    by_cell: HashMap<[i64; 2], Vec<u32>>,
}

impl Places {
    pub fn new(corners: &[DVec2]) -> Self {
        let mut places = Self { points: Vec::new(), n_corners: corners.len(), by_cell: HashMap::new() };
        corners.iter().for_each(|&p| places.push(p));
        places
    }

    /// The number of a point: a new one unless another is as near as may be.
    pub fn number(&mut self, p: DVec2) -> u32 {
        let [x, y] = cell(p);
        let around = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| [x + dx, y + dy]));
        let near = around.filter_map(|cell| self.by_cell.get(&cell)).flatten().copied();
        let found = near.filter(|&v| self.points[v as usize].distance(p) < ON_BOUNDARY).min();
        found.unwrap_or_else(|| {
            self.push(p);
            self.points.len() as u32 - 1
        })
    }

    fn push(&mut self, p: DVec2) {
        self.by_cell.entry(cell(p)).or_default().push(self.points.len() as u32);
        self.points.push(p);
    }
}

fn cell(p: DVec2) -> [i64; 2] {
    [(p.x / ON_BOUNDARY).floor() as i64, (p.y / ON_BOUNDARY).floor() as i64]
}

/// The pieces of segments between points that lie on them, among which are those where they cross. What is
/// there twice is there once: of the segment that comes first.
pub(super) fn arranged(places: &mut Places, segments: &[Segment]) -> Vec<Segment> {
    let ends: Vec<[DVec2; 2]> = segments.iter().map(|segment| segment.ends.map(|v| places.points[v as usize])).collect();
    let tree = SegmentTree::new(&ends);
    let mut on: Vec<Vec<u32>> = segments.iter().map(|segment| segment.ends.to_vec()).collect();
    // The boundary is clean: no corner lies on its segments.
    let has_lines = segments.iter().any(|segment| matches!(segment.of, Of::Line(_)));
    let first = if has_lines { 0 } else { places.n_corners };
    for (v, &p) in (0u32..).zip(&places.points).skip(first) {
        let is_near = |low: DVec2, high: DVec2| p.distance(p.clamp(low, high)) < ON_BOUNDARY;
        tree.find(is_near, |ends, segment| {
            let is_clean = v < places.n_corners as u32 && !matches!(segments[segment as usize].of, Of::Line(_));
            if !is_clean && p.distance(nearest(p, ends)) < ON_BOUNDARY {
                on[segment as usize].push(v);
            }
            false
        });
    }
    for (k, &[a, b]) in (0u32..).zip(&ends).filter(|_| has_lines) {
        let (low, high) = (a.min(b), a.max(b));
        let mut met = Vec::new();
        tree.find(
            |l, h| l.cmple(high).all() && h.cmpge(low).all(),
            |[c, d], other| {
                if other < k && parts(a, b, c, d) && parts(c, d, a, b) {
                    let (at_a, at_b) = ((d - c).perp_dot(a - c), (d - c).perp_dot(b - c));
                    met.push((other, snap(a + (b - a) * (at_a / (at_a - at_b)))));
                }
                false
            },
        );
        for (other, at) in met {
            let v = places.number(at);
            on[k as usize].push(v);
            on[other as usize].push(v);
        }
    }
    let mut seen = HashSet::new();
    let mut pieces = Vec::new();
    for ((segment, &[a, b]), mut points) in segments.iter().zip(&ends).zip(on) {
        let along = |v: u32| (places.points[v as usize] - a).dot(b - a);
        points.sort_by(|&v, &w| along(v).total_cmp(&along(w)).then(v.cmp(&w)));
        points.dedup();
        // Rounding may put a point before the start or behind the end.
        let from = points.iter().position(|&v| v == segment.ends[0]).unwrap_or(0);
        let to = points.iter().position(|&v| v == segment.ends[1]).map_or(points.len(), |to| to + 1);
        for pair in points.get(from..to).unwrap_or_default().windows(2) {
            if seen.insert([pair[0].min(pair[1]), pair[0].max(pair[1])]) {
                pieces.push(Segment { ends: [pair[0], pair[1]], of: segment.of });
            }
        }
    }
    pieces
}

/// Whether the line through `a` and `b` parts `c` from `d`.
fn parts(a: DVec2, b: DVec2, c: DVec2, d: DVec2) -> bool {
    let side = |p: DVec2| i32::from(is_left_turn(b - a, p - a)) - i32::from(is_left_turn(p - a, b - a));
    side(c) * side(d) < 0
}

/// The part of a segment that lies in a box from `low` to `high`.
pub(super) fn within([a, b]: [DVec2; 2], low: DVec2, high: DVec2) -> Option<[DVec2; 2]> {
    let (mut from, mut to) = (0f64, 1f64);
    for axis in 0..2 {
        let (start, way) = (a[axis], b[axis] - a[axis]);
        if way == 0.0 {
            if !(low[axis]..=high[axis]).contains(&start) {
                return None;
            }
            continue;
        }
        let (one, other) = ((low[axis] - start) / way, (high[axis] - start) / way);
        (from, to) = (from.max(one.min(other)), to.min(one.max(other)));
    }
    let at = |share: f64, end: DVec2, whole: f64| if share == whole { end } else { a + share * (b - a) };
    (from < to).then(|| [at(from, a, 0.0), at(to, b, 1.0)])
}
