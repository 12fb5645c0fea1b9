//! DistMesh's relaxation: each edge of the triangulation is a spring that pushes its ends apart where it is shorter than wanted.
//!
//! Persson and Strang, "A Simple Mesh Generator in MATLAB", SIAM Review 46(2), 2004, doi 10.1137/S0036144503429121, section 2: forces
//! F = max(l0 - l, 0) on bars a fifth longer than there is room for, and Euler steps of 0.2.
//!
//! What differs, and why: points move one after the other, and the triangulation follows each move. The wanted length is the hexagonal spacing times
//! `pressure`, the same for all, as in the comparison of Ebeida et al. (2014). In a rectangle points that are pushed out stay on the wall.
//!
//! Cost: O(n) a pass. It does not promise any spacing; the longer it runs, the more regular the points.

use serde::Serialize;

use super::local::Local;
use super::optimizer::{ITERATIONS, Optimizing};
use super::prepare::validate_iterations;
use super::relax::relax;
use crate::error::Error;
use crate::parameter::{Entry, Parameter, Unit};
use crate::points::PointSet;
use crate::run::{Report, RunContext};
use crate::star::{Rule, Senses, Star};

/// What [`distmesh`] can be told.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct DistMeshParams {
    /// Passes over all points; more make points more regular.
    pub iterations: usize,
    /// The wanted length of edges in hexagonal spacings (the paper's Fscale); more than 1 keeps them under pressure.
    pub pressure: f64,
    /// The part of a spring's missing length that a point moves at a time (the paper's deltat); in (0, 1].
    pub step: f64,
    /// Stops before that where no point would move by more than this many hexagonal spacings; 0 for never.
    pub tolerance: f64,
    /// The order of visits depends on it.
    pub seed: u64,
}

impl Default for DistMeshParams {
    fn default() -> Self {
        Self { iterations: 200, pressure: 1.2, step: 0.2, tolerance: 1e-3, seed: 0 }
    }
}

impl DistMeshParams {
    /// Checks the parameters, as [`distmesh`] does before it begins.
    ///
    /// # Errors
    /// [`Error::InvalidParameter`] for a value outside its range, or no iterations.
    pub fn validate(&self) -> Result<(), Error> {
        let invalid = |name, value: f64, expected| Err(Error::InvalidParameter { name, value: value.to_string(), expected });
        if !(self.pressure > 0.0 && self.pressure <= 2.0) {
            return invalid("pressure", self.pressure, "positive, and 2 at most");
        }
        if !(self.step > 0.0 && self.step <= 1.0) {
            return invalid("step", self.step, "positive, and 1 at most");
        }
        if !(self.tolerance >= 0.0 && self.tolerance.is_finite()) {
            return invalid("tolerance", self.tolerance, "0 or more, and finite");
        }
        validate_iterations(self.iterations)
    }

    pub(crate) fn rule(&self) -> Springs {
        Springs { length: self.pressure, step: self.step, tolerance: self.tolerance }
    }
}

impl Optimizing for DistMeshParams {
    const ENTRY: &'static Entry<Self> = &Entry {
        name: "distmesh",
        title: "Springs between neighbours (Persson and Strang)",
        paper: "Persson and Strang 2004, doi 10.1137/S0036144503429121",
        knows_density: true,
        begin: |_| Self::default(),
        seed: Some(|p| &mut p.seed),
        parameters: &[
            Parameter::count("iterations", "I", |p: &mut Self| &mut p.iterations, ITERATIONS),
            Parameter::number(
                "pressure",
                "F",
                |p: &mut Self| &mut p.pressure,
                "The wanted length of edges in hexagonal spacings, up to 2: more than 1 keeps them under pressure (the paper's Fscale)",
            )
            .counting(Unit::Spacings)
            .rare(),
            Parameter::number(
                "step",
                "W",
                |p: &mut Self| &mut p.step,
                "The part of a spring's missing length that a point moves at a time (the paper's deltat)",
            )
            .rare(),
            Parameter::number(
                "tolerance",
                "T",
                |p: &mut Self| &mut p.tolerance,
                "Stop when no point goes farther than this many hexagonal spacings",
            )
            .counting(Unit::Spacings)
            .rare(),
        ],
    };

    fn run(&self, points: &mut PointSet, run: &mut RunContext) -> Result<Report, Error> {
        distmesh(points, self, run)
    }

    fn check(&self) -> Result<(), Error> {
        self.validate()
    }

    fn local(&self) -> Option<Local> {
        Some(Local::Passes(Box::new(self.rule()), self.iterations))
    }
}

/// Lets the springs between `points` push, in place; their number and order stay.
///
/// # Errors
/// [`Error::InvalidParameter`] as [`DistMeshParams::validate`] has it; [`Error::TooFine`] where f64 cannot tell the points apart;
/// [`Error::Degenerate`] where they cannot be triangulated. The points are untouched then.
pub fn distmesh(points: &mut PointSet, params: &DistMeshParams, run: &mut RunContext) -> Result<Report, Error> {
    params.validate()?;
    relax("distmesh", &params.rule(), points, params.iterations, params.seed, run)
}

/// Goes where the springs push.
pub(crate) struct Springs {
    length: f64,
    step: f64,
    tolerance: f64,
}

impl Rule for Springs {
    fn senses(&self) -> Senses {
        Senses { lengths: Some(self.length), echoes: true, ..Senses::default() }
    }

    fn visit(&self, star: &mut Star) -> bool {
        for k in 0..star.n_spokes() {
            let stretch = star.stretch(k);
            let missing = (self.length / stretch - star.lengths[k]).max(0.0);
            // There is no spring to a wall.
            let push = if star.is_mirror[k] { 0.0 } else { missing / star.lengths[k] };
            star.weights.push(-self.step * push);
        }
        star.own_move() > self.tolerance
    }
}
