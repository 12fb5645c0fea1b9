//! Dots spread by a density.

use anyhow::bail;
use evenly::{
    CapacityParams, Density, DistMeshParams, LloydParams, PointSet, ProcrustesParams, PushPullParams, RunContext, Space, WellSpacedParams,
};

use crate::method::Method;
use crate::method_args::{by_flag, start};
use crate::optimizer::Optimizer;

/// Passes after which the eye sees no difference any more; targets need not be met for a drawing.
const PASSES: usize = 60;

/// The optimiser that a drawing takes; `None` for a method that makes points at once.
///
/// # Errors
/// No iterations, or some for a method that is no optimiser.
pub fn optimizer(method: Method, iterations: Option<usize>, seed: u64) -> anyhow::Result<Option<Box<dyn Optimizer>>> {
    let max_passes = Some(iterations.unwrap_or(PASSES));
    let lloyd = LloydParams { seed, ..LloydParams::default() };
    let distmesh = DistMeshParams { seed, ..DistMeshParams::default() };
    let procrustes = ProcrustesParams::default();
    let optimizer: Box<dyn Optimizer> = match method {
        Method::PushPull => Box::new(PushPullParams { max_passes, seed, ..PushPullParams::default() }),
        Method::WellSpaced => Box::new(WellSpacedParams { max_passes, seed, ..WellSpacedParams::default() }),
        Method::Capacity => Box::new(CapacityParams { max_passes, seed, ..CapacityParams::default() }),
        Method::Lloyd => Box::new(LloydParams { iterations: iterations.unwrap_or(lloyd.iterations), ..lloyd }),
        Method::DistMesh => Box::new(DistMeshParams { iterations: iterations.unwrap_or(distmesh.iterations), ..distmesh }),
        Method::Procrustes => Box::new(ProcrustesParams { max_iterations: iterations.unwrap_or(procrustes.max_iterations), ..procrustes }),
        _ if iterations.is_some() => bail!("--iterations is for optimisers; {} is none", method.name()),
        _ => return Ok(None),
    };
    optimizer.check().map_err(by_flag)?;
    Ok(Some(optimizer))
}

/// As many dots as are asked for, spread as a density wants them.
///
/// # Errors
/// As the methods.
pub fn spread(
    space: Space,
    density: &Density,
    n_points: usize,
    method: Method,
    optimizer: Option<&dyn Optimizer>,
    seed: u64,
    run: &mut RunContext,
) -> Result<PointSet, evenly::Error> {
    let mut points = start(if optimizer.is_some() { Method::White } else { method }, &space, density, n_points, seed)?;
    if let Some(optimizer) = optimizer {
        let warp = optimizer.warp().unwrap_or(evenly::warp_isotropic);
        warp(&mut points);
        optimizer.run(&mut points, run)?;
    }
    Ok(points)
}
