//! A short way through all points, as a pen goes.
//!
//! It begins along a Hilbert curve and is shortened by Or-opt and by chains of 2-opt moves among Delaunay neighbours, until neither finds anything: Lin and Kernighan, "An
//! Effective Heuristic Algorithm for the Traveling-Salesman Problem", Operations Research 21(2), 1973, doi 10.1287/opre.21.2.498, with the short lists of neighbours and of points
//! to look at of Bentley, "Fast Algorithms for Geometric Traveling Salesman Problems", ORSA Journal on Computing 4(4), 1992, doi 10.1287/ijoc.4.4.387. The way through all and
//! back is then opened at its longest step.
//!
//! Cost: about O(n log n). It does not promise the shortest way: with random points it ends some 5 % above.

use glam::DVec2;

use crate::points::{PointSet, separate};
use crate::run::RunContext;
use crate::space::Domain;
use crate::triangulation::delaunay;

/// The longest part of a tour that is turned round at a time: more would take too long for what it gains.
const LONGEST_TURN: usize = 50_000;
/// 2-opt moves in a row.
const LONGEST_CHAIN: usize = 8;
/// Segments of up to so many points are put elsewhere.
const SEGMENT: usize = 3;
/// Fewer points have no tour that is worth a search.
const FEWEST: usize = 8;

/// The order in which a pen visits all points on a short way. It crosses no boundary, not that of a torus either.
/// After an interrupt the way is as short as it has become.
///
/// # Example
/// ```
/// use evenly::{Rectangle, RunContext, tour, white};
///
/// let points = white(Rectangle::new([0.0, 0.0], [1.0, 1.0])?, 2000, 7)?;
/// let places: Vec<[f64; 2]> = tour(&points, &RunContext::default()).iter().map(|&index| points.positions()[index]).collect();
/// let length: f64 = places.windows(2).map(|step| (step[0][0] - step[1][0]).hypot(step[0][1] - step[1][1])).sum();
/// assert!(length < 0.8 * 2000f64.sqrt());
/// # Ok::<(), evenly::Error>(())
/// ```
pub fn tour(points: &PointSet, run: &RunContext) -> Vec<usize> {
    let space = points.space();
    let domain = Domain::new(space.origin(), space.size(), false);
    let mut positions: Vec<DVec2> = points.positions().iter().map(|&p| domain.normalize(p)).collect();
    if positions.len() < FEWEST {
        return (0..positions.len()).collect();
    }
    let spacing = domain.hex_spacing(positions.len());
    let order = separate(&domain, &mut positions, 0, spacing).order;
    let places: Vec<DVec2> = order.iter().map(|&index| positions[index as usize]).collect();
    let mut found = Tour::new(&domain, places);
    found.shorten(run);
    found.opened().into_iter().map(|k| order[k as usize] as usize).collect()
}

/// A way through all points and back.
struct Tour {
    places: Vec<DVec2>,
    /// The Delaunay neighbours of each point, nearest first, one point's after the other's; and where they begin.
    neighbours: Vec<u32>,
    starts: Vec<u32>,
    order: Vec<u32>,
    /// Where each point stands in the order.
    rank: Vec<u32>,
    /// Points around which something has changed.
    waiting: Vec<u32>,
    is_waiting: Vec<bool>,
}

impl Tour {
    /// Begins with the points in the order that they are given in.
    fn new(domain: &Domain, places: Vec<DVec2>) -> Self {
        let n = places.len() as u32;
        let all: Vec<u32> = (0..n).collect();
        let mut links: Vec<(u32, u32)> = match delaunay(domain, places.clone(), all.clone()) {
            Ok(mesh) => mesh.half_edges.triangles().flat_map(|[a, b, c]| [(a, b), (b, a), (b, c), (c, b), (c, a), (a, c)]).collect(),
            // Points that rounding has put on one line are neighbours as they follow each other.
            Err(_) => (1..n).flat_map(|k| [(k - 1, k), (k, k - 1)]).collect(),
        };
        let length = |&(a, b): &(u32, u32)| places[a as usize].distance_squared(places[b as usize]);
        links.sort_unstable_by(|x, y| x.0.cmp(&y.0).then(length(x).total_cmp(&length(y))).then(x.1.cmp(&y.1)));
        links.dedup();
        let mut starts = vec![0; n as usize + 1];
        links.iter().for_each(|link| starts[link.0 as usize + 1] += 1);
        (0..n as usize).for_each(|k| starts[k + 1] += starts[k]);
        let neighbours = links.into_iter().map(|link| link.1).collect();
        let waiting = all.iter().rev().copied().collect();
        Self { places, neighbours, starts, order: all.clone(), rank: all, waiting, is_waiting: vec![true; n as usize] }
    }

    fn n(&self) -> usize {
        self.order.len()
    }

    fn after(&self, a: u32) -> u32 {
        let rank = self.rank[a as usize] as usize + 1;
        self.order[if rank == self.n() { 0 } else { rank }]
    }

    fn before(&self, a: u32) -> u32 {
        let rank = self.rank[a as usize] as usize;
        self.order[if rank == 0 { self.n() - 1 } else { rank - 1 }]
    }

    /// The next point in one direction.
    fn beside(&self, a: u32, is_forward: bool) -> u32 {
        if is_forward { self.after(a) } else { self.before(a) }
    }

    fn length(&self, a: u32, b: u32) -> f64 {
        self.places[a as usize].distance(self.places[b as usize])
    }

    fn neighbours(&self, a: u32) -> std::ops::Range<usize> {
        self.starts[a as usize] as usize..self.starts[a as usize + 1] as usize
    }

    /// Looks at every point, and again at those around which something has changed, until nothing is gained.
    fn shorten(&mut self, run: &RunContext) {
        while let Some(a) = self.waiting.pop() {
            self.is_waiting[a as usize] = false;
            while !run.is_cancelled() && self.improve(a) {}
        }
    }

    fn improve(&mut self, a: u32) -> bool {
        [true, false].into_iter().any(|is_forward| self.untangle(a, is_forward) || self.put_elsewhere(a, is_forward))
    }

    /// A chain of 2-opt moves: the step from `a` is taken out, what follows it is turned round so that it ends near its new neighbour, and so on; of all tours that the chain
    /// comes through the shortest is kept.
    fn untangle(&mut self, a: u32, is_forward: bool) -> bool {
        let mut open = self.beside(a, is_forward);
        let step = self.length(a, open);
        let (mut gain, mut best, mut n_kept) = (step, 0.0, 0);
        let mut turns: Vec<[u32; 3]> = Vec::new();
        while turns.len() < LONGEST_CHAIN {
            let Some((c, d)) = self.best_link(a, open, gain, &turns) else { break };
            gain += self.length(c, d) - self.length(open, c);
            self.turn(a, open, d);
            turns.push([open, d, c]);
            open = d;
            let closed = gain - self.length(a, open);
            if closed > best && is_gain(closed, step + self.length(a, open)) {
                (best, n_kept) = (closed, turns.len());
            }
        }
        for [open, d, _] in turns.drain(n_kept..).rev() {
            self.turn(a, d, open);
        }
        for [open, d, c] in turns {
            self.wake([a, open, d, c]);
        }
        n_kept > 0
    }

    /// The neighbour to which a loose end is best linked, and the point that comes loose then; for a gain that is left.
    fn best_link(&self, a: u32, open: u32, gain: f64, turns: &[[u32; 3]]) -> Option<(u32, u32)> {
        let is_forward = self.after(a) == open;
        let mut best = (f64::NEG_INFINITY, None);
        for k in self.neighbours(open) {
            let c = self.neighbours[k];
            let near = self.length(open, c);
            if near >= gain {
                break;
            }
            let d = self.beside(c, !is_forward);
            let is_new = turns.iter().any(|&[open, _, linked]| [open, linked] == [c, d] || [open, linked] == [d, c]);
            if c == a || d == open || is_new || self.far(open, d) {
                continue;
            }
            let value = self.length(c, d) - near;
            if value > best.0 {
                best = (value, Some((c, d)));
            }
        }
        best.1
    }

    /// Turns round the part of the tour that follows `a`, on one side or the other, from `first` to `last`.
    fn turn(&mut self, a: u32, first: u32, last: u32) {
        if self.after(a) == first { self.reverse(first, last) } else { self.reverse(last, first) }
    }

    /// Or-opt: puts a segment that begins with `a` between a neighbour and the point beside it.
    fn put_elsewhere(&mut self, a: u32, is_forward: bool) -> bool {
        let before = self.beside(a, !is_forward);
        let mut end = a;
        for _ in 0..SEGMENT {
            let after = self.beside(end, is_forward);
            if after == before {
                return false;
            }
            let freed = self.length(before, a) + self.length(end, after) - self.length(before, after);
            for k in self.neighbours(a) {
                let c = self.neighbours[k];
                let near = self.length(a, c);
                if near >= freed {
                    break;
                }
                if self.is_between(c, a, end, is_forward) {
                    continue;
                }
                for is_beyond in [true, false] {
                    // The segment comes between c and d, with its beginning at c.
                    let d = self.beside(c, is_beyond == is_forward);
                    let gain = freed + self.length(c, d) - near - self.length(end, d);
                    let is_own = [c, d] == [before, a] || [d, c] == [before, a] || [c, d] == [end, after] || [d, c] == [end, after];
                    if !is_own
                        && is_gain(gain, freed + self.length(before, a) + self.length(end, after) + self.length(c, d))
                        && self.relocate(before, [a, end], after, [c, d], is_forward)
                    {
                        self.wake([before, a, end, after]);
                        self.wake([c, d, a, end]);
                        return true;
                    }
                }
            }
            end = after;
        }
        false
    }

    /// Whether `c` is one of the few points from `a` to `end`.
    fn is_between(&self, c: u32, a: u32, end: u32, is_forward: bool) -> bool {
        let mut at = a;
        loop {
            if at == c {
                return true;
            }
            if at == end {
                return false;
            }
            at = self.beside(at, is_forward);
        }
    }

    /// Moves a segment from between two points to between `c` and `d`, with its beginning at `c`: each step is an exchange of two steps of the tour.
    fn relocate(&mut self, before: u32, [a, end]: [u32; 2], after: u32, [c, d]: [u32; 2], is_forward: bool) -> bool {
        if self.far(a, c) {
            return false;
        }
        // Which of the two comes first on the way from the segment's end.
        let is_d_beyond = self.beside(c, is_forward) == d;
        let (first, second) = if is_d_beyond { (c, d) } else { (d, c) };
        // before [a .. end] after .. first second  becomes  before after .. first [end .. a] second.
        let done = self.exchange([before, a], [first, second]) && self.exchange([before, first], [after, end]);
        debug_assert!(done);
        // Its beginning is now at `second`.
        done && (!is_d_beyond || self.exchange([first, end], [a, second]))
    }

    /// Replaces the steps x and y by one from x[0] to y[0] and one from x[1] to y[1]; both must go the same way round.
    fn exchange(&mut self, x: [u32; 2], y: [u32; 2]) -> bool {
        if self.after(x[0]) == x[1] && self.after(y[0]) == y[1] {
            self.reverse(x[1], y[0]);
        } else if self.before(x[0]) == x[1] && self.before(y[0]) == y[1] {
            self.reverse(y[0], x[1]);
        } else {
            return false;
        }
        true
    }

    /// How many points an exchange at two places turns round at most.
    fn far(&self, a: u32, c: u32) -> bool {
        let apart = self.rank[a as usize].abs_diff(self.rank[c as usize]) as usize;
        apart.min(self.n() - apart) > LONGEST_TURN
    }

    /// Turns round the part of the tour from one point to another, or, where that is shorter, the rest.
    fn reverse(&mut self, from: u32, to: u32) {
        let n = self.n();
        let (mut i, mut j) = (self.rank[from as usize] as usize, self.rank[to as usize] as usize);
        let mut length = (j + n - i) % n + 1;
        if 2 * length > n {
            (i, j) = ((j + 1) % n, (i + n - 1) % n);
            length = n - length;
        }
        for _ in 0..length / 2 {
            self.order.swap(i, j);
            self.rank[self.order[i] as usize] = i as u32;
            self.rank[self.order[j] as usize] = j as u32;
            i = if i + 1 == n { 0 } else { i + 1 };
            j = if j == 0 { n - 1 } else { j - 1 };
        }
    }

    fn wake(&mut self, points: [u32; 4]) {
        for a in points {
            if !self.is_waiting[a as usize] {
                self.is_waiting[a as usize] = true;
                self.waiting.push(a);
            }
        }
    }

    /// The way without its longest step.
    fn opened(mut self) -> Vec<u32> {
        let step = |k: usize| self.length(self.order[k], self.order[(k + 1) % self.n()]);
        let longest = (0..self.n()).max_by(|&a, &b| step(a).total_cmp(&step(b)));
        if let Some(longest) = longest {
            let n = self.n();
            self.order.rotate_left((longest + 1) % n);
        }
        self.order
    }
}

/// Whether a gain is more than rounding.
fn is_gain(gain: f64, length: f64) -> bool {
    gain > 1e-9 * length
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::{Rectangle, Space, Torus, white};

    fn length(points: &PointSet, order: &[usize]) -> f64 {
        let at = |index: usize| DVec2::from(points.positions()[index]);
        order.windows(2).map(|step| at(step[0]).distance(at(step[1]))).sum()
    }

    #[test]
    fn a_tour_through_random_points_is_nearly_as_short_as_one_can_be() {
        let points = white(Rectangle::new([0.0, 0.0], [1.0, 1.0]).unwrap(), 20_000, 3).unwrap();
        let expected = 0.7124 * 20_000f64.sqrt();
        let share = length(&points, &tour(&points, &RunContext::default())) / expected;
        assert!(share < 1.08, "{share}");
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(100) })]
        #[test]
        fn a_tour_visits_every_point_once_wherever_they_are(n in 1..200usize, seed in 0..1000u64, flat in 0..3, heap: bool) {
            let space: Space = match flat {
                0 => Torus::new([0.0, 0.0], [1.0, 1.0]).unwrap().into(),
                1 => Rectangle::new([1e9, -3.0], [100.0, 1.0]).unwrap().into(),
                _ => Rectangle::new([0.0, 0.0], [1e-9, 1e-9]).unwrap().into(),
            };
            let mut points = white(&space, n, seed).unwrap();
            if heap {
                let places = points.positions().iter().enumerate().map(|(k, &p)| if k % 3 == 0 { points.positions()[0] } else { p });
                points = PointSet::new(&space, places.collect()).unwrap();
            }
            let mut seen = tour(&points, &RunContext::default());
            prop_assert!(n < 20 || length(&points, &seen) <= 2.0 * (n as f64 * space.area()).sqrt() + space.size()[0] + space.size()[1]);
            seen.sort_unstable();
            prop_assert_eq!(seen, (0..n).collect::<Vec<_>>());
        }
    }
}
