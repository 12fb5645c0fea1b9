//! What is measured where the density varies: distances, gaps and areas in its own measure, and how well the points follow it.

use glam::DVec2;

use crate::density::Field;
use crate::error::Error;
use crate::space::Domain;
use crate::star::Senses;
use crate::triangulation::{LiveMesh, StarBuffer};

/// The measures of uniform sets that mean something else here. Lengths in spacings, masses relative to the mean.
pub(super) struct Weighted {
    pub min_distance: f64,
    /// Of each point, to the nearest other.
    pub distances: Vec<f64>,
    pub coverage_radius: f64,
    pub capacity_squares: f64,
    pub capacity_deviation: f64,
    /// Of the cells that stay clear of a polygon's border.
    pub inner_capacity_deviation: f64,
}

/// Measures distinct points, given in Hilbert order.
pub(super) fn weigh(domain: &Domain, field: &Field, positions: &[DVec2], spacing: f64) -> Result<Weighted, Error> {
    let n_points = positions.len();
    let order = (0..n_points as u32).collect();
    let mut mesh = LiveMesh::new(domain, Some(field.clone()), positions.to_vec(), order, spacing)?;
    let unit = spacing * spacing * n_points as f64 / domain.area();
    let seen = mesh.look(
        Senses { lengths: Some(f64::INFINITY), radii: Some(0.0), mass: true, ..Senses::default() },
        |_, _, StarBuffer { star, sight, .. }| {
            let others = (0..star.n_spokes()).filter(|&k| !star.is_mirror[k]);
            let nearest = others.map(|k| star.lengths[k] * star.stretch(k)).fold(f64::INFINITY, f64::min);
            let reach = (0..star.n_spokes()).map(|k| star.weighted_radius(k)).fold(0.0, f64::max);
            (nearest, reach, star.metric.mass.unwrap_or(0.0) * unit - 1.0, sight.outline.is_empty())
        },
    )?;
    Ok(Weighted {
        min_distance: seen.iter().map(|star| star.0).fold(f64::INFINITY, f64::min),
        coverage_radius: seen.iter().map(|star| star.1).fold(0.0, f64::max),
        capacity_squares: seen.iter().map(|star| star.2 * star.2).sum(),
        capacity_deviation: seen.iter().map(|star| star.2.abs()).fold(0.0, f64::max),
        inner_capacity_deviation: seen.iter().filter(|star| star.3).map(|star| star.2.abs()).fold(0.0, f64::max),
        distances: seen.into_iter().map(|star| star.0).collect(),
    })
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
