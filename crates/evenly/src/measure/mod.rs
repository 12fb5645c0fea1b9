//! The proof: what a point set is worth, measured on a fresh exact Delaunay triangulation of it.

mod distinct;
mod measures;
mod radial;
mod star;
mod tessellation;
mod triangles;
mod voronoi;

pub use measures::{BorderMeasures, Measures, measure};
pub use radial::{RadialSpectrum, radial_spectrum};
pub use tessellation::{Tessellation, tessellate};
