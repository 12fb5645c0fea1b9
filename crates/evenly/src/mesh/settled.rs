//! [`Settled`]: the points of a mesh in their places, triangulated.

use std::collections::HashMap;
use std::sync::Arc;

use crate::triangulation::{LiveMesh, Sizing, Track, Triangulation};

/// Points in their places, triangulated.
pub(super) struct Settled {
    pub triangulation: Triangulation,
    /// For each vertex where it may go.
    pub tracks: Vec<Track>,
    /// The outline's point that each vertex is.
    pub corners: Vec<u32>,
    /// The edges on the boundary and lines by their vertices, and the outline's segment on which each lies.
    pub edges: Vec<([u32; 2], u32)>,
    /// The wanted spacing at each vertex, in the domain's units, and for every place; with the triangle there of each vertex.
    pub sizes: Vec<f64>,
    pub sizing: Arc<Sizing>,
    pub hints: Vec<u32>,
}

impl Settled {
    /// The state of a mesh whose points are these of the outline; `None` where nothing holds them.
    pub fn new(mesh: &LiveMesh, triangulation: Triangulation, corners: &[u32]) -> Option<Self> {
        let (bonds, source) = mesh.bonds()?;
        // Edges are on rails between vertices as they are between points; a point's several vertices are told apart by the triangulation.
        let rails: HashMap<[u32; 2], u32> = bonds.edges.iter().map(|edge| (edge.ends, edge.rail)).collect();
        let half_edges = &triangulation.half_edges;
        let ends = (0..half_edges.origin.len() as u32).map(|h| [half_edges.origin[h as usize], half_edges.target(h)]);
        let edges = ends.filter_map(|ends| Some((ends, *rails.get(&ends.map(|v| source[v as usize]))?))).collect();
        Some(Self {
            tracks: source.iter().map(|&point| bonds.tracks[point as usize]).collect(),
            corners: source.iter().map(|&point| corners[point as usize]).collect(),
            edges,
            hints: source.iter().map(|&point| bonds.hints[point as usize]).collect(),
            sizing: Arc::clone(&bonds.sizing),
            sizes: (0..source.len() as u32).map(|v| mesh.local_spacing(v)).collect(),
            triangulation,
        })
    }
}
