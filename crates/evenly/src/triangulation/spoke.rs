//! [`Spoke`]: what a vertex of the mesh sees of a neighbour.

use glam::DVec2;

/// A half-edge from the vertex at hand to a neighbour, and the wedge between it and the next one, counter-clockwise.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Spoke<W = DVec2> {
    /// A neighbour, or [`MIRROR`].
    pub vertex: u32,
    /// The half-edge there; [`BOUNDARY`](super::half_edges::BOUNDARY) for the last one of a fan.
    pub half_edge: u32,
    /// Whether it is there once more, across the boundary on which the vertex is: the neighbour itself is seen too.
    pub is_echo: bool,
    pub way: W,
    /// In spacings; only in a star.
    pub length: f64,
    pub squared: f64,
    pub dot: f64,
    pub cross: f64,
}

/// In place of a neighbour: the vertex' own image behind a wall.
pub(crate) const MIRROR: u32 = u32::MAX;
