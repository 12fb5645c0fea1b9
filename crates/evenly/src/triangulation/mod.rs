//! [`Triangulation`]: topology in flat half-edges, positions beside it, never mixed.

mod check;
mod chunks;
mod delaunay;
mod frame;
mod half_edges;
mod held;
mod live;
mod mesh;
mod patch;
mod planar;
mod plane;
mod refine;
mod relocate;
mod shared;
mod sizing;
mod spoke;
mod stars;
mod torus;
mod transplant;
mod walls;

pub(crate) use chunks::Chunks;
pub(crate) use delaunay::delaunay;
pub(crate) use half_edges::{BORDER, HalfEdges, next, prev};
pub(crate) use held::{Bonds, Edge, Track};
pub(crate) use live::{LiveMesh, Outside};
pub(crate) use mesh::{Triangulation, circumcentre};
pub(crate) use patch::Patch;
pub(crate) use planar::{Crossing, Graph, Planar, planar};
pub(crate) use refine::{Refinement, Refining};
pub(crate) use shared::Territory;
pub(crate) use sizing::Sizing;
pub(crate) use spoke::MIRROR;
pub(crate) use stars::StarBuffer;
pub(crate) use torus::cover;
pub(crate) use transplant::Transplant;
