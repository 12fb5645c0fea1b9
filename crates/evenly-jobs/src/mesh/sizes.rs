//! A wanted spacing for every place: from points that have one, or from a picture's tones.

use evenly::{Density, Polygon, Space};

use crate::error::Error;
use crate::message::Message;

/// A grid of densities spans the polygon's frame with so many cells along its longer side.
const CELLS: f64 = 512.0;
/// Where next to no points are wanted, the spacing is up to so many times the mean.
const SPARSEST: f64 = 10.0;

pub enum Sizes {
    /// Points with a spacing each, which grows away from there by so much a length.
    Points(Vec<[f64; 3]>, f64),
    /// Spacings on a grid, relative to the mean: origin and size of the whole, cells along each axis, rows from below.
    Grid { origin: [f64; 2], size: [f64; 2], n_cells: [usize; 2], spacings: Vec<f64> },
}

impl Sizes {
    /// What points with a spacing each, or a density, ask for; `None` if that is the same spacing everywhere.
    pub fn new(points: Option<Vec<[f64; 3]>>, density: Option<Density>, polygon: &Polygon, growth: f64) -> Result<Option<Self>, Error> {
        let density = match (points, density) {
            (Some(_), Some(_)) => {
                let both = Message::default().name("sizes").text(" and ").name("density");
                return Err(both.text(" both say how long edges are; give one").into());
            }
            (None, None) => return Ok(None),
            (None, Some(density)) => density,
            (Some(points), None) => {
                if let Some([x, y, length]) = points.iter().find(|point| point[2] <= 0.0) {
                    let at = format!(": the length at ({x}, {y}) is {length}; it must be positive");
                    return Err(Message::default().name("sizes").text(at).into());
                }
                return Ok(Some(Self::Points(points, growth)));
            }
        };
        let frame: Space = (*polygon.frame()).into();
        let size = frame.size();
        let scale = CELLS / size[0].max(size[1]);
        let n_cells = size.map(|side| ((side * scale).round() as usize).max(1));
        let density = density.resampled(n_cells[0], n_cells[1]);
        // Rows of pictures run from above.
        let mean = density.iter().sum::<f64>() / density.len() as f64;
        let spacing_of = |&density: &f64| (mean / density.max(f64::MIN_POSITIVE)).sqrt().min(SPARSEST);
        let spacings = density.chunks_exact(n_cells[0]).rev().flatten().map(spacing_of).collect();
        Ok(Some(Self::Grid { origin: frame.origin(), size, n_cells, spacings }))
    }

    /// The wanted spacing at a place; `spacing` is the mean of a picture's.
    pub fn at(&self, [x, y]: [f64; 2], spacing: f64) -> f64 {
        match self {
            Self::Points(points, growth) => {
                points.iter().map(|[px, py, length]| length + growth * (x - px).hypot(y - py)).fold(f64::INFINITY, f64::min)
            }
            Self::Grid { origin, size, n_cells, spacings } => {
                // Between the middles of four cells.
                let along = |at: f64, axis: usize| {
                    let place = (at - origin[axis]) / size[axis] * n_cells[axis] as f64 - 0.5;
                    let place = place.clamp(0.0, (n_cells[axis] - 1) as f64);
                    let low = (place as usize).min(n_cells[axis].saturating_sub(2));
                    (low, (low + 1).min(n_cells[axis] - 1), place - low as f64)
                };
                let ((left, right, s), (below, above, t)) = (along(x, 0), along(y, 1));
                let of = |column: usize, row: usize| spacings[row * n_cells[0] + column];
                let low = of(left, below) * (1.0 - s) + of(right, below) * s;
                let high = of(left, above) * (1.0 - s) + of(right, above) * s;
                spacing * (low * (1.0 - t) + high * t)
            }
        }
    }

    /// The largest spacing that is wanted anywhere; of points none is, as it grows.
    pub fn largest(&self, spacing: f64) -> f64 {
        match self {
            Self::Points(..) => 0.0,
            Self::Grid { spacings, .. } => spacing * spacings.iter().copied().fold(0.0, f64::max),
        }
    }
}
