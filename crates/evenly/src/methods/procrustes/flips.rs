//! Step 3 of Procrustes analysis: which edges are flipped.

use glam::DVec2;

use super::model::{H, Sides, amplitude as fitted};
use crate::space::Domain;
use crate::triangulation::{BOUNDARY, Patch, prev};

/// When an edge is flipped.
pub(super) struct FlipRule<'a> {
    pub positions: &'a [DVec2],
    pub domain: &'a Domain,
    /// Of the model triangle. All four that a flip concerns are compared with one, that of the middle of their corners.
    pub sides: &'a Sides,
}

impl FlipRule<'_> {
    /// Visits each edge of a patch once. Edges, and wanted flips, that reach out of it go to `leftovers`.
    ///
    /// Block by block the edges are listed and sifted without a branch, since nearly all of them stay.
    pub fn visit_all(&self, patch: &mut Patch, amplitude: &mut [f64], leftovers: &mut Vec<u32>) -> usize {
        const BLOCK: usize = 1 << 10;
        let mut listed = [0; BLOCK + 1];
        let (first, end) = (patch.first, patch.first + patch.origin.len() as u32);
        let mut n_flips = 0;
        for start in (first..end).step_by(BLOCK) {
            let mut n_listed = 0;
            for h in start..end.min(start + BLOCK as u32) {
                listed[n_listed] = h;
                // An edge is visited from its smaller half; BOUNDARY wraps to 0.
                n_listed += usize::from(patch.twin[(h - first) as usize].wrapping_add(1) > h);
            }
            let mut n_left = 0;
            for i in 0..n_listed {
                let h = listed[i];
                listed[n_left] = h;
                n_left += usize::from(self.may_pay(patch, amplitude, h, leftovers));
            }
            n_flips += listed[..n_left].iter().filter(|&&h| self.visit(patch, amplitude, h, leftovers)).count();
        }
        n_flips
    }

    /// Whether flipping the edge of `h` could lower the energy, by a bound that needs no root: most edges are settled here.
    ///
    /// The areas' sum stays, so the energy falls with the sum of (|A| - c)^2, c = (sqrt(3)/2) d. The sum of |A|^2 changes by the
    /// diagonals' squares, and by Cauchy-Schwarz the sum of |A| is at most the root of twice that.
    #[inline]
    fn may_pay(&self, patch: &Patch, amplitude: &[f64], h: u32, leftovers: &mut Vec<u32>) -> bool {
        let i = (h - patch.first) as usize;
        let Some(j) = patch.local(patch.twin[i]) else {
            leftovers.push(h);
            return false;
        };
        let at = |i: usize| self.positions[patch.origin[i] as usize];
        let (p, apexes) = (at(i), [at(prev(i as u32) as usize), at(prev(j as u32) as usize)]);
        let edge = self.domain.spoke(p, at(j));
        let kept = edge.length_squared();
        let other = self.domain.spoke(apexes[0], apexes[1]).length_squared();
        let (a, b) = (amplitude[i / 3], amplitude[j / 3]);
        let middle = || p + 0.25 * (edge + apexes.iter().map(|&apex| self.domain.spoke(p, apex)).sum::<DVec2>());
        let c = H * if self.sides.field.is_some() { self.sides.at(middle()) } else { self.sides.mean };
        let squares = a * a + b * b + other - kept;
        let needed = other - kept + 2.0 * c * (a + b);
        needed < 0.0 || needed * needed < 8.0 * c * c * squares
    }

    /// Flips the edge of half-edge `h` if that pays, or hands it on where it reaches out of the patch.
    pub fn visit(&self, patch: &mut Patch, amplitude: &mut [f64], h: u32, leftovers: &mut Vec<u32>) -> bool {
        let i = (h - patch.first) as usize;
        let t = patch.twin[i];
        let Some(j) = patch.local(t) else {
            if t != BOUNDARY {
                leftovers.push(h);
            }
            return false;
        };
        let flipped = self.flipped_amplitudes(patch.quadrilateral(h, t), [amplitude[i / 3], amplitude[j / 3]]);
        let Some(flipped) = flipped else { return false };
        if !patch.flip(h) {
            leftovers.push(h);
            return false;
        }
        [amplitude[i / 3], amplitude[j / 3]] = flipped;
        true
    }

    /// The new |A| of the triangles (s q r) and (r p s), if replacing (p q r) and (q p s) by them lowers the energy and turns none over.
    fn flipped_amplitudes(&self, [p, q, r, s]: [u32; 4], [a, b]: [f64; 2]) -> Option<[f64; 2]> {
        let at = |v: u32| self.positions[v as usize];
        let spoke = |v: u32| self.domain.spoke(at(p), at(v));
        let (pq, pr, ps) = (spoke(q), spoke(r), spoke(s));
        let c = H * self.sides.at(at(p) + 0.25 * (pq + pr + ps));
        let (sq, sr) = (pq - ps, pr - ps);
        let (new_a, new_b) = (fitted(sq, sr), fitted(ps, pr));
        let excess = |a: f64, b: f64| (a - c) * (a - c) + (b - c) * (b - c);
        let gain = excess(a, b) - excess(new_a, new_b);
        // A gain within rounding could be taken back and forth for ever.
        let pays = gain > 1e-12 * c * c;
        let stand = self.domain.is_upright(ps, pr) && self.domain.is_upright(sq, sr);
        // In gaps triangles count for nothing; which edges are there is found when the triangulation is rebuilt.
        let is_in_gap = || [pq + pr, pq + ps, pr + ps, pq + pr + ps].iter().any(|sum| self.sides.is_gap(at(p) + *sum / 3.0));
        (pays && stand && !is_in_gap()).then_some([new_a, new_b])
    }
}
