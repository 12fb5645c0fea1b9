//! The dots of one pen: spread by its tones, in the order in which they are drawn, as large as they are to be.

use evenly::{Method, PointSet, Settings, Space, progressive, tour};

use super::ink::{Ink, Tones};
use super::pen::{dot_areas, widest_dot};
use super::spread::{optimizer, spread};
use super::{DotSizes, DrawOrder};
use crate::context::Context;
use crate::error::Error;

/// How dots are made.
pub struct DotsParams<'a> {
    pub method: Method,
    /// What the method is told.
    pub settings: &'a Settings,
    pub sizes: DotSizes,
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
    context: &mut Context,
) -> Result<Dots, Error> {
    let optimizer = optimizer(params.method, params.settings, seed)?;
    let points = spread(space, &tones.density, n_points, params.method, optimizer.as_deref(), seed, context)?;
    let points = match params.order {
        // An order that takes long is left out where nobody wants to wait; a pen cannot do without its tour.
        DrawOrder::Progressive if !context.is_cancelled() => progressive(&points, &context.silent())?,
        DrawOrder::Tour | DrawOrder::Progressive => ordered(&points, &tour(&points, &context.silent()))?,
        DrawOrder::Input => points,
    };
    let areas = match params.sizes {
        DotSizes::Constant => vec![1.0; points.n_points()],
        DotSizes::Tone => dot_areas(&points, &tones.darkness, ink.mean_darkness),
    };
    Ok(Dots { widest_px: widest_dot(&points, ink.mean_darkness, &areas), points, areas })
}

fn ordered(points: &PointSet, order: &[usize]) -> Result<PointSet, evenly::Error> {
    let positions = order.iter().map(|&index| points.positions()[index]).collect();
    Ok(PointSet::new(points.space(), positions)?.with_density(points.density()))
}
