//! [`Triangulation`]: a mesh with positions, on a domain.

use glam::DVec2;
use rayon::prelude::*;

use super::half_edges::{BOUNDARY, HalfEdges, next, prev};
use super::patch::Patch;
use crate::predicates::is_in_circle;
use crate::space::Domain;

/// A triangulation of points in a domain. On a torus with few points or big voids it is that of a finite cover.
#[derive(Debug, Clone)]
pub(crate) struct Triangulation {
    pub half_edges: HalfEdges,
    /// Vertex positions in Hilbert order: first those of the base domain, then of each further copy.
    pub positions: Vec<DVec2>,
    /// The domain that the triangulation fills: the cover, where there is one.
    pub domain: Domain,
    /// How many copies of the base domain lie side by side along each axis; `[1, 1]` but for few points or big voids.
    pub copies: [u32; 2],
    /// The caller's index of each vertex of the base domain.
    pub order: Vec<u32>,
}

impl Triangulation {
    /// How many vertices are not copies of another.
    pub fn n_base(&self) -> usize {
        self.order.len()
    }

    /// The triangle's two edge vectors from its first corner. Exact.
    #[inline]
    pub fn spokes(&self, [a, b, c]: [u32; 3]) -> (DVec2, DVec2) {
        let at = |v: u32| self.positions[v as usize];
        (self.domain.spoke(at(a), at(b)), self.domain.spoke(at(a), at(c)))
    }

    /// Whether the centre of a triangle's circumcircle lies inside.
    pub(super) fn has_centre_inside(&self, corners: [u32; 3]) -> bool {
        let (u, v) = self.spokes(corners);
        self.domain.contains(self.positions[corners[0] as usize] + circumcentre(u, v))
    }

    /// Whether the edge of `h` must be flipped: the vertex across lies inside the circumcircle. Exact; never on a boundary.
    #[inline]
    pub fn is_illegal(&self, h: u32) -> bool {
        let mesh = &self.half_edges;
        let twin = mesh.twin[h as usize];
        if twin == BOUNDARY {
            return false;
        }
        let at = |h: u32| self.positions[mesh.origin[h as usize] as usize];
        let spoke = |to: u32| self.domain.spoke(at(h), at(to));
        is_in_circle(spoke(next(h)), spoke(prev(h)), spoke(prev(twin)))
    }

    /// Lawson's flips: makes any triangulation Delaunay.
    pub fn legalize(&mut self) {
        let mut suspects: Vec<u32> = (0..self.half_edges.origin.len() as u32)
            .into_par_iter()
            .filter(|&h| self.half_edges.twin[h as usize] > h && self.is_illegal(h))
            .collect();
        while let Some(h) = suspects.pop() {
            if self.is_illegal(h) {
                let t = self.half_edges.twin[h as usize];
                Patch::whole(&mut self.half_edges).flip(h);
                suspects.extend([h, t, next(h), next(t)]);
            }
        }
    }
}

/// The vector from the first corner of a triangle to its circumcentre, from its two spokes at that corner.
#[inline]
pub(crate) fn circumcentre(u: DVec2, v: DVec2) -> DVec2 {
    let (uu, vv) = (u.length_squared(), v.length_squared());
    DVec2::new(v.y * uu - u.y * vv, u.x * vv - v.x * uu) / (2.0 * u.perp_dot(v))
}
