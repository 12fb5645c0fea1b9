//! What the methods share that go on for as many passes as they are told.

use super::prepare::{keep_distinct, triangulated};
use crate::error::Error;
use crate::points::PointSet;
use crate::run::{Outcome, Report, RunContext};
use crate::star::Rule;
use crate::sweep::{Ending, Plan, Sweep};

/// Runs a rule on the points, in place, for so many passes or until it finds nothing to do.
pub(super) fn relax(
    method: &'static str,
    rule: &impl Rule,
    points: &mut PointSet,
    n_passes: usize,
    seed: u64,
    run: &mut RunContext,
) -> Result<Report, Error> {
    let mut report = Report::new(method, points.n_points());
    let Some((domain, mesh)) = triangulated(points, &mut report, run)? else { return Ok(report) };
    let mut sweep = Sweep::new(mesh);
    report.outcome = match sweep.run(rule, &Plan::of_passes(n_passes, seed), run, &mut report) {
        Ending::Converged => Outcome::Converged,
        Ending::Cancelled => Outcome::Cancelled,
        Ending::PassLimit | Ending::Diverging | Ending::Stuck => Outcome::IterationsDone,
    };
    let (order, places) = sweep.into_last();
    points.place(&domain, &order, &places);
    keep_distinct(points);
    Ok(report)
}
