//! Spreads points evenly, but not regularly: blue noise.
//!
//! Numbers in, numbers out: no files, no clock, no printing, no global state. Threads are rayon's, and change no bit of any result.
//!
//! ```
//! use evenly::{ProcrustesParams, RunContext, Torus, measure, procrustes, warp, white};
//!
//! let mut points = white(Torus::new([0.0, 0.0], [1.0, 1.0])?, 2000, 7)?;
//! warp(&mut points);
//! procrustes(&mut points, &ProcrustesParams::default(), &mut RunContext::default())?;
//! assert!(measure(&points)?.angle_rms_deg < 11.0);
//! # Ok::<(), evenly::Error>(())
//! ```
//!
//! Lengths that are targets or measures are relative: 1 is the spacing of the hexagonal lattice with as many points,
//! [`PointSet::hex_spacing`]. Positions are in whatever units the domain has.

// The same bits on every platform: functions of crate `libm` alone.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod density;
mod error;
mod geometry;
mod imaging;
mod measure;
mod mesh;
mod methods;
mod parameter;
mod points;
mod polygon;
mod predicates;
mod remesh;
mod run;
mod space;
mod star;
mod surface;
mod sweep;
mod tour;
mod triangulation;

pub use density::Density;
pub use error::Error;
pub use geometry::spacing::{hexagonal_count, hexagonal_spacing, triangle_count, triangle_side};
pub use geometry::triangle::OBTUSE_DEG;
pub use imaging::{
    BilateralParams, Image, ImageDifference, ReconstructionFilter, Similarity, ZonePlate, ZonePlateParams, bilateral, dot_coverage,
    subsampled_bilateral, zone_plate,
};
pub use measure::{
    BoundaryMeasures, Measures, PointMeasures, PowerSpectrum, RadialSpectrum, SizeErrors, Tessellation, differential_spectrum,
    local_spacings, measure, measure_each, power_spectrum, radial_spectrum, tessellate,
};
pub use mesh::{EdgeKind, Mesh, MeshEdge, MeshParams, MeshQuality, MeshRegion, expected_triangles, mesh, mesh_cells, mesh_quality};
pub use methods::{
    CapacityParams, CvtParams, DistMeshParams, FarthestPointParams, LloydParams, LocalMethod, Method, Mode, OptBetaParams, Optimizer,
    ProcrustesParams, PushPullParams, PushPullPreset, Targets, UnmetTarget, WellSpacedParams, angle_bounds_deg, capacity, cvt, distmesh,
    farthest_point, lloyd, opt_beta, procrustes, push_pull, well_spaced,
};
pub use parameter::{About, Choice, Group, ParameterKind, Setting, Settings, Unit};
pub use points::{
    CANDIDATES_A_POINT, DartParams, MAX_POINTS, PointSet, PoissonDiskParams, dart, eliminate, hexagonal, jittered, poisson_disk,
    poisson_disk_around, poisson_disk_by_density, poisson_disk_of, poisson_disk_of_density, progressive, warp, warp_isotropic, white,
    white_by_density,
};
pub use polygon::{FillRule, Polygon, Shape};
pub use remesh::{RemeshParams, Remeshed, SampleParams, SurfacePoint, SurfaceSampling, remesh, sample_surface};
pub use run::{CancelToken, Outcome, Phase, Progress, Report, RunContext};
pub use space::{Rectangle, Region, Space, Torus};
pub use surface::{
    Attribute, CertificateBreach, MissedLengths, Surface, SurfaceDistance, SurfaceMeasures, SurfaceQuality, SurfaceSizing, TriangleMesh,
    certificate, expected_vertices, measure_on_surface, missed_lengths, self_intersections, surface_distance, surface_quality,
    surface_sizes, surface_spectrum,
};
pub use sweep::Schedule;
pub use tour::tour;
