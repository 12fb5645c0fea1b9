//! What is measured where the density varies: distances, gaps and areas in its own measure, and how well the points follow it.

use glam::DVec2;

use super::each::PointMeasures;
use crate::density::Field;
use crate::error::Error;
use crate::space::Domain;
use crate::star::Senses;
use crate::triangulation::{LiveMesh, StarBuffer};

/// Measures distinct points in a mesh that knows the density and has this spacing.
pub(super) fn weigh(mesh: &mut LiveMesh, domain: &Domain, spacing: f64) -> Result<Vec<PointMeasures>, Error> {
    let unit = spacing * spacing * mesh.n_points() as f64 / domain.area();
    mesh.look(
        Senses { lengths: Some(f64::INFINITY), radii: Some(0.0), mass: true, ..Senses::default() },
        |_, _, StarBuffer { star, sight, .. }| {
            let others = (0..star.n_spokes()).filter(|&k| !star.is_mirror[k]);
            PointMeasures {
                nearest: others.map(|k| star.lengths[k] * star.stretch(k)).fold(f64::INFINITY, f64::min),
                reach: (0..star.n_spokes()).map(|k| star.weighted_radius(k)).fold(0.0, f64::max),
                capacity: star.metric.mass.unwrap_or(0.0) * unit,
                is_inner: sight.outline.is_empty(),
            }
        },
    )
}

/// Points that a cell is to hold.
const IN_CELL: f64 = 100.0;

/// How far the number of points in cells of equal mass, a hundred points' worth or so, is from what it should be: relative, root mean square. `None` for fewer points
/// than two cells hold.
pub(super) fn density_error(domain: &Domain, field: &Field, mut positions: Vec<DVec2>) -> Option<f64> {
    let n_cells = (positions.len() as f64 / IN_CELL).round() as usize;
    let wanted = positions.len() as f64 / n_cells.max(1) as f64;
    let squares = squared_errors(field, &mut positions, DVec2::ZERO, domain.size, n_cells, wanted);
    (n_cells >= 2).then(|| (squares / n_cells as f64).sqrt())
}

/// The sum of the squared errors in a box that is to be divided into so many cells.
fn squared_errors(field: &Field, positions: &mut [DVec2], low: DVec2, high: DVec2, n_cells: usize, wanted: f64) -> f64 {
    if n_cells <= 1 {
        return (positions.len() as f64 / wanted - 1.0).powi(2);
    }
    let size = high - low;
    let axis = usize::from(size.y > size.x);
    let n_below = n_cells / 2;
    let cut = field.cut(low, high, axis, n_below as f64 / n_cells as f64);
    positions.sort_unstable_by(|a, b| a[axis].total_cmp(&b[axis]));
    let (below, above) = positions.split_at_mut(positions.partition_point(|p| p[axis] < cut));
    let (mut middle_high, mut middle_low) = (high, low);
    (middle_high[axis], middle_low[axis]) = (cut, cut);
    squared_errors(field, below, low, middle_high, n_below, wanted)
        + squared_errors(field, above, middle_low, high, n_cells - n_below, wanted)
}
