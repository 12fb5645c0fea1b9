//! What the methods share that go on for as many passes as they are told.

use super::prepare::{Prepared, keep_distinct, prepare};
use crate::error::Error;
use crate::points::PointSet;
use crate::run::{Outcome, Phase, Report, RunContext};
use crate::star::Rule;
use crate::sweep::{Ending, Order, Plan, Schedule, Sweep};
use crate::triangulation::LiveMesh;

/// How long to go on.
pub(super) struct Passes {
    pub n_passes: usize,
    pub seed: u64,
}

impl Passes {
    /// # Errors
    /// [`Error::InvalidParameter`] for no passes.
    pub fn validate(&self) -> Result<(), Error> {
        if self.n_passes == 0 {
            return Err(Error::InvalidParameter { name: "iterations", value: "0".into(), expected: "1 or more" });
        }
        Ok(())
    }
}

/// Runs a rule on the points, in place, for so many passes or until it finds nothing to do.
pub(super) fn relax(
    method: &'static str,
    rule: &impl Rule,
    points: &mut PointSet,
    passes: &Passes,
    run: &mut RunContext,
) -> Result<Report, Error> {
    passes.validate()?;
    let mut report = Report::new(method, points.n_points());
    let Some(Prepared { domain, spacing, positions, order }) = prepare(points, &mut report, run)? else { return Ok(report) };
    run.enter(Phase::Triangulate);
    let mut sweep = Sweep::new(LiveMesh::new(&domain, positions, order, spacing)?);
    report.triangulations = 1;
    run.enter(Phase::Optimize);
    let plan = Plan {
        schedule: Schedule::InTurn,
        order: Order::Shuffled,
        max_passes: passes.n_passes,
        seed: passes.seed,
        keeps_best: false,
        ends_if_diverging: false,
        ends_if_stuck: false,
    };
    report.outcome = match sweep.run(rule, &plan, run, &mut report)? {
        Ending::Converged => Outcome::Converged,
        Ending::Cancelled => Outcome::Cancelled,
        Ending::PassLimit | Ending::Diverging | Ending::Stuck => Outcome::IterationsDone,
    };
    let (order, places) = sweep.into_last();
    points.place(&domain, &order, &places);
    keep_distinct(points);
    Ok(report)
}
