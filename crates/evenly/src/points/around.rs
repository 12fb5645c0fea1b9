//! [`around`]: points made around others that stay.

use super::eliminate::eliminate;
use super::point_set::PointSet;
use super::start::AnyStart;
use crate::error::Error;

/// Exactly so many points by a method that makes some, in the space and by the density of points that stay, which are among them and come first.
///
/// # Errors
/// [`Error::InvalidParameter`] for fewer points than stay; and as the method.
pub(crate) fn around(start: &dyn AnyStart, fixed: &PointSet, n_points: usize, seed: u64) -> Result<PointSet, Error> {
    let (space, density, n_fixed) = (fixed.space(), fixed.density(), fixed.n_points());
    if n_fixed == 0 {
        return start.exactly(space, density, n_points, seed);
    }
    if n_points < n_fixed {
        let value = format!("{n_points}, but {n_fixed} points stay");
        return Err(Error::InvalidParameter { name: "n_points", value, expected: "at least as many: they are among them" });
    }
    let with = |others: PointSet| {
        let all = fixed.positions().iter().chain(others.positions()).copied().collect();
        PointSet::new(space, all)?.with_density(density).with_fixed(n_fixed)
    };
    if n_points == n_fixed {
        return with(PointSet::new(space, Vec::new())?);
    }
    if start.is_independent() {
        return with(start.exactly(space, density, n_points - n_fixed, seed)?);
    }
    // Those go that crowd around the ones that stay.
    eliminate(&with(start.exactly(space, density, n_points, seed)?)?, n_points)
}
