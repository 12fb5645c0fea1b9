//! Farthest-point optimization: each point in turn is taken out, and put in where it is farthest from all others.
//!
//! Schloemer, Heck and Deussen, "Farthest-Point Optimized Point Sets with Maximized Minimum Distance", High Performance Graphics 2011, doi
//! 10.1145/2018323.2018345. With `is_local` a point only looks at the gap that it leaves itself, as in the paper's section 4.3 and in the
//! comparison of Ebeida et al. (2014).
//!
//! What differs from the paper, and why: the gaps' sizes play a tournament, in which the largest is known after each change in a few steps. In a rectangle
//! places on the walls and in the corners are gaps like others.
//!
//! Cost: O(n log n) an iteration, on one thread. The smallest distance never falls, to within a millionth in a rectangle; it does not promise to reach any. Coverage is left alone.

mod gaps;
mod tournament;

use serde::Serialize;

use self::gaps::Gaps;
use super::obstacles::conclude;
use super::optimizer::{ITERATIONS, MIN_DISTANCE, Optimizing};
use super::prepare::{keep_distinct, require_uniform, triangulated, validate_iterations};
use super::targets::{ROUNDING, Targets, UnmetTarget, is_lost_to_rounding, under};
use crate::error::Error;
use crate::measure::{Measures, PointMeasures};
use crate::parameter::{Entry, Parameter, Unit};
use crate::points::PointSet;
use crate::run::{Outcome, Phase, Progress, Report, RunContext};

/// What [`farthest_point`] can be told.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FarthestPointParams {
    /// Stops where no two points are nearer than this many hexagonal spacings, in (0, 1]; `None` for no such target. 0.925 is known to be reached.
    pub min_distance: Option<f64>,
    /// Whether a point only looks at the gap that it leaves itself: faster, and stops at smaller distances.
    pub is_local: bool,
    /// How far a point goes that stays in its own gap: 1 is the middle, the paper's; up to 1.9 gets to rest many times as fast, and makes points a little
    /// more regular. In [1, 2).
    pub relaxation: f64,
    /// Stops after so many iterations, in each of which every point moves once.
    pub iterations: usize,
}

impl Default for FarthestPointParams {
    fn default() -> Self {
        Self { min_distance: Some(0.9), is_local: false, relaxation: 1.8, iterations: 500 }
    }
}

/// A run ends whose smallest distance has not grown in so many iterations.
const LONG: usize = 50;
/// After so many moves it is asked whether the run is cancelled.
const ASKING: u32 = 1 << 12;
/// Points that move no farther than this part of the spacing are at rest.
const STILL: f64 = 1e-6;

impl FarthestPointParams {
    /// Checks the parameters, as [`farthest_point`] does before it begins.
    ///
    /// # Errors
    /// [`Error::InvalidParameter`] for a distance outside (0, 1], or no iterations.
    pub fn validate(&self) -> Result<(), Error> {
        if let Some(distance) = self.min_distance.filter(|&distance| !(distance > 0.0 && distance <= 1.0)) {
            return Err(Error::InvalidParameter { name: "min_distance", value: distance.to_string(), expected: "positive, and 1 at most" });
        }
        if !(1.0..2.0).contains(&self.relaxation) {
            return Err(Error::InvalidParameter {
                name: "relaxation",
                value: self.relaxation.to_string(),
                expected: "1 or more, and less than 2",
            });
        }
        validate_iterations(self.iterations)
    }
}

impl Targets for FarthestPointParams {
    fn unmet(&self, measures: &Measures) -> Vec<UnmetTarget> {
        let measured = measures.min_distance_held();
        let missed = self.min_distance.filter(|&wanted| measured < wanted - ROUNDING);
        missed.map(|wanted| UnmetTarget { name: "min_distance", wanted, measured }).into_iter().collect()
    }

    fn miss(&self, point: &PointMeasures) -> f64 {
        self.min_distance.map_or(0.0, |wanted| under(point.nearest, wanted))
    }
}

impl Optimizing for FarthestPointParams {
    const ENTRY: &'static Entry<Self> = &Entry {
        name: "farthest-point",
        title: "Farthest-point optimization (Schloemer et al.)",
        paper: "Schloemer, Heck and Deussen 2011, doi 10.1145/2018323.2018345",
        knows_density: false,
        begin: |_| Self::default(),
        seed: None,
        parameters: &[
            Parameter::count("iterations", "I", |p: &mut Self| &mut p.iterations, ITERATIONS),
            Parameter::target("min_distance", "R", |p: &mut Self| &mut p.min_distance, MIN_DISTANCE).counting(Unit::Spacings),
            Parameter::number(
                "relaxation",
                "W",
                |p: &mut Self| &mut p.relaxation,
                "How far a point goes that stays in its own gap: 1 is the middle",
            )
            .rare(),
            Parameter::flag("local", |p: &mut Self| &mut p.is_local, "A point only looks at the gap that it leaves itself").rare(),
        ],
    };

    fn run(&self, points: &mut PointSet, run: &mut RunContext) -> Result<Report, Error> {
        farthest_point(points, self, run)
    }

    fn check(&self) -> Result<(), Error> {
        self.validate()
    }

    fn targets(&self) -> Option<&dyn Targets> {
        self.min_distance.map(|_| self as &dyn Targets)
    }
}

/// Optimises `points` in place; their number and order stay.
///
/// # Errors
/// [`Error::InvalidParameter`] as [`FarthestPointParams::validate`] has it; [`Error::TooFine`] where f64 cannot tell the points apart;
/// [`Error::Degenerate`] where they cannot be triangulated; [`Error::InvalidParameter`] where the density varies. The points are untouched then.
///
/// # Example
/// ```
/// use evenly::{FarthestPointParams, RunContext, Torus, farthest_point, measure, white};
///
/// let mut points = white(Torus::new([0.0, 0.0], [1.0, 1.0])?, 500, 7)?;
/// farthest_point(&mut points, &FarthestPointParams::default(), &mut RunContext::default())?;
/// assert!(measure(&points)?.min_distance >= 0.9);
/// # Ok::<(), evenly::Error>(())
/// ```
pub fn farthest_point(points: &mut PointSet, params: &FarthestPointParams, run: &mut RunContext) -> Result<Report, Error> {
    params.validate()?;
    require_uniform(points)?;
    let mut report = Report::new("farthest-point", points.n_points());
    let Some((domain, mesh)) = triangulated(points, &mut report, run)? else { return Ok(report) };
    let (n_points, spacing) = (points.n_points() as u32, mesh.spacing());
    let mut gaps = Gaps::new(mesh);
    // The largest smallest distance so far, and after how many iterations it was reached.
    let mut best = (0.0, 0);
    report.outcome = loop {
        if run.is_cancelled() {
            break Outcome::Cancelled;
        }
        let distance = gaps.smallest_distance()?;
        if params.min_distance.is_some_and(|wanted| distance >= wanted) {
            break Outcome::Converged;
        }
        if distance > best.0 * (1.0 + STILL) {
            best = (distance, report.iterations);
        }
        let is_stuck = report.iterations - best.1 >= LONG;
        if is_stuck {
            report.notes.push(format!("the smallest distance has not grown in the last {LONG} iterations"));
        }
        if is_stuck || report.iterations == params.iterations {
            break if params.min_distance.is_some() { Outcome::IterationLimit } else { Outcome::IterationsDone };
        }
        let mut farthest = 0.0f64;
        for point in 0..n_points {
            farthest = farthest.max(gaps.move_to_farthest(point, params.is_local, params.relaxation)?);
            if point % ASKING == 0 && run.is_cancelled() {
                break;
            }
        }
        report.iterations += 1;
        report.visits += n_points as usize;
        let fraction = report.iterations as f64 / params.iterations as f64;
        run.show(|| gaps.mesh.shown());
        run.report(Progress { phase: Phase::Optimize, iteration: report.iterations, energy: None, stable_share: None, fraction });
        if farthest <= STILL * spacing && params.min_distance.is_none() {
            break Outcome::Converged;
        }
    };
    report.triangulations += gaps.n_rebuilt;
    let places = gaps.mesh.points();
    points.place(&domain, &gaps.mesh.into_order(), &places);
    keep_distinct(points);
    if report.outcome == Outcome::Converged && is_lost_to_rounding(points, params) {
        report.outcome = Outcome::LostToRounding;
    }
    conclude(points, params, &mut report);
    Ok(report)
}
