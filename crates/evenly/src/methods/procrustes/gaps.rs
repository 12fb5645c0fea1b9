//! Where a density ends, points come together: triangles pull across gaps, and what a move brings into one goes back to its rim.

use crate::error::Error;
use crate::measure::measure_each;
use crate::methods::push_pull::{PushPullParams, push_and_pull};
use crate::points::{PointSet, eliminate, white_by_density};
use crate::run::{Outcome, Report, RunContext};

/// Points nearer to each other than this, in local spacings, are pushed apart, to the other.
const TOO_NEAR: f64 = 0.5;
const PARTED: f64 = 0.55;
/// So often points that are crowded still are taken to where there is room.
const ROUNDS: u64 = 4;
/// Places that are looked at for each of them, and besides.
const CANDIDATES: usize = 20;
const MORE: usize = 200;

/// Parts points that have come together. Where that cannot be, the report says so.
pub(super) fn part(points: &mut PointSet, run: &RunContext, report: &mut Report) -> Result<(), Error> {
    if report.outcome == Outcome::Cancelled || crowded(points).is_empty() {
        return Ok(());
    }
    let params =
        PushPullParams { min_distance: Some(PARTED), coverage_radius: None, capacity_tolerance: None, ..PushPullParams::default() };
    for round in 0..ROUNDS {
        push_and_pull(points, &params, &mut run.silent(), &mut Report::new("procrustes", points.n_points()))?;
        if run.is_cancelled() {
            report.outcome = Outcome::Cancelled;
            return Ok(());
        }
        let crowded = crowded(points);
        if crowded.is_empty() {
            return Ok(());
        }
        // No gap is crossed by pushing.
        *points = transferred(points, &crowded, round)?;
    }
    let n_crowded = crowded(points).len();
    if n_crowded > 0 {
        report.outcome = Outcome::IterationLimit;
        report.notes.push(format!(
            "where the density is not 0 there is no room for so many points: {n_crowded} are nearer to another than half of the local spacing"
        ));
    }
    Ok(())
}

/// The points that may move and are too near to another.
fn crowded(points: &PointSet) -> Vec<usize> {
    let each = measure_each(points).unwrap_or_default();
    (points.n_fixed()..each.len()).filter(|&k| each[k].nearest < TOO_NEAR).collect()
}

/// The set with the crowded points, each where it is or at one of many places by the density, whichever are the farthest from all others.
fn transferred(points: &PointSet, crowded: &[usize], seed: u64) -> Result<PointSet, Error> {
    let mut is_crowded = vec![false; points.n_points()];
    crowded.iter().for_each(|&k| is_crowded[k] = true);
    let all = points.positions();
    let kept = (0..all.len()).filter(|&k| !is_crowded[k]).map(|k| all[k]);
    let drawn = white_by_density(points.space(), points.density(), CANDIDATES * crowded.len() + MORE, seed)?;
    let candidates = kept.chain(crowded.iter().map(|&k| all[k])).chain(drawn.into_positions()).collect();
    let candidates = PointSet::new(points.space(), candidates)?.with_density(points.density());
    let n_kept = all.len() - crowded.len();
    let chosen = eliminate(&candidates.with_fixed(n_kept)?, all.len())?;
    let mut positions = all.to_vec();
    crowded.iter().zip(&chosen.positions()[n_kept..]).for_each(|(&k, &place)| positions[k] = place);
    PointSet::new(points.space(), positions)?.with_density(points.density()).with_fixed(points.n_fixed())
}
