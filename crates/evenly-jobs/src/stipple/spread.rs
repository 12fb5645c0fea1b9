//! Dots spread by a density.

use evenly::{Density, Method, Optimizer, PointSet, Setting, Settings, Space};

use crate::context::{Context, Stage};
use crate::error::Error;
use crate::method;

/// Passes after which the eye sees no difference any more; targets need not be met for a drawing.
const PASSES: usize = 60;

/// The optimiser that a drawing takes; `None` for a method that makes points at once.
///
/// # Errors
/// As [`method::optimizer`].
pub fn optimizer(method: Method, settings: &Settings, seed: u64) -> Result<Option<Box<dyn Optimizer>>, Error> {
    let is_endless = method.parameters().iter().any(|(about, default)| about.name == "iterations" && default.is_none());
    let is_limited = !is_endless || settings.get("iterations").is_some();
    let settings = if is_limited { settings.clone() } else { settings.clone().with("iterations", Setting::Count(PASSES)) };
    // Dots follow a density: nowhere are spacings alike.
    Ok(method::optimizer(method, &settings, None, seed)?.1)
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
    context: &mut Context,
) -> Result<PointSet, Error> {
    context.enter(Stage::Start);
    let Some(optimizer) = optimizer else { return Ok(method.start_in(&space, density, n_points, seed)?) };
    let mut points = method.default_start(&space, true).start_in(&space, density, n_points, seed)?;
    let warp = method.warp().unwrap_or(evenly::warp_isotropic);
    warp(&mut points);
    context.run(|run| optimizer.run(&mut points, run))?;
    Ok(points)
}
