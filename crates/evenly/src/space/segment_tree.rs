//! [`SegmentTree`]: segments in boxes in boxes, so that few are looked at, however unevenly they lie.

use std::cell::Cell;

use glam::DVec2;

/// Segments in a leaf at most.
const LEAF: usize = 4;
/// No tree is deeper: each level halves the number of segments.
const DEEPEST: usize = 64;

/// Segments by where they are; each has a number, in the order in which they were given.
#[derive(Debug)]
pub(crate) struct SegmentTree {
    nodes: Vec<Node>,
    /// The segments leaf by leaf, with their numbers.
    segments: Vec<([DVec2; 2], u32)>,
}

#[derive(Debug)]
struct Node {
    low: DVec2,
    high: DVec2,
    /// Of a leaf its first segment; of others the second child, while the first follows its parent.
    first: u32,
    /// 0 for a node with children.
    n_segments: u32,
}

impl SegmentTree {
    pub fn new(segments: &[[DVec2; 2]]) -> Self {
        let segments = segments.iter().copied().zip(0..).collect();
        let mut tree = Self { nodes: Vec::new(), segments };
        if !tree.segments.is_empty() {
            tree.build(0, tree.segments.len());
        }
        tree
    }

    fn build(&mut self, begin: usize, end: usize) {
        let segments = &mut self.segments[begin..end];
        let n_segments = segments.len();
        let ends = || segments.iter().flat_map(|(ends, _)| ends);
        let low = ends().copied().fold(DVec2::INFINITY, DVec2::min);
        let high = ends().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
        let node = self.nodes.len();
        let is_leaf = n_segments <= LEAF;
        self.nodes.push(Node { low, high, first: begin as u32, n_segments: if is_leaf { n_segments as u32 } else { 0 } });
        if is_leaf {
            return;
        }
        let middle = |(ends, _): &([DVec2; 2], u32)| ends[0] + ends[1];
        let span = segments.iter().map(middle).fold(DVec2::NEG_INFINITY, DVec2::max)
            - segments.iter().map(middle).fold(DVec2::INFINITY, DVec2::min);
        let axis = usize::from(span.y > span.x);
        segments.select_nth_unstable_by(n_segments / 2, |a, b| middle(a)[axis].total_cmp(&middle(b)[axis]).then(a.1.cmp(&b.1)));
        let half = begin + n_segments / 2;
        self.build(begin, half);
        self.nodes[node].first = self.nodes.len() as u32;
        self.build(half, end);
    }

    /// Shows segments until one is what is looked for: those of leaves of which `may_hold`, asked with their boxes and those around, says that they may.
    #[inline]
    pub fn find(&self, mut may_hold: impl FnMut(DVec2, DVec2) -> bool, mut is_it: impl FnMut([DVec2; 2], u32) -> bool) -> bool {
        let mut stack = [0u32; DEEPEST];
        let mut n = usize::from(!self.nodes.is_empty());
        while n > 0 {
            n -= 1;
            let at = stack[n];
            let node = &self.nodes[at as usize];
            if !may_hold(node.low, node.high) {
                continue;
            }
            if node.n_segments == 0 {
                (stack[n], stack[n + 1]) = (node.first, at + 1);
                n += 2;
                continue;
            }
            let leaf = &self.segments[node.first as usize..(node.first + node.n_segments) as usize];
            if leaf.iter().any(|&(ends, number)| is_it(ends, number)) {
                return true;
            }
        }
        false
    }

    /// How far the nearest segment is from `p`; `most` where that is less.
    pub fn distance(&self, p: DVec2, most: f64) -> f64 {
        // Boxes are asked about while segments come nearer.
        let least = Cell::new(most * most);
        let may_hold = |low: DVec2, high: DVec2| p.distance_squared(p.clamp(low, high)) < least.get();
        self.find(may_hold, |ends, _| {
            least.set(least.get().min(p.distance_squared(nearest(p, ends))));
            false
        });
        least.get().sqrt()
    }
}

/// The place on a segment that is nearest to `p`.
pub(crate) fn nearest(p: DVec2, [a, b]: [DVec2; 2]) -> DVec2 {
    let way = b - a;
    let share = (p - a).dot(way) / way.length_squared();
    // A segment without a length is its own nearest place.
    if share.is_nan() { a } else { a + share.clamp(0.0, 1.0) * way }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::points::Random;

    #[test]
    fn nothing_in_a_box_is_left_out() {
        let mut random = Random::new(1, 1);
        for n in [0, 1, 3, 4, 5, 100, 1000] {
            let mut place = |size: f64| size * DVec2::new(random.unit(), random.unit());
            // Nearly all in one corner.
            let segments: Vec<[DVec2; 2]> =
                (0..n).map(|k| if k % 50 == 0 { [place(1.0), place(1.0)] } else { [place(0.01), place(0.01)] }).collect();
            let tree = SegmentTree::new(&segments);
            for _ in 0..50 {
                let low = place(0.02);
                let high = low + place(0.01);
                let meets = |a: DVec2, b: DVec2| a.cmple(high).all() && b.cmpge(low).all();
                let mut found = Vec::new();
                tree.find(meets, |[a, b], number| {
                    if meets(a.min(b), a.max(b)) {
                        found.push(number);
                    }
                    false
                });
                found.sort_unstable();
                let p = place(0.02);
                let expected = segments.iter().map(|&ends| p.distance(nearest(p, ends))).fold(0.015, f64::min);
                assert_eq!(tree.distance(p, 0.015), expected);
                let all = (0..).zip(&segments).filter(|(_, [a, b])| meets(a.min(*b), a.max(*b)));
                assert_eq!(found, all.map(|(number, _)| number).collect::<Vec<u32>>());
            }
        }
    }
}
