//! [`sampled`]: points on a surface as they are wished for, whoever wishes them.

use std::path::Path;

use evenly::{Report, RunContext, Surface, SurfacePoint, SurfaceSampling, sample_surface};

use crate::measured::told;
use crate::memory;
use crate::parse::read_words;
use crate::remesh_args::SampleRule;
pub use crate::remesh_args::SampleWishes;
use crate::remeshed::number_of;

/// Parameters, and the flags that hold them.
const FLAGS: [(&str, &str); 2] = [("n_points", "n-points"), ("spacing", "spacing")];

/// Spreads points; of wishes in words see [`wishes`].
///
/// # Errors
/// As [`sample_surface`], with the names of flags; `name` is the mesh's.
pub fn sampled(surface: &Surface, name: &Path, wishes: &SampleWishes, run: &mut RunContext) -> anyhow::Result<(Vec<SurfacePoint>, Report)> {
    let n_points = number_of(surface, wishes.n_points, wishes.spacing)?.unwrap_or_default();
    memory::require_vertices(n_points)?;
    let sampling = match (wishes.method, wishes.spacing) {
        (SampleRule::PushPull, _) => SurfaceSampling::PushPull(n_points),
        (SampleRule::Eliminate, _) => SurfaceSampling::Eliminate(n_points),
        (SampleRule::White, _) => SurfaceSampling::White(n_points),
        (SampleRule::PoissonDisk, Some(spacing)) => SurfaceSampling::PoissonDisk(spacing),
        (SampleRule::PoissonDisk, None) => SurfaceSampling::poisson_disk_of(surface, n_points),
    };
    sample_surface(surface, sampling, wishes.seed, run).map_err(|e| told(e, name, &FLAGS))
}

/// Wishes in the command line's words, as `--n-points=1000`.
///
/// # Errors
/// What the command line says of them.
pub fn wishes(words: &[String]) -> anyhow::Result<SampleWishes> {
    read_words(words)
}
