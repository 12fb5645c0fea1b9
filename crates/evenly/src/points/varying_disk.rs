//! Poisson-disk sampling with a radius that varies: random points, each two farther apart than the smaller of the spacings wanted where they are.
//!
//! Mitchell, Rand, Ebeida and Bajaj, "Variable Radii Poisson-Disk Sampling", Canadian Conference on Computational Geometry, 2012: their smaller-disk rule. Darts are
//! thrown by the density until few find room; then the centres of the triangles' circumcircles are tried, until none of them has any.
//!
//! Cost: O(n log n) but for large ratios of densities. It does not promise that no gap is left: one away from all circumcentres, as at a border, may be.

use glam::DVec2;

use super::eliminate::eliminate;
use super::order::hilbert_order;
use super::point_set::{MAX_POINTS, PointSet};
use super::poisson_disk::{PoissonDiskParams, poisson_disk, poisson_disk_of};
use super::radius_bins::{RadiusBins, bins_for, radius};
use super::random::Random;
use crate::density::{Density, Field};
use crate::error::Error;
use crate::space::{Domain, Space};
use crate::triangulation::{circumcentre, delaunay};

/// Darts are thrown in rounds of as many as points are expected, until a round places fewer than this share of them.
const FEW: f64 = 0.02;
/// More rounds of filling gaps than are ever needed.
const MOST_FILLINGS: usize = 20;

/// As [`poisson_disk`], but the spacing of the parameters is that where the density is its mean: elsewhere it is shorter or longer by its root. The set keeps the density.
///
/// # Errors
/// As there; [`Error::InvalidParameter`] also for a coverage radius where the density varies.
pub fn poisson_disk_by_density(space: impl Into<Space>, density: &Density, params: &PoissonDiskParams) -> Result<PointSet, Error> {
    let space = space.into();
    let domain = space.domain();
    let Some(field) = density.field(&domain) else { return poisson_disk(space, params) };
    params.validate(&space)?;
    if let Some(coverage) = params.coverage {
        return Err(Error::InvalidParameter {
            name: "coverage",
            value: coverage.to_string(),
            expected: "left out where the density varies",
        });
    }
    let mean = params.spacing / domain.restore_length(1.0);
    let mut disks = Disks { domain, field, mean, bins: bins_for(&domain, mean), places: Vec::new() };
    let expected = (0.7 * domain.area() / (mean * mean)).ceil().max(1.0);
    let mut random = Random::new(params.seed, 6);
    loop {
        let before = disks.places.len();
        for _ in 0..expected as usize {
            let mass = random.unit();
            let dart = disks.field.place(mass, random.unit());
            disks.try_put(dart);
        }
        if ((disks.places.len() - before) as f64) < FEW * expected {
            break;
        }
    }
    disks.fill_gaps()?;
    Ok(PointSet::from_normalized(space, disks.places.into_iter()).with_density(density))
}

/// Exactly `n_points` points, as [`poisson_disk_of`] makes them, by the density, which the set keeps.
///
/// # Errors
/// As [`poisson_disk_of`].
pub fn poisson_disk_of_density(space: impl Into<Space>, density: &Density, n_points: usize, seed: u64) -> Result<PointSet, Error> {
    let space = space.into();
    if density.is_uniform() {
        return poisson_disk_of(space, n_points, seed);
    }
    PointSet::validate(&space, n_points)?;
    let mut wanted = n_points + n_points / 10 + 8;
    loop {
        let params = PoissonDiskParams { seed, ..PoissonDiskParams::for_about(&space, wanted) };
        let points = poisson_disk_by_density(space, density, &params)?;
        if points.n_points() >= n_points || wanted > MAX_POINTS {
            return eliminate(&points, n_points);
        }
        wanted += wanted / 4;
    }
}

struct Disks {
    domain: Domain,
    field: Field,
    /// The radius where the density is its mean.
    mean: f64,
    bins: RadiusBins,
    places: Vec<DVec2>,
}

impl Disks {
    /// Puts a point where no disk is in the way.
    fn try_put(&mut self, place: DVec2) -> bool {
        let place = self.domain.land(place);
        let radius = radius(&self.field, place, self.mean);
        let is_free = self.bins.near(place, radius).next().is_none();
        if is_free {
            self.bins.push(place, radius);
            self.places.push(place);
        }
        is_free
    }

    fn fill_gaps(&mut self) -> Result<(), Error> {
        for _ in 0..MOST_FILLINGS {
            if self.places.len() < 3 {
                return Ok(());
            }
            let order = hilbert_order(&self.places, self.domain.size);
            let sorted: Vec<DVec2> = order.iter().map(|&index| self.places[index as usize]).collect();
            // Points on one line have no triangles.
            let Ok(triangulation) = delaunay(&self.domain, sorted, order) else { return Ok(()) };
            let mut n_put = 0;
            for corners in triangulation.half_edges.triangles() {
                let (u, v) = triangulation.spokes(corners);
                let centre = triangulation.positions[corners[0] as usize] + circumcentre(u, v);
                let is_here = if self.domain.is_periodic { centre.is_finite() } else { self.domain.contains(centre) };
                if is_here && self.field.at(centre) > 0.0 {
                    let home =
                        if self.domain.is_periodic { centre - (centre / self.domain.size).floor() * self.domain.size } else { centre };
                    n_put += usize::from(self.try_put(home));
                }
            }
            if n_put == 0 {
                return Ok(());
            }
        }
        Ok(())
    }
}
