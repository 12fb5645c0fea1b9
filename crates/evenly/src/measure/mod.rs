//! The proof: what a point set is worth, measured on a fresh exact Delaunay triangulation of it.

mod bessel;
mod correlation;
mod differential;
mod distinct;
mod each;
mod measures;
mod power;
mod radial;
mod rows;
mod sets;
mod sight;
mod size_error;
mod star;
mod tessellation;
mod triangles;
mod voronoi;
mod weighted;

pub(crate) use correlation::{BINS, level};
pub use differential::{differential_spectrum, local_spacings};
pub use each::{PointMeasures, measure_each};
pub use measures::{BoundaryMeasures, Measures, measure};
pub use power::{PowerSpectrum, power_spectrum};
pub use radial::{RadialSpectrum, radial_spectrum};
pub use size_error::SizeErrors;
pub use tessellation::{Tessellation, tessellate};
