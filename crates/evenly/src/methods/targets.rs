//! Targets that can be measured: which are missed, and by how much.

use serde::Serialize;

use crate::error::Error;
use crate::measure::{Measures, PointMeasures, measure, measure_each};
use crate::points::PointSet;

/// What a method was asked to reach.
pub trait Targets: Sync {
    /// The targets that points with these measures do not reach, by more than rounding.
    fn unmet(&self, measures: &Measures) -> Vec<UnmetTarget>;

    /// By how much one point misses the targets: for each of them relative to it, for a capacity relative to the mean, and 0 where it is met; summed. What has no target does not count.
    fn miss(&self, point: &PointMeasures) -> f64;

    /// By how much all points miss the targets, summed; 0 where all targets are met, infinite where points cannot be measured.
    fn total_miss(&self, points: &PointSet) -> f64 {
        match (measure(points), measure_each(points)) {
            (Ok(measures), Ok(_)) if self.unmet(&measures).is_empty() => 0.0,
            (Ok(_), Ok(each)) => each.iter().map(|point| self.miss(point)).sum(),
            _ => f64::INFINITY,
        }
    }

    /// The share of the points that miss a target.
    fn share_missing(&self, points: &PointSet) -> f64 {
        let n_missing = measure_each(points).map_or(0, |each| each.iter().filter(|point| self.miss(point) > ROUNDING).count());
        n_missing as f64 / points.n_points() as f64
    }

    /// What to expect of targets that are tougher than those that are known to be reached by points like these.
    fn advice(&self, _points: &PointSet) -> Option<String> {
        None
    }
}

/// A target that points do not reach.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct UnmetTarget {
    /// The target's name, as in the parameters.
    pub name: &'static str,
    /// What was wanted.
    pub wanted: f64,
    /// What was measured.
    pub measured: f64,
}

/// What a measure may miss its target by, to rounding.
pub(super) const ROUNDING: f64 = 1e-6;

/// Whether points that have reached the targets miss them after rounding to input units, where f64 are coarse.
pub(super) fn is_lost_to_rounding(points: &PointSet, targets: &dyn Targets) -> bool {
    /// In spacings: finer numbers do not show in any measure.
    const COARSE: f64 = 1e-8;
    let is_coarse = points.space().resolution() > COARSE * points.hex_spacing();
    is_coarse && measure(points).is_ok_and(|measures| !targets.unmet(&measures).is_empty())
}

/// # Errors
/// [`Error::InvalidParameter`] for a ratio outside [0.578, 2].
pub(super) fn validate_beta(beta: f64) -> Result<(), Error> {
    if !(0.578..=2.0).contains(&beta) {
        return Err(Error::InvalidParameter { name: "beta", value: beta.to_string(), expected: "0.578 or more, and 2 at most" });
    }
    Ok(())
}

/// The ratio, if points with these measures do not reach it.
pub(super) fn unmet_beta(wanted: f64, measures: &Measures) -> Vec<UnmetTarget> {
    let is_met = measures.beta <= wanted + ROUNDING;
    if is_met { Vec::new() } else { vec![UnmetTarget { name: "beta", wanted, measured: measures.beta }] }
}

/// By how much a point misses the ratio by itself, relative to it.
pub(super) fn beta_miss(wanted: f64, point: &PointMeasures) -> f64 {
    over(point.reach / point.nearest, wanted)
}

/// By how much a measure is above its target, relative to that.
pub(super) fn over(measured: f64, most: f64) -> f64 {
    (measured / most - 1.0).max(0.0)
}

/// By how much a measure is below its target, relative to that.
pub(super) fn under(measured: f64, least: f64) -> f64 {
    (1.0 - measured / least).max(0.0)
}
