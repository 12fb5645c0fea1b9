//! White noise: independent points, uniform or distributed by a density.

use glam::DVec2;

use super::point_set::PointSet;
use super::random::Random;
use super::start::Starting;
use super::uniform::Uniform;
use crate::density::{Density, Field};
use crate::error::Error;
use crate::parameter::Entry;
use crate::space::{Domain, Space};

/// `n_points` independent uniform points.
///
/// # Errors
/// [`Error::InvalidParameter`] for no points, [`Error::TooManyPoints`] and [`Error::TooFine`] for more than the domain can hold.
pub fn white(space: impl Into<Space>, n_points: usize, seed: u64) -> Result<PointSet, Error> {
    let space = space.into();
    PointSet::validate(&space, n_points)?;
    let mut random = Random::new(seed, 0);
    let uniform = Uniform::new(&space);
    Ok(PointSet::from_normalized(space, (0..n_points).map(|_| uniform.place(&mut random))))
}

/// `n_points` independent points, distributed by the density, which the set keeps.
///
/// # Errors
/// As [`white`].
pub fn white_by_density(space: impl Into<Space>, density: &Density, n_points: usize, seed: u64) -> Result<PointSet, Error> {
    let space = space.into();
    let domain = space.domain();
    let Some(field) = density.field(&domain) else { return white(space, n_points, seed) };
    PointSet::validate(&space, n_points)?;
    let mut random = Random::new(seed, 0);
    let points = (0..n_points).map(|_| draw(&domain, &field, &mut random)).collect::<Result<Vec<_>, _>>()?;
    Ok(PointSet::from_normalized(space, points.into_iter()).with_density(density))
}

/// So often a place is drawn until one lies in the domain.
const MOST_DRAWS: usize = 1_000_000;

/// A place in the domain by the density.
///
/// # Errors
/// [`Error::InvalidParameter`] where the density has next to nothing there.
pub(super) fn draw(domain: &Domain, field: &Field, random: &mut Random) -> Result<DVec2, Error> {
    let mut draws = (0..MOST_DRAWS).map(|_| {
        let mass = random.unit();
        domain.land(field.place(mass, random.unit()))
    });
    draws.find(|&place| domain.contains(place)).ok_or(Error::InvalidParameter {
        name: "density",
        value: "next to 0 in the whole domain".into(),
        expected: "more than 0 somewhere in it",
    })
}

/// Its entry among the methods that make points.
#[derive(Clone, Copy)]
pub(crate) struct White;

impl Starting for White {
    const ENTRY: &'static Entry<Self> = &Entry {
        name: "white",
        title: "Independent uniform points",
        paper: "",
        knows_density: true,
        begin: |_| Self,
        seed: None,
        parameters: &[],
    };
    const HAS_LONG_WAVES: bool = true;
    const IS_INDEPENDENT: bool = true;

    fn exactly(space: &Space, density: &Density, n_points: usize, seed: u64) -> Result<PointSet, Error> {
        white_by_density(space, density, n_points, seed)
    }
}
