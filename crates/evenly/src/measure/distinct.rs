//! Points that share a place have one cell, and are triangulated once.

use glam::DVec2;

use crate::density::Field;
use crate::error::Error;
use crate::points::{PointSet, hilbert_order};
use crate::space::Domain;
use crate::triangulation::{LiveMesh, Triangulation, delaunay};

/// The triangulation of the distinct points among some.
pub(super) struct Distinct {
    pub triangulation: Triangulation,
    /// Points that share their place with an earlier one.
    pub coincident_points: usize,
    /// Whether more than one point takes a vertex's place.
    pub is_shared: Vec<bool>,
    /// The vertex that takes each point's place.
    pub vertex_of: Vec<u32>,
}

impl Distinct {
    /// Triangulates points, at least three of them distinct.
    pub fn triangulate(points: &PointSet) -> Result<Self, Error> {
        let (domain, positions) = points.normalized();
        let order = hilbert_order(&positions, domain.size);
        let mut sorted: Vec<(DVec2, u32)> = order.iter().map(|&i| (positions[i as usize], i)).collect();
        let is_shared = sorted.chunk_by(|a, b| a.0 == b.0).map(|place| place.len() > 1).collect();
        let mut vertex_of = vec![0; positions.len()];
        for (vertex, place) in (0..).zip(sorted.chunk_by(|a, b| a.0 == b.0)) {
            place.iter().for_each(|&(_, point)| vertex_of[point as usize] = vertex);
        }
        sorted.dedup_by_key(|(p, _)| *p);
        if sorted.len() < 3 {
            let text = format!("{} distinct points make no triangulation; measures need three", sorted.len());
            return Err(Error::Degenerate(text));
        }
        let coincident_points = positions.len() - sorted.len();
        let (sorted, order) = sorted.into_iter().unzip();
        let triangulation = delaunay(&domain, sorted, order)?;
        Ok(Self { triangulation, coincident_points, is_shared, vertex_of })
    }

    /// The domain: not a cover.
    pub fn domain(&self) -> Domain {
        self.triangulation.domain.uncovered(self.triangulation.copies)
    }

    /// The same points in a mesh whose stars know the boundary and the density, in units of their own spacing.
    pub fn live(&self, field: Option<Field>) -> Result<LiveMesh, Error> {
        let (domain, n_points) = (self.domain(), self.triangulation.n_base());
        let (order, spacing) = ((0..n_points as u32).collect(), domain.hex_spacing(n_points));
        if domain.is_periodic {
            return Ok(LiveMesh::of(&domain, field, Triangulation { order, ..self.triangulation.clone() }, spacing));
        }
        LiveMesh::new(&domain, field, self.triangulation.positions.clone(), order, spacing)
    }
}
