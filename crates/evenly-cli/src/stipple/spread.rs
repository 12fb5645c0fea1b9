//! Dots spread by a density.

use evenly::{Density, Method, Optimizer, PointSet, RunContext, Setting, Settings, Space};

use crate::method::by_flag;

/// Passes after which the eye sees no difference any more; targets need not be met for a drawing.
const PASSES: usize = 60;

/// The optimiser that a drawing takes; `None` for a method that makes points at once.
///
/// # Errors
/// As [`Method::optimizer`], with the names of flags.
pub fn optimizer(method: Method, settings: &Settings, seed: u64) -> anyhow::Result<Option<Box<dyn Optimizer>>> {
    let is_endless = method.parameters().iter().any(|(about, default)| about.name == "iterations" && default.is_none());
    let is_limited = !is_endless || settings.get("iterations").is_some();
    let settings = if is_limited { settings.clone() } else { settings.clone().with("iterations", Setting::Count(PASSES)) };
    method.optimizer(&settings, seed).map_err(by_flag)
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
    let Some(optimizer) = optimizer else { return method.start_in(&space, density, n_points, seed) };
    let mut points = method.default_start(&space, true).start_in(&space, density, n_points, seed)?;
    let warp = method.warp().unwrap_or(evenly::warp_isotropic);
    warp(&mut points);
    optimizer.run(&mut points, run)?;
    Ok(points)
}
