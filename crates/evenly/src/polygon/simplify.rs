//! Fewer corners, the same area: two corners in a row become one, as long as no place moves too far.
//!
//! Kronenfeld, Stanislawski, Buttenfield and Brockmeyer, "Simplification of polylines by segment collapse:
//! minimizing areal displacement while preserving area", International Journal of Cartography 6(1), 2020,
//! doi 10.1080/23729333.2019.1631535. What is least far off goes first; what would make rings meet stays.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::DVec2;

use super::{Polygon, Shape};
use crate::error::Error;
use crate::predicates::is_left_turn;
use crate::space::{SegmentTree, nearest, snap};

impl Polygon {
    /// The polygon with fewer corners: no place of its boundary is farther than `tolerance`, in input units,
    /// from the new one. Each ring stays, keeps its area, and meets no other.
    ///
    /// # Errors
    /// [`Error::InvalidParameter`] for a tolerance that is not positive and finite.
    pub fn simplified(&self, tolerance: f64) -> Result<Self, Error> {
        let mut rings = Rings::new(self);
        rings.collapse_all(self.normalized_tolerance(tolerance)?);
        self.with_corners(&rings)
    }

    /// The first of rising tolerances for which the simplified polygon `is_simple`, if there is one; each goes on from the one before.
    ///
    /// # Errors
    /// As [`Self::simplified`].
    pub fn least_simplification(&self, tolerances: &[f64], is_simple: impl Fn(&Self) -> bool) -> Result<Option<f64>, Error> {
        let mut rings = Rings::new(self);
        let mut n_looked_at = rings.places.len();
        for &tolerance in tolerances {
            rings.collapse_all(self.normalized_tolerance(tolerance)?);
            // With nearly as many corners it is hardly simpler.
            let n_left = rings.is_gone.iter().filter(|is_gone| !**is_gone).count();
            if n_left as f64 <= WORTH_A_LOOK * n_looked_at as f64 {
                n_looked_at = n_left;
                if is_simple(&self.with_corners(&rings)?) {
                    return Ok(Some(tolerance));
                }
            }
        }
        Ok(None)
    }

    fn normalized_tolerance(&self, tolerance: f64) -> Result<f64, Error> {
        if tolerance > 0.0 && tolerance.is_finite() {
            return Ok(tolerance / self.domain().restore_length(1.0));
        }
        Err(Error::InvalidParameter { name: "simplify", value: tolerance.to_string(), expected: "positive and finite" })
    }

    /// The polygon with what is left of its corners.
    fn with_corners(&self, rings: &Rings) -> Result<Self, Error> {
        let domain = self.domain();
        // Corners may come to lie outside of what was the frame.
        let ([left, bottom], unit) = (domain.restore(DVec2::ZERO), domain.restore_length(1.0));
        let restored = |p: DVec2| [left + unit * p.x, bottom + unit * p.y];
        let input = |v: u32| rings.given[v as usize].unwrap_or_else(|| restored(rings.places[v as usize]));
        let rings = rings.all().map(|ring| ring.into_iter().map(input).collect()).collect();
        let simplified = Self::of_shapes(&[Shape { rings, ..Shape::default() }])?;
        Ok(Self { repairs: self.repairs.clone(), ..simplified })
    }
}

/// A polygon is examined again once it has at most this share of the corners that it had the last time.
const WORTH_A_LOOK: f64 = 0.9;
/// So many corners around a collapse are looked at.
const AROUND: usize = 8;

/// Rings whose corners become fewer. A corner has the number of a segment: that which leaves it.
struct Rings {
    tolerance: f64,
    places: Vec<DVec2>,
    /// As it was given, unless it has moved.
    given: Vec<Option<[f64; 2]>>,
    next: Vec<u32>,
    previous: Vec<u32>,
    is_gone: Vec<bool>,
    /// How often each has changed: who waits with another count is out of date.
    n_changes: Vec<u32>,
    /// The first segments, and which corner's segment stands for each now.
    first: Vec<[DVec2; 2]>,
    stands_for: Vec<u32>,
    tree: SegmentTree,
    starts: Vec<u32>,
}

/// Corners `b` and `c` between `a` and `d` become one, at `e`.
struct Collapse {
    corners: [u32; 4],
    e: DVec2,
    deviation: f64,
}

impl Rings {
    fn new(polygon: &Polygon) -> Self {
        let first: Vec<[DVec2; 2]> = polygon.boundary.iter().map(|ends| ends.map(|v| polygon.corners[v as usize])).collect();
        let (mut next, mut previous, mut starts) = (Vec::new(), Vec::new(), Vec::new());
        for ring in &polygon.rings {
            let (start, n) = (next.len() as u32, ring.len() as u32);
            starts.push(start);
            next.extend((0..n).map(|k| start + (k + 1) % n));
            previous.extend((0..n).map(|k| start + (k + n - 1) % n));
        }
        let n = first.len();
        Self {
            tolerance: 0.0,
            places: first.iter().map(|ends| ends[0]).collect(),
            given: polygon.rings.iter().flatten().map(|&p| Some(p)).collect(),
            next,
            previous,
            is_gone: vec![false; n],
            n_changes: vec![0; n],
            tree: SegmentTree::new(&first),
            first,
            stands_for: (0..n as u32).collect(),
            starts,
        }
    }

    /// The corners that are left, ring by ring.
    fn all(&self) -> impl Iterator<Item = Vec<u32>> {
        self.starts.iter().map(|&start| {
            let start = self.stands_for[start as usize];
            let mut ring = vec![start];
            let mut v = self.next[start as usize];
            while v != start {
                ring.push(v);
                v = self.next[v as usize];
            }
            ring
        })
    }

    fn collapse_all(&mut self, tolerance: f64) {
        self.tolerance = tolerance;
        // Positive numbers are in the order of their bits.
        let mut queue: BinaryHeap<Reverse<(u64, u32, u32)>> = BinaryHeap::new();
        let wait = |rings: &Self, queue: &mut BinaryHeap<_>, a: u32| {
            if let Some(collapse) = rings.collapse(a) {
                queue.push(Reverse((collapse.deviation.to_bits(), a, rings.changes(a))));
            }
        };
        (0..self.places.len() as u32).for_each(|a| wait(self, &mut queue, a));
        while let Some(Reverse((_, a, n_changes))) = queue.pop() {
            if self.is_gone[a as usize] || self.changes(a) != n_changes {
                continue;
            }
            let Some(collapse) = self.collapse(a).filter(|collapse| self.is_free(collapse)) else { continue };
            let [a, b, c, d] = collapse.corners;
            self.places[b as usize] = collapse.e;
            self.given[b as usize] = None;
            self.is_gone[c as usize] = true;
            self.next[b as usize] = d;
            self.previous[d as usize] = b;
            for segment in self.segments_of(c, d) {
                self.stands_for[segment as usize] = b;
            }
            for v in [a, b, d] {
                self.n_changes[v as usize] += 1;
            }
            // All whose four corners have changed.
            let before = self.previous[a as usize];
            for v in [self.previous[before as usize], before, a, b, d] {
                wait(self, &mut queue, v);
            }
        }
    }

    /// The changes of the four corners from `a` on.
    fn changes(&self, a: u32) -> u32 {
        let mut v = a;
        let mut sum = 0;
        for _ in 0..4 {
            sum += self.n_changes[v as usize];
            v = self.next[v as usize];
        }
        sum
    }

    /// The first segments for which those from corner `from` to corner `to` stand.
    fn segments_of(&self, from: u32, to: u32) -> impl Iterator<Item = u32> + use<> {
        // A ring's segments follow each other, and its last is followed by its first.
        let ring = self.starts.partition_point(|&start| start <= from) - 1;
        let (start, end) = (self.starts[ring], self.starts.get(ring + 1).copied().unwrap_or(self.first.len() as u32));
        let n = if to > from { to - from } else { to + (end - start) - from };
        (0..n).map(move |k| start + (from - start + k) % (end - start))
    }

    /// What becomes of the two corners after `a`, if they may go.
    fn collapse(&self, a: u32) -> Option<Collapse> {
        let b = self.next[a as usize];
        let c = self.next[b as usize];
        let d = self.next[c as usize];
        if d == a || self.is_gone[a as usize] {
            return None;
        }
        let [pa, pb, pc, pd] = [a, b, c, d].map(|v| self.places[v as usize]);
        // On the parallel of a and d on which a triangle has the area that the four corners have.
        let way = pd - pa;
        let twice_area = (pb - pa).perp_dot(pc - pa) + (pc - pa).perp_dot(pd - pa);
        let offset = -twice_area / way.length_squared() * way.perp();
        let cross = |from: DVec2, to: DVec2| {
            let (along, beside) = (to - from, way.perp_dot(to - from));
            let share = (way.perp_dot(pa + offset - from)) / beside;
            (share.is_finite()).then(|| snap(from + share * along))
        };
        let candidates = [cross(pa, pb), cross(pd, pc)].into_iter().flatten();
        let deviation = |e: DVec2| self.deviation([a, b, c, d], e);
        let best = candidates.map(|e| (deviation(e), e)).min_by(|p, q| p.0.total_cmp(&q.0))?;
        (best.0 <= self.tolerance).then_some(Collapse { corners: [a, b, c, d], e: best.1, deviation: best.0 })
    }

    /// How far the first corners around are from what becomes of the boundary with `e` instead of `b` and `c`,
    /// and `e` from the first boundary. Each corner is compared with the segment that stands for its own, and
    /// with those before and after: so no others need be asked later.
    fn deviation(&self, [a, b, c, d]: [u32; 4], e: DVec2) -> f64 {
        let mut corners = vec![a];
        let mut v = d;
        while v != a && corners.len() < AROUND {
            corners.push(v);
            v = self.next[v as usize];
        }
        let is_whole = v == a;
        let mut chain = vec![b];
        if is_whole {
            // A small ring: all around it.
            chain.extend(&corners[1..]);
            chain.push(a);
            chain.push(b);
        } else {
            let before = self.previous[a as usize];
            chain = vec![self.previous[before as usize], before, a, b, d, self.next[d as usize]];
            chain.push(self.next[chain[5] as usize]);
        }
        let place = |v: u32| if v == b { e } else { self.places[v as usize] };
        let new: Vec<[DVec2; 2]> = chain.windows(2).map(|ends| [place(ends[0]), place(ends[1])]).collect();
        let mut most = 0f64;
        let mut to_first = f64::INFINITY;
        for (k, ends) in chain.windows(2).enumerate() {
            let around = if is_whole { &new[..] } else { &new[k.saturating_sub(1)..(k + 2).min(new.len())] };
            // Those at the ends of the chain stay as they are.
            if !is_whole && (k == 0 || k + 1 == new.len()) {
                continue;
            }
            for segment in self.segments_of(ends[0], ends[1]) {
                let first = self.first[segment as usize];
                let away = around.iter().map(|&ends| first[0].distance(nearest(first[0], ends))).fold(f64::INFINITY, f64::min);
                most = most.max(away);
                if [a, b, c].contains(&ends[0]) {
                    to_first = to_first.min(e.distance(nearest(e, first)));
                }
            }
        }
        most.max(to_first)
    }

    /// Whether nothing lies between the old corners and the new one.
    fn is_free(&self, &Collapse { corners: [a, b, c, d], e, .. }: &Collapse) -> bool {
        let around = [a, b, c, d].map(|v| self.places[v as usize]);
        let [pa, _, _, pd] = around;
        let reach = DVec2::splat(2.0 * self.tolerance);
        let low = around.iter().fold(e, |low, p| low.min(*p)) - reach;
        let high = around.iter().fold(e, |high, p| high.max(*p)) + reach;
        let swept = [around[0], around[1], around[2], around[3], e];
        let is_in_the_way = |v: u32| {
            let [p, q] = [v, self.next[v as usize]].map(|v| self.places[v as usize]);
            let meets = |from: DVec2, to: DVec2| {
                let is_shared = p == from || p == to || q == from || q == to;
                if is_shared { overlap([from, to], [p, q]) } else { meet([from, to], [p, q]) }
            };
            meets(pa, e) || meets(e, pd) || ![a, d].contains(&v) && is_inside(p, &swept)
        };
        !self.tree.find(
            |l, h| l.cmple(high).all() && h.cmpge(low).all(),
            |_, segment| {
                let v = self.stands_for[segment as usize];
                ![a, b, c].contains(&v) && is_in_the_way(v)
            },
        )
    }
}

/// Whether two segments have a place in common.
fn meet([a, b]: [DVec2; 2], [p, q]: [DVec2; 2]) -> bool {
    let parts = |from: DVec2, to: DVec2, p: DVec2, q: DVec2| {
        let side = |x: DVec2| i32::from(is_left_turn(to - from, x - from)) - i32::from(is_left_turn(x - from, to - from));
        side(p) * side(q) > 0
    };
    let apart = (a.min(b)).cmpgt(p.max(q)).any() || (p.min(q)).cmpgt(a.max(b)).any();
    !(apart || parts(a, b, p, q) || parts(p, q, a, b))
}

/// Whether two segments with a common end have more in common.
fn overlap([a, b]: [DVec2; 2], [p, q]: [DVec2; 2]) -> bool {
    let (at, one, other) = match () {
        () if p == a => (a, b, q),
        () if q == a => (a, b, p),
        () if p == b => (b, a, q),
        () => (b, a, p),
    };
    let (u, v) = (one - at, other - at);
    !is_left_turn(u, v) && !is_left_turn(v, u) && u.dot(v) > 0.0
}

fn is_inside(p: DVec2, ring: &[DVec2]) -> bool {
    let sides = ring.iter().zip(ring.iter().cycle().skip(1));
    let crossed = sides.filter(|(a, b)| (a.y <= p.y) != (b.y <= p.y) && a.x + (b.x - a.x) * ((p.y - a.y) / (b.y - a.y)) > p.x);
    crossed.count() % 2 == 1
}
