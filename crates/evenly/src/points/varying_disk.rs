//! Poisson-disk sampling with a radius that varies: random points, each two farther apart than the smaller of the spacings wanted where they are.
//!
//! Mitchell, Rand, Ebeida and Bajaj, "Variable Radii Poisson-Disk Sampling", Canadian Conference on Computational Geometry, 2012: their smaller-disk rule. Darts are
//! thrown by the density until few find room, and then around each point, as in Bridson, "Fast Poisson Disk Sampling in Arbitrary Dimensions", SIGGRAPH sketches, 2007, doi
//! 10.1145/1278780.1278807.
//!
//! Cost: O(n) but for large ratios of densities. It does not promise that no gap is left, only that many darts have missed each.

use glam::DVec2;

use super::eliminate::eliminate;
use super::point_set::{MAX_POINTS, PointSet};
use super::poisson_disk::{PoissonDiskParams, poisson_disk, poisson_disk_of};
use super::radius_bins::{RadiusBins, bins_for, radius};
use super::random::Random;
use super::white::{draw, white_by_density};
use crate::density::{Density, Field};
use crate::error::Error;
use crate::space::{Domain, Space};

/// Darts are thrown in rounds of as many as points are expected, until a round places fewer than this share of them.
const FEW: f64 = 0.02;
/// A set of an exact number is thinned out of one of so many times as many at most.
const MOST_WANTED: usize = 16;
/// Darts around each point at the end.
const TRIES: usize = 40;

/// As [`poisson_disk`], but the spacing of the parameters is that where the density is largest: elsewhere points keep more, in proportion to the inverse of its root. The set keeps the density.
///
/// # Errors
/// As there; [`Error::InvalidParameter`] also for a coverage radius where the density varies.
pub fn poisson_disk_by_density(space: impl Into<Space>, density: &Density, params: &PoissonDiskParams) -> Result<PointSet, Error> {
    let space = space.into();
    let domain = space.domain();
    let Some(field) = density.field(&domain) else { return poisson_disk(space, params) };
    params.validate_spacing()?;
    let params = PoissonDiskParams { spacing: params.spacing * field.largest().sqrt(), ..*params };
    params.validate(&space)?;
    by_mean(&space, &domain, field, density, &params)
}

impl PoissonDiskParams {
    /// As [`Self::for_about`], for [`poisson_disk_by_density`].
    pub fn for_about_by_density(space: &Space, density: &Density, n_points: usize) -> Self {
        let about = Self::for_about(space, n_points);
        let largest = density.field(&space.domain()).map_or(1.0, |field| field.largest());
        Self { spacing: about.spacing / largest.sqrt(), ..about }
    }
}

/// The same, with the spacing where the density is its mean.
fn by_mean(space: &Space, domain: &Domain, field: Field, density: &Density, params: &PoissonDiskParams) -> Result<PointSet, Error> {
    if let Some(coverage) = params.coverage {
        return Err(Error::InvalidParameter {
            name: "coverage",
            value: coverage.to_string(),
            expected: "left out where the density varies",
        });
    }
    let mean = params.spacing / domain.restore_length(1.0);
    let expected = (0.7 * domain.area() / (mean * mean)).ceil().max(1.0);
    let mut disks =
        Disks { bins: bins_for(domain, mean), domain: domain.clone(), field, mean, is_visible: params.is_visible, places: Vec::new() };
    let mut random = Random::new(params.seed, 6);
    loop {
        let before = disks.places.len();
        for _ in 0..expected as usize {
            let dart = draw(&disks.domain, &disks.field, &mut random)?;
            disks.try_put(dart);
        }
        if ((disks.places.len() - before) as f64) < FEW * expected {
            break;
        }
    }
    disks.fill_gaps(&mut random);
    Ok(PointSet::from_normalized(space.clone(), disks.places.into_iter()).with_density(density))
}

/// Exactly `n_points` points, as [`poisson_disk_of`] makes them, by the density, which the set keeps.
///
/// # Errors
/// As [`poisson_disk_of`].
pub fn poisson_disk_of_density(space: impl Into<Space>, density: &Density, n_points: usize, seed: u64) -> Result<PointSet, Error> {
    let space = space.into();
    let domain = space.domain();
    let Some(field) = density.field(&domain) else { return poisson_disk_of(space, n_points, seed) };
    PointSet::validate(&space, n_points)?;
    let mut wanted = n_points + n_points / 10 + 8;
    loop {
        let params = PoissonDiskParams { seed, ..PoissonDiskParams::for_about(&space, wanted) };
        let points = by_mean(&space, &domain, field.clone(), density, &params)?;
        if points.n_points() >= n_points {
            return eliminate(&points, n_points);
        }
        wanted += wanted / 4;
        if wanted > (MOST_WANTED * n_points).min(MAX_POINTS) {
            // Where nearly all of the density is in a few pixels, disks say little.
            return white_by_density(space, density, n_points, seed);
        }
    }
}

struct Disks {
    domain: Domain,
    field: Field,
    /// The radius where the density is its mean.
    mean: f64,
    is_visible: bool,
    bins: RadiusBins,
    places: Vec<DVec2>,
}

impl Disks {
    /// Puts a point where no disk is in the way.
    fn try_put(&mut self, place: DVec2) -> bool {
        let place = self.domain.land(place);
        let radius = radius(&self.field, place, self.mean);
        let is_free = self.domain.contains(place)
            && !self.bins.near(place, radius).any(|(other, _)| !self.is_visible || self.domain.sees(self.places[other as usize], place));
        if is_free {
            self.bins.push(place, radius);
            self.places.push(place);
        }
        is_free
    }

    /// Throws darts at the square of two radii around every point, those that come of it included.
    fn fill_gaps(&mut self, random: &mut Random) {
        let mut next = 0;
        while let Some(&place) = self.places.get(next) {
            let radius = radius(&self.field, place, self.mean);
            for _ in 0..TRIES {
                let x = random.signed();
                let way = 2.0 * radius * DVec2::new(x, random.signed());
                let dart = place + way;
                let is_here = self.domain.is_periodic || self.domain.contains(dart) && self.domain.sees(place, dart);
                // Where the density is 0 nothing is wanted.
                if is_here && way.abs().max_element() < self.domain.size.min_element() && self.field.at(dart) > 0.0 {
                    self.try_put(dart);
                }
            }
            next += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Rectangle, Torus};

    /// Sixteen times as dense at the right as at the left.
    fn ramp() -> Density {
        Density::image(4, 1, &[1.0, 4.0, 9.0, 16.0]).unwrap()
    }

    #[test]
    fn points_keep_the_smaller_spacing_and_leave_few_gaps() {
        let spaces: [Space; 2] =
            [Torus::new([0.0, 0.0], [1.0, 1.0]).unwrap().into(), Rectangle::new([5.0, -1.0], [4.0, 1.0]).unwrap().into()];
        for space in spaces {
            let params = PoissonDiskParams { seed: 3, ..PoissonDiskParams::for_about_by_density(&space, &ramp(), 2000) };
            let points = poisson_disk_by_density(space, &ramp(), &params).unwrap();
            assert!(points.n_points().abs_diff(2000) < 300, "{}", points.n_points());
            let (domain, positions) = points.normalized();
            let field = ramp().field(&domain).unwrap();
            let mean = params.spacing * field.largest().sqrt() / domain.restore_length(1.0);
            let radii: Vec<f64> = positions.iter().map(|&p| radius(&field, p, mean)).collect();
            assert!(radii.iter().all(|&radius| radius >= params.spacing / domain.restore_length(1.0) * (1.0 - 1e-9)));
            for (k, &p) in positions.iter().enumerate() {
                let is_far = |j: usize| domain.spoke(p, positions[j]).length() >= radii[k].min(radii[j]) * (1.0 - 1e-9);
                assert!((0..k).all(is_far));
            }
            // Few places by the density are free.
            let mut random = Random::new(1, 1);
            let n_free = (0..1000)
                .filter(|_| {
                    let mass = random.unit();
                    let place = field.place(mass, random.unit());
                    let own = radius(&field, place, mean);
                    positions.iter().zip(&radii).all(|(&q, &other)| domain.spoke(place, q).length() >= own.min(other))
                })
                .count();
            assert!(n_free < 10, "{n_free}");
        }
    }

    #[test]
    fn an_exact_number_follows_the_density() {
        let points = poisson_disk_of_density(Torus::new([0.0, 0.0], [1.0, 1.0]).unwrap(), &ramp(), 1200, 1).unwrap();
        assert_eq!(points.n_points(), 1200);
        let in_column = |k: usize| points.positions().iter().filter(|p| (p[0] * 4.0) as usize == k).count();
        for (k, wanted) in [40.0, 160.0, 360.0, 640.0].into_iter().enumerate() {
            assert!((in_column(k) as f64 / wanted - 1.0).abs() < 0.2, "{k}: {}", in_column(k));
        }
    }
}
