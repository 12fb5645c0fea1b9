//! The exact Delaunay triangulation: periodic on a torus, of the convex hull in a rectangle.

use glam::DVec2;

use super::half_edges::smallest;
use super::mesh::Triangulation;
use super::{plane, torus};
use crate::error::Error;
use crate::space::Domain;

/// Triangulates distinct points that stand in Hilbert order; `order` holds the caller's index of each.
pub(crate) fn delaunay(domain: &Domain, points: Vec<DVec2>, order: Vec<u32>) -> Result<Triangulation, Error> {
    let triangulation = if domain.is_periodic { torus::delaunay(domain, &points, order)? } else { hull(domain, points, order)? };
    debug_assert_eq!(triangulation.check_delaunay(), Ok(()));
    Ok(triangulation)
}

/// Triangulates the convex hull: quickly, if that can be proved to be a triangulation, and then by Lawson's flips; otherwise exactly.
pub(super) fn hull(domain: &Domain, points: Vec<DVec2>, order: Vec<u32>) -> Result<Triangulation, Error> {
    let half_edges = plane::nearly_delaunay(plane::shaken(domain, &points).into_iter()).filtered(|_, t| Some(smallest(t)));
    let mut triangulation = Triangulation { half_edges, positions: points, domain: domain.clone(), copies: [1, 1], order };
    if triangulation.half_edges.n_triangles() > 0 && triangulation.check().is_ok() {
        triangulation.legalize();
        return Ok(triangulation);
    }
    triangulation.half_edges = plane::delaunay(triangulation.positions.iter().copied())?.filtered(|_, t| Some(smallest(t)));
    if triangulation.half_edges.n_triangles() == 0 {
        return Err(Error::Degenerate("all points lie on one line".into()));
    }
    Ok(triangulation)
}
