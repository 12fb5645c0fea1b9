//! [`sampled`]: points on a surface as they are wished for, whoever wishes them.

use std::path::Path;

use evenly::{Report, RunContext, SampleParams, Surface, SurfacePoint, SurfaceSampling, SurfaceSizing, sample_surface, surface_sizes};

use crate::measured::told;
use crate::memory;
use crate::method::{POISSON_DISK, WHITE};
use crate::parse::read_words;
pub use crate::remesh_args::SampleWishes;
use crate::remeshed::{method_of, number_of};

/// Parameters, and the flags that hold them.
const FLAGS: [(&str, &str); 6] = [
    ("n_points", "n-points"),
    ("spacing", "spacing"),
    ("error", "density curvature"),
    ("sizes", "density"),
    ("linear", "density linear"),
    ("attr", "density attr"),
];

/// Spreads points; of wishes in words see [`wishes`].
///
/// # Errors
/// As [`sample_surface`], with the names of flags; `name` is the mesh's.
pub fn sampled(
    surface: &Surface,
    name: &Path,
    wishes: &SampleWishes,
    sizing: Option<&SurfaceSizing>,
    run: &mut RunContext,
) -> anyhow::Result<(Vec<SurfacePoint>, Report)> {
    let told = |e| told(e, name, &FLAGS);
    let n_points = number_of(surface, wishes.n_points, ("spacing", wishes.spacing))?.unwrap_or_default();
    memory::require_vertices(n_points)?;
    let sampling = match (wishes.method.name(), wishes.spacing) {
        (WHITE, _) => SurfaceSampling::White(n_points),
        (POISSON_DISK, Some(spacing)) => SurfaceSampling::PoissonDisk(spacing),
        (POISSON_DISK, None) => SurfaceSampling::poisson_disk_of(surface, n_points),
        _ => SurfaceSampling::Vertices(n_points, method_of(wishes.method, &wishes.method_args, wishes.seed)?),
    };
    wishes.method_args.refuse_others(&[wishes.method])?;
    let sizes = sizing.map_or(Ok(Vec::new()), |sizing| surface_sizes(surface, sizing, Some(n_points))).map_err(told)?;
    sample_surface(surface, &SampleParams { sampling, sizes, seed: wishes.seed }, run).map_err(told)
}

/// Wishes in the command line's words, as `--n-points=1000`.
///
/// # Errors
/// What the command line says of them.
pub fn wishes(words: &[String]) -> anyhow::Result<SampleWishes> {
    read_words(words)
}
