//! [`Triangulation`]: topology in flat half-edges, positions beside it, never mixed.

mod check;
mod chunks;
mod half_edges;
mod plane;
mod torus;

pub(crate) use chunks::Chunks;
pub(crate) use half_edges::{BORDER, HalfEdges, next, prev, smallest};
pub(crate) use torus::cover;

use glam::DVec2;
use rayon::prelude::*;

use crate::Error;
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
    /// The exact Delaunay triangulation of distinct points: periodic on a torus, of the convex hull in a rectangle.
    ///
    /// `order` is their Hilbert order.
    pub fn delaunay(domain: &Domain, points: &[DVec2], order: Vec<u32>) -> Result<Self, Error> {
        let sorted = order.iter().map(|&i| points[i as usize]).collect();
        Self::delaunay_sorted(domain, sorted, order)
    }

    /// As [`Self::delaunay`], of points that stand in that order already.
    pub fn delaunay_sorted(domain: &Domain, points: Vec<DVec2>, order: Vec<u32>) -> Result<Self, Error> {
        let triangulation = if domain.is_periodic {
            torus::delaunay(domain, &points, order)?
        } else {
            let half_edges = plane::delaunay(points.iter().copied())?.filtered(|t| Some(smallest(t)));
            if half_edges.n_triangles() == 0 {
                return Err(Error::Degenerate("all points lie on one line".into()));
            }
            Self { half_edges, positions: points, domain: *domain, copies: [1, 1], order }
        };
        debug_assert_eq!(triangulation.check_delaunay(), Ok(()));
        Ok(triangulation)
    }

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

    /// The dual of the Voronoi diagram clipped to the domain: the triangles whose circumcentre lies inside. All of them on a torus.
    pub fn clipped(&self) -> HalfEdges {
        self.half_edges.filtered(|corners| self.has_centre_inside(corners).then_some(smallest(corners)))
    }

    fn has_centre_inside(&self, corners: [u32; 3]) -> bool {
        let (u, v) = self.spokes(corners);
        self.domain.is_periodic || self.domain.contains(self.positions[corners[0] as usize] + circumcentre(u, v))
    }

    /// Whether the edge of `h` must be flipped: the vertex across lies inside the circumcircle. Exact; never on a border.
    #[inline]
    fn is_illegal(&self, h: u32) -> bool {
        let mesh = &self.half_edges;
        let twin = mesh.twin[h as usize];
        if twin == BORDER {
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
                self.half_edges.flip(h);
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
