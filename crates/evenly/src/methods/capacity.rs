//! Equal areas: each Voronoi cell that is too large or too small presses on its sides, until all areas are about the same.
//!
//! The capacity constraint of Balzer, Schloemer and Deussen, "Capacity-Constrained Point Distributions", ACM Transactions on Graphics 28(3), 2009, doi
//! 10.1145/1531326.1531392, reached by the third of [`push_pull`](super::push_pull::push_pull)'s steps alone.
//!
//! Cost: O(n) in all. It does not promise any distance between points: areas can be equal where points nearly meet.

use serde::Serialize;

use super::local::Local;
use super::obstacles::conclude;
use super::optimizer::{CAPACITY_TOLERANCE, ITERATIONS, Optimizing, PASSES};
use super::push_pull::{PushPullParams, push_and_pull};
use super::targets::{Targets, UnmetTarget};
use crate::error::Error;
use crate::measure::{Measures, PointMeasures};
use crate::parameter::{Entry, Group, Parameter};
use crate::points::PointSet;
use crate::run::{Report, RunContext};

/// What [`capacity`] can be told.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CapacityParams {
    /// The area of each Voronoi cell shall differ from the mean by at most this part of it; positive.
    pub capacity_tolerance: f64,
    /// Stops after this many passes in any case; `None` for a limit that grows with the number of points, 2000 at least.
    pub max_passes: Option<usize>,
    /// The order of visits depends on it.
    pub seed: u64,
}

impl Default for CapacityParams {
    fn default() -> Self {
        Self { capacity_tolerance: 0.0386, max_passes: None, seed: 0 }
    }
}

impl CapacityParams {
    /// Checks the parameters, as [`capacity`] does before it begins.
    ///
    /// # Errors
    /// [`Error::InvalidParameter`] for a negative tolerance, or no passes.
    pub fn validate(&self) -> Result<(), Error> {
        self.targets().validate()
    }

    fn targets(&self) -> PushPullParams {
        PushPullParams {
            min_distance: None,
            coverage_radius: None,
            capacity_tolerance: Some(self.capacity_tolerance),
            max_passes: self.max_passes,
            seed: self.seed,
            ..PushPullParams::default()
        }
    }
}

impl Targets for CapacityParams {
    fn unmet(&self, measures: &Measures) -> Vec<UnmetTarget> {
        self.targets().unmet(measures)
    }

    fn miss(&self, point: &PointMeasures) -> f64 {
        self.targets().miss(point)
    }
}

impl Optimizing for CapacityParams {
    const ENTRY: &'static Entry<Self> = &Entry {
        name: "capacity",
        title: "Voronoi cells of equal area, and nothing else (Balzer et al.)",
        paper: "Balzer, Schloemer and Deussen 2009, doi 10.1145/1531326.1531392",
        knows_density: true,
        begin: |_| Self::default(),
        seed: Some(|p| &mut p.seed),
        parameters: &[
            Parameter::own_count("iterations", "I", |p: &mut Self| &mut p.max_passes, ITERATIONS).by_default(PASSES),
            Parameter::number("capacity_tolerance", "T", |p: &mut Self| &mut p.capacity_tolerance, CAPACITY_TOLERANCE).of(Group::Targets),
        ],
    };

    fn run(&self, points: &mut PointSet, run: &mut RunContext) -> Result<Report, Error> {
        capacity(points, self, run)
    }

    fn check(&self) -> Result<(), Error> {
        self.validate()
    }

    fn targets(&self) -> Option<&dyn Targets> {
        Some(self)
    }

    fn local(&self) -> Option<Local> {
        Some(Local::Targets(self.targets()))
    }
}

/// Optimises `points` in place; their number and order stay.
///
/// Where the tolerance is not reached, the report says so, and `points` are in the best state that was seen.
///
/// # Errors
/// [`Error::InvalidParameter`] as [`CapacityParams::validate`] has it; [`Error::TooFine`] where f64 cannot tell the points apart;
/// [`Error::Degenerate`] where they cannot be triangulated. The points are untouched then.
pub fn capacity(points: &mut PointSet, params: &CapacityParams, run: &mut RunContext) -> Result<Report, Error> {
    params.validate()?;
    let mut report = Report::new("capacity", points.n_points());
    push_and_pull(points, &params.targets(), run, &mut report)?;
    conclude(points, params, &mut report);
    Ok(report)
}
