//! The dots of one pen: spread by its tones, in the order in which they are drawn, as large as they are to be.

use evenly::{Method, PointSet, RunContext, Settings, Space, progressive, tour};

use super::ink::{Ink, Tones};
use super::pen::{dot_areas, widest_dot};
use super::spread::{optimizer, spread};
use crate::stipple_args::{DrawOrder, Sizes};

/// How dots are made.
pub struct DotsParams {
    pub method: Method,
    /// What the method is told.
    pub settings: Settings,
    pub sizes: Sizes,
    pub order: DrawOrder,
}

/// The dots of one pen.
pub struct Dots {
    /// In the picture's pixels, with the density that they follow.
    pub points: PointSet,
    /// Of the dots, relative to the largest.
    pub areas: Vec<f64>,
    /// The diameter of the largest dot that suits them, in pixels.
    pub widest_px: f64,
}

/// Makes so many dots of an ink.
///
/// # Errors
/// As the methods.
pub fn dots(
    params: &DotsParams,
    space: Space,
    ink: &Ink,
    tones: &Tones,
    n_points: usize,
    seed: u64,
    run: &mut RunContext,
) -> anyhow::Result<Dots> {
    let optimizer = optimizer(params.method, &params.settings, seed)?;
    let points = spread(space, &tones.density, n_points, params.method, optimizer.as_deref(), seed, run)?;
    let points = match params.order {
        // An order that takes long is left out where nobody wants to wait; a pen cannot do without its tour.
        DrawOrder::Progressive if run.is_cancelled() => ordered(&points, &tour(&points, run))?,
        DrawOrder::Tour => ordered(&points, &tour(&points, run))?,
        DrawOrder::Progressive => progressive(&points, run)?,
        DrawOrder::Input => points,
    };
    let areas = match params.sizes {
        Sizes::Constant => vec![1.0; points.n_points()],
        Sizes::Tone => dot_areas(&points, &tones.darkness, ink.mean_darkness),
    };
    Ok(Dots { widest_px: widest_dot(&points, ink.mean_darkness, &areas), points, areas })
}

fn ordered(points: &PointSet, order: &[usize]) -> Result<PointSet, evenly::Error> {
    let positions = order.iter().map(|&index| points.positions()[index]).collect();
    Ok(PointSet::new(points.space(), positions)?.with_density(points.density()))
}
