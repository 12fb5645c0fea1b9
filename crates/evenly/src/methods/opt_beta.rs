//! Opt-beta: each point goes to where the aspect ratio of its own Voronoi cell is least.
//!
//! Ebeida, Awad, Ge, Mahmoud, Mitchell, Knupp and Wei, "Improving Spatial Coverage while Preserving the Blue Noise of Point Sets", Computer-Aided Design 46,
//! 2014, doi 10.1016/j.cad.2013.08.015, section 5: ten steps of Nelder and Mead's method on r_c / r_f of the cell that a point would have, which is
//! remade at every place that is tried; sweeps by rows, each move made at once, until beta = max r_c / min r_f has come down to the target.
//!
//! What differs, and why: the rows are those of the engine's cells, so that threads can share a sweep. The neighbours' neighbours are all that a cell is made
//! of; a point moves by one spacing at most. The state with the least beta is kept, as beta goes up and down on the way. Where lengths are wanted that vary, as in meshes, both radii are taken in
//! the length that is wanted where they are.
//!
//! Cost: O(n) a sweep. It does not promise to reach a target: the ratio has no scale, so dense and sparse patches are each well spaced by themselves, and differences of density between them go
//! slowly. With 1000 points beta comes to 0.75 in 500 sweeps and to 0.71 to 0.72 in 2000 to 4000, with 10,000 to 0.76 to 0.79 in 500 to 900. [`well_spaced`](super::well_spaced::well_spaced) reaches 0.67 in about the
//! time that this takes to 0.85.

mod local_ratio;
mod nelder_mead;

use glam::DVec2;
use serde::Serialize;

use self::local_ratio::local_ratio;
use self::nelder_mead::minimize;
use super::local::Local;
use super::obstacles::conclude;
use super::optimizer::{BETA, ITERATIONS, Optimizing};
use super::prepare::{keep_distinct, require_uniform, triangulated, validate_iterations};
use super::targets::{Targets, UnmetTarget, beta_miss, is_lost_to_rounding, unmet_beta, validate_beta};
use crate::error::Error;
use crate::measure::{Measures, PointMeasures};
use crate::parameter::{Entry, Group, Parameter, Setting};
use crate::points::PointSet;
use crate::run::{Outcome, Report, RunContext};
use crate::star::{Rule, Star};
use crate::sweep::{Ending, Order, Plan, Sweep};
use crate::triangulation::Distances;

/// What [`opt_beta`] can be told.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct OptBetaParams {
    /// The coverage radius over the smallest distance shall be this at most; 0.578 or more. `None` for 0.85, or what it comes to without.
    pub beta: Option<f64>,
    /// The part of each move that is made; in (0, 1]. `None` for 0.7 above a target of 0.9, which is otherwise left far behind, and 1 below.
    pub damping: Option<f64>,
    /// Stops after this many sweeps in any case; and where 1000 have brought neither a lower ratio nor a lower mean of the points' own.
    pub iterations: usize,
}

impl Default for OptBetaParams {
    fn default() -> Self {
        Self { beta: None, damping: None, iterations: 10_000 }
    }
}

/// Steps of Nelder and Mead's method at a visit.
const N_STEPS: usize = 10;
/// The side of the first simplex: a tenth of the distance of a maximal Poisson-disk sample, in hexagonal spacings.
const SIDE: f64 = 0.077;
/// Targets above this are damped.
const LOOSE: f64 = 0.9;
/// Where it ends that is told no target.
const DEFAULT: f64 = 0.85;
/// Sweeps that bring neither a lower beta nor a lower mean of the points' own ratios, before a run is at its end.
const LONG: usize = 1000;

impl OptBetaParams {
    /// Checks the parameters, as [`opt_beta`] does before it begins.
    ///
    /// # Errors
    /// [`Error::InvalidParameter`] for a value outside its range, or no iterations.
    pub fn validate(&self) -> Result<(), Error> {
        validate_beta(self.wanted())?;
        if self.damping.is_some_and(|damping| !(damping > 0.0 && damping <= 1.0)) {
            let value = self.damping.unwrap_or(f64::NAN).to_string();
            return Err(Error::InvalidParameter { name: "damping", value, expected: "positive, and 1 at most" });
        }
        validate_iterations(self.iterations)
    }
}

impl OptBetaParams {
    /// The ratio at which a run ends.
    pub(crate) fn wanted(&self) -> f64 {
        self.beta.unwrap_or(DEFAULT)
    }

    pub(crate) fn rule(&self) -> ToLeastRatio {
        ToLeastRatio { damping: self.damping.unwrap_or(if self.wanted() > LOOSE { 0.7 } else { 1.0 }) }
    }
}

impl Targets for OptBetaParams {
    fn unmet(&self, measures: &Measures) -> Vec<UnmetTarget> {
        unmet_beta(self.wanted(), measures)
    }

    fn miss(&self, point: &PointMeasures) -> f64 {
        beta_miss(self.wanted(), point)
    }
}

impl Optimizing for OptBetaParams {
    const ENTRY: &'static Entry<Self> = &Entry {
        name: "opt-beta",
        title: "Opt-beta: the least ratio of each cell by itself (Ebeida et al.)",
        paper: "Ebeida, Awad, Ge, Mahmoud, Mitchell, Knupp and Wei 2014, doi 10.1016/j.cad.2013.08.015",
        knows_density: false,
        begin: |_| Self::default(),
        seed: None,
        parameters: &[
            Parameter::count("iterations", "I", |p: &mut Self| &mut p.iterations, ITERATIONS)
                .details("It ends as well where 1000 sweeps bring nothing."),
            Parameter::own_number("beta", "B", |p: &mut Self| &mut p.beta, BETA)
                .of(Group::Targets)
                .by_default("0.85")
                .details("It comes to 0.72 with 1,000 points in 3000 sweeps, to 0.76 to 0.79 with 10,000 in 1000."),
            Parameter::own_number("damping", "W", |p: &mut Self| &mut p.damping, "The part of each move that is made")
                .by_default("0.7 above a beta of 0.9, else 1")
                .rare(),
        ],
    };
    const ON_MESHES: &'static [(&'static str, Setting)] = &[("beta", Setting::Number(0.75)), ("iterations", Setting::Count(200))];
    const START: &'static str = "poisson-disk";
    const START_IN_POLYGONS: &'static str = "eliminate";

    fn run(&self, points: &mut PointSet, run: &mut RunContext) -> Result<Report, Error> {
        opt_beta(points, self, run)
    }

    fn check(&self) -> Result<(), Error> {
        self.validate()
    }

    fn targets(&self) -> Option<&dyn Targets> {
        self.beta.map(|_| self as &dyn Targets)
    }

    fn local(&self) -> Option<Local> {
        Some(Local::LeastRatio(*self))
    }
}

/// Optimises `points` in place; their number and order stay.
///
/// Where the ratio is not reached, the report says so, and `points` are in the best state that was seen. Its energies are beta, before the first sweep and
/// after each.
///
/// # Errors
/// [`Error::InvalidParameter`] as [`OptBetaParams::validate`] has it; [`Error::TooFine`] where f64 cannot tell the points apart;
/// [`Error::Degenerate`] where they cannot be triangulated; [`Error::InvalidParameter`] where the density varies. The points are untouched then.
///
/// # Example
/// ```
/// use evenly::{OptBetaParams, RunContext, Torus, measure, opt_beta, poisson_disk_of};
///
/// let mut points = poisson_disk_of(Torus::new([0.0, 0.0], [1.0, 1.0])?, 1000, 7)?;
/// opt_beta(&mut points, &OptBetaParams::default(), &mut RunContext::default())?;
/// assert!(measure(&points)?.beta <= 0.85);
/// # Ok::<(), evenly::Error>(())
/// ```
pub fn opt_beta(points: &mut PointSet, params: &OptBetaParams, run: &mut RunContext) -> Result<Report, Error> {
    params.validate()?;
    require_uniform(points)?;
    let mut report = Report::new("opt-beta", points.n_points());
    let Some((domain, mesh)) = triangulated(points, &mut report, run)? else { return Ok(report) };
    let mut sweep = Sweep::new(mesh);
    let best = to_least_ratio(&mut sweep, params, run, &mut report)?;
    let (order, _) = sweep.into_last();
    points.place(&domain, &order, &best);
    keep_distinct(points);
    if report.outcome == Outcome::Converged && is_lost_to_rounding(points, params) {
        report.outcome = Outcome::LostToRounding;
    }
    conclude(points, params, &mut report);
    Ok(report)
}

/// Sweeps until beta is reached, and says in the report how that has ended; what comes in may have reached it. Returns the places in the best state.
pub(crate) fn to_least_ratio(
    sweep: &mut Sweep,
    params: &OptBetaParams,
    run: &mut RunContext,
    report: &mut Report,
) -> Result<Vec<DVec2>, Error> {
    let mut plan = Plan { order: Order::Rows, ..Plan::of_passes(params.iterations, 0) };
    let (reached, mut least_mean) = ratios(sweep)?;
    let (mut best, mut best_at) = ((reached, sweep.places()), report.iterations);
    report.energy.push(reached);
    report.outcome = loop {
        if best.0 <= params.wanted() {
            break Outcome::Converged;
        }
        if report.iterations - best_at >= LONG {
            break at_rest(params, best.0, report);
        }
        if report.iterations == params.iterations {
            break Outcome::IterationLimit;
        }
        plan.max_passes = report.iterations + 1;
        let ending = sweep.run(&params.rule(), &plan, run, report);
        if ending == Ending::Cancelled {
            break Outcome::Cancelled;
        }
        let (reached, mean) = ratios(sweep)?;
        report.energy.push(reached);
        if mean < least_mean {
            (least_mean, best_at) = (mean, report.iterations);
        }
        if reached < best.0 {
            (best, best_at) = ((reached, sweep.places()), report.iterations);
        }
        if ending == Ending::Converged && best.0 > params.wanted() {
            break at_rest(params, best.0, report);
        }
    };
    Ok(best.1)
}

/// The outcome of a run that brings no lower ratio any more: without a target of its own it has done what it can.
pub(crate) fn at_rest(params: &OptBetaParams, reached: f64, report: &mut Report) -> Outcome {
    report.notes.push(format!("beta has come to {reached:.4}, and does not fall any more"));
    if params.beta.is_some() { Outcome::IterationLimit } else { Outcome::Converged }
}

/// Beta, and the mean of the points' own ratios: the one sways with the worst spot, the other tells whether all get better.
fn ratios(sweep: &mut Sweep) -> Result<(f64, f64), Error> {
    let Distances { smallest, largest_radius, mean_ratio } = sweep.distances()?;
    Ok((largest_radius / smallest, mean_ratio))
}

/// Goes where its own cell's ratio is least.
pub(crate) struct ToLeastRatio {
    damping: f64,
}

impl Rule for ToLeastRatio {
    const LOOKS_AROUND: bool = true;

    fn visit(&self, star: &mut Star) -> bool {
        if star.rail == Some(DVec2::ZERO) {
            return false;
        }
        // Where cells are cut, the nearest cut them down to where the others do not matter.
        star.beyond.sort_unstable_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
        let ratio = |at: DVec2| local_ratio(star, at);
        let side = SIDE / star.metric.scale;
        let (place, _) = match star.rail {
            None => minimize(ratio, [DVec2::ZERO, DVec2::new(side, 0.0), DVec2::new(0.0, side)], N_STEPS),
            Some(direction) => minimize(ratio, [DVec2::ZERO, side * direction], N_STEPS),
        };
        star.shift = self.damping * place;
        star.shift != DVec2::ZERO
    }
}
