//! The hexagonal lattice, as nearly as `n` and the domain's sides allow.

use glam::DVec2;

use super::point_set::PointSet;
use super::start::Starting;
use crate::density::Density;
use crate::error::Error;
use crate::parameter::Entry;
use crate::space::Space;

/// `n_points` points in rows, every second row shifted by half a step; a perfect hexagonal lattice where the sides allow one.
///
/// Rows may differ by one in their number of points, so that any `n` is met exactly.
///
/// # Errors
/// [`Error::InvalidParameter`] for no points and in a polygon, [`Error::TooManyPoints`] and [`Error::TooFine`] for more than the domain can hold.
pub fn hexagonal(space: impl Into<Space>, n_points: usize) -> Result<PointSet, Error> {
    let space = space.into();
    PointSet::validate(&space, n_points)?;
    if space.region().is_some() {
        return Err(Error::InvalidParameter {
            name: "space",
            value: "a polygon".into(),
            expected: "a torus or a rectangle for the hexagonal lattice",
        });
    }
    let size = space.domain().size;
    let n_rows = n_rows(n_points, size, space.is_periodic());
    let rows = (0..n_rows).flat_map(|row| {
        let n_columns = (row + 1) * n_points / n_rows - row * n_points / n_rows;
        (0..n_columns).map(move |column| (row, column, n_columns))
    });
    let points = rows.map(|(row, column, n_columns)| {
        let shift = if row % 2 == 0 { 0.25 } else { 0.75 };
        let x = (column as f64 + shift) / n_columns as f64;
        DVec2::new(x, (row as f64 + 0.5) / n_rows as f64) * size
    });
    Ok(PointSet::from_normalized(space, points))
}

/// The number of rows: even on a torus, so that the shifts match at the seam, and a divisor of `n_points` if one is near the ideal.
fn n_rows(n_points: usize, size: DVec2, is_periodic: bool) -> usize {
    let ideal = (n_points as f64 * size.y / size.x * 2.0 / 3f64.sqrt()).sqrt();
    let step = if is_periodic && n_points > 1 { 2 } else { 1 };
    let nearest = ((ideal / step as f64).round() as usize * step).clamp(step, n_points.max(step));
    let near = |rows: usize| libm::log(rows as f64 / ideal).abs();
    (1..=n_points.min(2 * nearest + 2))
        .filter(|&rows| rows % step == 0 && n_points.is_multiple_of(rows) && near(rows) < 0.1)
        .min_by(|&a, &b| near(a).total_cmp(&near(b)))
        .unwrap_or(nearest)
        .min(n_points)
}

/// Its entry among the methods that make points.
#[derive(Clone, Copy)]
pub(crate) struct Hexagonal;

impl Starting for Hexagonal {
    const ENTRY: &'static Entry<Self> = &Entry {
        name: "hexagonal",
        title: "The hexagonal lattice",
        paper: "",
        knows_density: false,
        begin: |_| Self,
        seed: None,
        parameters: &[],
    };
    const TAKES_POLYGONS: bool = false;

    fn exactly(space: &Space, _: &Density, n_points: usize, _: u64) -> Result<PointSet, Error> {
        hexagonal(space, n_points)
    }
}
