//! [`Triangulation`]: topology in flat half-edges, positions beside it, never mixed.

mod check;
mod chunks;
mod delaunay;
mod half_edges;
mod mesh;
mod patch;
mod plane;
mod torus;

pub(crate) use chunks::Chunks;
pub(crate) use delaunay::{delaunay, delaunay_sorted};
pub(crate) use half_edges::{BORDER, HalfEdges, next, prev};
pub(crate) use mesh::{Triangulation, circumcentre};
pub(crate) use patch::Patch;
pub(crate) use torus::cover;
