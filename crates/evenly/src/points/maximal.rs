//! Maximal Poisson-disk sampling as one of the methods that make points, by a density or without.

use super::point_set::PointSet;
use super::poisson_disk::{PoissonDiskParams, poisson_disk_around};
use super::start::{Starting, Told};
use super::varying_disk::{poisson_disk_by_density, poisson_disk_of_density};
use crate::density::Density;
use crate::error::Error;
use crate::parameter::{Entry, Group, Parameter, Unit};
use crate::space::Space;

/// What it can be told.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct PoissonDisk {
    spacing: Option<f64>,
    coverage: Option<f64>,
    is_visible: bool,
}

/// The parameter that dart throwing has as well.
pub(super) const SPACING: &str = "No two points nearer than this, in input units, where a density is largest; their number is chance";

impl Starting for PoissonDisk {
    const ENTRY: &'static Entry<Self> = &Entry {
        name: "poisson-disk",
        title: "Maximal Poisson-disk sampling (Ebeida et al.)",
        paper: "Ebeida, Mitchell, Patney, Davidson and Owens 2012, doi 10.1111/j.1467-8659.2012.03059.x",
        knows_density: true,
        begin: |_| Self::default(),
        seed: None,
        parameters: &[
            Parameter::own_number("spacing", "R", |p: &mut Self| &mut p.spacing, SPACING).of(Group::Starts).counting(Unit::Input),
            Parameter::own_number(
                "coverage",
                "R",
                |p: &mut Self| &mut p.coverage,
                "No place farther from all points than this, in the domain's units: more than the spacing makes points fewer, and more random",
            )
            .of(Group::Starts)
            .rare(),
            Parameter::flag(
                "visible",
                |p: &mut Self| &mut p.is_visible,
                "In a polygon only points that see each other keep the spacing: none counts across a slit, or between parts",
            )
            .of(Group::Starts)
            .rare(),
        ],
    };

    fn exactly(space: &Space, density: &Density, n_points: usize, seed: u64) -> Result<PointSet, Error> {
        poisson_disk_of_density(space, density, n_points, seed)
    }

    fn make(&self, fixed: &PointSet, n_points: Option<usize>, seed: u64) -> Result<Option<Told>, Error> {
        let (space, density) = (fixed.space(), fixed.density());
        if self.spacing.is_none() && n_points.is_none() {
            return Err(Error::Missing { names: &["spacing", "n_points"], question: "how near to each other, or how many?" });
        }
        if self.spacing.is_some() && n_points.is_some() {
            return Err(Error::Excluded { names: ["spacing", "n_points"], why: "how many points fit is chance" });
        }
        if fixed.n_points() > 0 && !density.is_uniform() {
            return Ok(None);
        }
        let about = PoissonDiskParams { seed, ..PoissonDiskParams::for_about_by_density(space, density, n_points.unwrap_or(1)) };
        let spacing = self.spacing.unwrap_or(about.spacing);
        let params = PoissonDiskParams { spacing, coverage: self.coverage, is_visible: self.is_visible, ..about };
        let points =
            if density.is_uniform() { poisson_disk_around(fixed, &params)? } else { poisson_disk_by_density(space, density, &params)? };
        let n_made = points.n_points();
        let note = n_points.filter(|&n| n != n_made).map(|n| {
            let why = match self.coverage {
                Some(_) => "with a wider coverage fewer points are needed",
                None if n < n_made / 2 && density.is_uniform() => "on so narrow a torus the spacing cannot be wider",
                None => "a maximal set's number of points is chance",
            };
            format!("{why}: {n_made} for {n}, with a spacing of {spacing:.6e}")
        });
        Ok(Some((points, note)))
    }
}
