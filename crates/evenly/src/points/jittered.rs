//! A jittered grid: one uniform point in each of `n` cells of equal area.
//!
//! The cells stand in rows. Rows may differ by one in their number of cells, and then in height, so that any `n` is met exactly. In a polygon they are the
//! pieces of a Hilbert curve's way through it.

use glam::DVec2;

use super::point_set::PointSet;
use super::random::Random;
use super::start::Starting;
use super::strata;
use crate::density::Density;
use crate::error::Error;
use crate::parameter::Entry;
use crate::space::Space;

/// `n_points` points, one in each cell of a grid of `n_points` cells of equal area.
///
/// # Errors
/// [`Error::InvalidParameter`] for no points, [`Error::TooManyPoints`] and [`Error::TooFine`] for more than the domain can hold.
pub fn jittered(space: impl Into<Space>, n_points: usize, seed: u64) -> Result<PointSet, Error> {
    let space = space.into();
    PointSet::validate(&space, n_points)?;
    let mut random = Random::new(seed, 1);
    let domain = space.domain();
    if let Some(region) = space.region() {
        let places = strata::places(region, &domain, n_points, &mut random);
        return Ok(PointSet::from_normalized(space, places.into_iter()));
    }
    let size = domain.size;
    let n_rows = ((n_points as f64 * size.y / size.x).sqrt().round() as usize).clamp(1, n_points);
    let cells = (0..n_rows).flat_map(|row| {
        let (first, end) = (row * n_points / n_rows, (row + 1) * n_points / n_rows);
        (first..end).map(move |k| (k - first, end - first, first))
    });
    let points = cells.map(|(column, n_columns, first)| {
        let x = (column as f64 + random.unit()) / n_columns as f64;
        let y = (first as f64 + n_columns as f64 * random.unit()) / n_points as f64;
        DVec2::new(x, y) * size
    });
    Ok(PointSet::from_normalized(space, points))
}

/// Its entry among the methods that make points.
#[derive(Clone, Copy)]
pub(crate) struct Jittered;

impl Starting for Jittered {
    const ENTRY: &'static Entry<Self> = &Entry {
        name: "jittered",
        title: "One point in each cell of a grid, whose order outlives an optimiser as peaks in the spectrum",
        paper: "",
        knows_density: false,
        begin: |_| Self,
        seed: None,
        parameters: &[],
    };
    const IS_INDEPENDENT: bool = true;

    fn exactly(space: &Space, _: &Density, n_points: usize, seed: u64) -> Result<PointSet, Error> {
        jittered(space, n_points, seed)
    }
}
