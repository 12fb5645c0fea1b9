//! Rings without what says nothing: doubled points, spikes, points on straight lines, rings without an area.

use glam::DVec2;

use super::counted;
use crate::space::Domain;

/// What is nearer to a straight line than this, in normalised units, lies on it: rounding has moved points on slanted lines off them.
const STRAIGHT: f64 = 1e-12;

/// A corner of a ring, normalised and as it was given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Corner {
    pub at: DVec2,
    pub input: [f64; 2],
}

/// How much was left out.
#[derive(Default)]
pub(super) struct LeftOut {
    doubled: usize,
    spikes: usize,
    straight: usize,
    rings: usize,
}

impl LeftOut {
    /// The same in words.
    pub fn told(&self) -> impl Iterator<Item = String> {
        let counts = [
            (self.doubled, "point is there twice", "points are there twice"),
            (self.spikes, "corner is the tip of a spike without width", "corners are tips of spikes without width"),
            (self.straight, "point lies on a straight line", "points lie on straight lines"),
            (self.rings, "ring has no area", "rings have no area"),
        ];
        counts.into_iter().filter(|&(n, ..)| n > 0).map(|(n, one, many)| format!("{}: left out", counted(n, one, many)))
    }
}

/// The clean rings that have an area.
pub(super) fn clean(rings: &[Vec<[f64; 2]>], domain: &Domain, left_out: &mut LeftOut) -> Vec<Vec<Corner>> {
    let mut kept = Vec::new();
    for ring in rings {
        // A zero has no sign here, so that equal places have equal bits.
        let corners = ring.iter().map(|&input| Corner { at: domain.normalize(input) + 0.0, input });
        let corners = clean_ring(corners.collect(), left_out);
        if corners.len() < 3 {
            left_out.rings += 1;
        } else {
            kept.push(corners);
        }
    }
    kept
}

/// Leaves out corner by corner what says nothing, until each turns.
fn clean_ring(mut ring: Vec<Corner>, left_out: &mut LeftOut) -> Vec<Corner> {
    if ring.len() > 1 && ring.first().map(|corner| corner.at) == ring.last().map(|corner| corner.at) {
        // The first point once more: rings may end with it.
        ring.pop();
    }
    let mut kept: Vec<Corner> = Vec::with_capacity(ring.len());
    for corner in ring {
        push(&mut kept, corner, left_out);
    }
    // The seam: the last corners against the first.
    loop {
        let n = kept.len();
        if n < 3 {
            return Vec::new();
        }
        if let Some(which) = flaw(kept[n - 2], kept[n - 1], kept[0]) {
            count(which, left_out);
            kept.pop();
        } else if let Some(which) = flaw(kept[n - 1], kept[0], kept[1]) {
            count(which, left_out);
            kept.remove(0);
        } else {
            return kept;
        }
    }
}

enum Flaw {
    Doubled,
    Spike,
    Straight,
}

/// What is wrong with `b` between `a` and `c`.
fn flaw(a: Corner, b: Corner, c: Corner) -> Option<Flaw> {
    let (u, v) = (b.at - a.at, c.at - b.at);
    if u == DVec2::ZERO || v == DVec2::ZERO {
        return Some(Flaw::Doubled);
    }
    if u.perp_dot(v).abs() > STRAIGHT * u.length().max(v.length()) {
        return None;
    }
    Some(if u.dot(v) < 0.0 { Flaw::Spike } else { Flaw::Straight })
}

fn count(flaw: Flaw, left_out: &mut LeftOut) {
    match flaw {
        Flaw::Doubled => left_out.doubled += 1,
        Flaw::Spike => left_out.spikes += 1,
        Flaw::Straight => left_out.straight += 1,
    }
}

/// Adds a corner, and leaves out those before it that say nothing then.
fn push(kept: &mut Vec<Corner>, corner: Corner, left_out: &mut LeftOut) {
    if kept.last().is_some_and(|last| last.at == corner.at) {
        left_out.doubled += 1;
        return;
    }
    while let [.., a, b] = kept[..]
        && let Some(which) = flaw(a, b, corner)
    {
        count(which, left_out);
        kept.pop();
        if kept.last().is_some_and(|last| last.at == corner.at) {
            return;
        }
    }
    kept.push(corner);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Rectangle, Space};

    #[test]
    fn what_says_nothing_is_left_out_and_told() {
        let space: Space = Rectangle::new([0.0, 0.0], [4.0, 4.0]).unwrap().into();
        let ring = vec![
            [0.0, 0.0],
            [2.0, 0.0],
            [4.0, 0.0],
            [4.0, 0.0],
            [4.0, 2.0],
            [4.5, 2.0].map(|x: f64| x.min(4.0)),
            [4.0, 4.0],
            [4.0, 3.5],
            [4.0, 4.0],
            [0.0, 4.0],
            [0.0, 1.0],
            [0.0, 0.0],
        ];
        let line = vec![[1.0, 1.0], [2.0, 2.0], [3.0, 3.0]];
        let mut left_out = LeftOut::default();
        let kept = clean(&[ring, line], &space.domain(), &mut left_out);
        assert_eq!(kept.len(), 1);
        let corners: Vec<[f64; 2]> = kept[0].iter().map(|corner| corner.input).collect();
        assert_eq!(corners, [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]);
        assert_eq!(left_out.told().count(), 4);
    }
}
