//! White noise: independent uniform points.

use glam::DVec2;

use super::point_set::PointSet;
use super::random::Random;
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
