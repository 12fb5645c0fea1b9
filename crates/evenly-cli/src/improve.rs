//! What is done before and after an optimiser, whatever it is: points are evened out first where that suits it, and what came in is kept where it was nearer to the targets.

use evenly::{Optimizer, Outcome, PointSet, Report, warp_isotropic};

/// What evens out these points first, if anything.
pub fn warp_for(points: &PointSet, optimizer: &dyn Optimizer, is_wanted: bool) -> Option<fn(&mut PointSet)> {
    // By a density every method begins with points that follow it.
    let by_density = (!points.density().is_uniform()).then_some(warp_isotropic as fn(&mut PointSet));
    let can_warp = is_wanted && points.n_points() >= 3 && points.space().region().is_none();
    optimizer.method().warp().or(by_density).filter(|_| can_warp)
}

/// Said where the points that came in are kept.
pub const KEPT: &str = "the points that came in miss the targets by less, and are written";

/// Whether points that came in miss the targets by less than what a run has made of them, all points taken together.
pub fn is_nearer(start: &PointSet, made: &PointSet, report: &Report, optimizer: &dyn Optimizer) -> bool {
    let targets = optimizer.targets().filter(|_| report.outcome != Outcome::Converged);
    targets.is_some_and(|targets| targets.total_miss(start) < targets.total_miss(made))
}

/// What the user should know of a run.
pub fn notes(report: &Report) -> Vec<String> {
    let mut notes = report.notes.clone();
    if report.coincident_points > 0 {
        notes.push(format!("{} points shared their place with another and were moved apart", report.coincident_points));
    }
    if report.was_collinear {
        notes.push("all points lay on or near one line and were spread first".into());
    }
    notes
}
