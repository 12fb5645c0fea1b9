//! White noise: independent points, uniform or distributed by a density.

use glam::DVec2;

use super::point_set::PointSet;
use super::random::Random;
use crate::density::Density;
use crate::error::Error;
use crate::space::Space;

/// `n_points` independent uniform points.
///
/// # Errors
/// [`Error::InvalidParameter`] for no points, [`Error::TooManyPoints`] and [`Error::TooFine`] for more than the domain can hold.
pub fn white(space: impl Into<Space>, n_points: usize, seed: u64) -> Result<PointSet, Error> {
    let space = space.into();
    PointSet::validate(&space, n_points)?;
    let mut random = Random::new(seed, 0);
    let size = space.domain().size;
    let points = (0..n_points).map(|_| {
        let x = random.unit();
        DVec2::new(x, random.unit()) * size
    });
    Ok(PointSet::from_normalized(space, points))
}

/// `n_points` independent points, distributed by the density, which the set keeps.
///
/// # Errors
/// As [`white`].
pub fn white_by_density(space: impl Into<Space>, density: &Density, n_points: usize, seed: u64) -> Result<PointSet, Error> {
    let space = space.into();
    let Some(field) = density.field(&space.domain()) else { return white(space, n_points, seed) };
    PointSet::validate(&space, n_points)?;
    let mut random = Random::new(seed, 0);
    let points = (0..n_points).map(|_| {
        let mass = random.unit();
        field.place(mass, random.unit())
    });
    Ok(PointSet::from_normalized(space, points).with_density(density))
}
