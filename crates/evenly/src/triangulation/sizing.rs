//! [`Sizing`]: a spacing for every place, given at the vertices of a triangulation and linear in between.

use glam::DVec2;

use super::half_edges::{BOUNDARY, HalfEdges};

/// More steps than a walk to a place nearby ever takes.
const MAX_STEPS: usize = 1000;

/// The wanted spacing, in normalised units, over a triangulated domain.
#[derive(Debug, Clone)]
pub(crate) struct Sizing {
    pub half_edges: HalfEdges,
    pub positions: Vec<DVec2>,
    /// At each vertex; positive.
    pub sizes: Vec<f64>,
}

impl Sizing {
    /// The spacing at `p`. The walk there begins in triangle `hint`, and leaves there the triangle where it ends: that of `p`, or the last before a boundary in
    /// between.
    pub fn at(&self, p: DVec2, hint: &mut u32) -> f64 {
        let mut t = *hint;
        for _ in 0..MAX_STEPS {
            let corners = self.half_edges.triangle(t as usize).map(|v| self.positions[v as usize]);
            let side = |k: usize| (corners[(k + 1) % 3] - corners[k]).perp_dot(p - corners[k]);
            let sides = [side(0), side(1), side(2)];
            // Across the side that lies most in the way.
            let across = (0..3).filter(|&k| sides[k] < 0.0).map(|k| (sides[k], self.half_edges.twin[3 * t as usize + k]));
            match across.filter(|&(_, twin)| twin != BOUNDARY).min_by(|(a, _), (b, _)| a.total_cmp(b)) {
                Some((_, twin)) => t = twin / 3,
                None => break,
            }
        }
        *hint = t;
        self.within(p, t)
    }

    /// The spacing in triangle `t`, where that is nearest to `p`.
    fn within(&self, p: DVec2, t: u32) -> f64 {
        let corners = self.half_edges.triangle(t as usize);
        let [a, b, c] = corners.map(|v| self.positions[v as usize]);
        let shares = [(c - b).perp_dot(p - b), (a - c).perp_dot(p - c), (b - a).perp_dot(p - a)].map(|share| share.max(0.0));
        let whole: f64 = shares.iter().sum();
        let [of_a, of_b, of_c] = corners.map(|v| self.sizes[v as usize]);
        if whole > 0.0 { (shares[0] * of_a + shares[1] * of_b + shares[2] * of_c) / whole } else { of_a.min(of_b).min(of_c) }
    }
}
