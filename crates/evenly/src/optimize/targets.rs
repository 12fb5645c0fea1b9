//! Targets that can be measured: which are missed, and by how much.

use serde::Serialize;

use crate::error::Error;
use crate::measure::{Measures, measure};
use crate::points::PointSet;
use crate::space::Space;

/// What a method was asked to reach.
pub trait Targets: Sync {
    /// The targets that points with these measures do not reach, by more than a millionth.
    fn unmet(&self, measures: &Measures) -> Vec<UnmetTarget>;

    /// By how much these measures miss the target that they miss most, relative to it, a capacity relative to the mean; 0 where all are met.
    fn worst_miss(&self, measures: &Measures) -> f64;

    /// What to expect of targets that are tougher than those that are known to be reached in this domain.
    fn advice(&self, _space: &Space) -> Option<String> {
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

/// By how much these measures miss the ratio, relative to it.
pub(super) fn beta_miss(wanted: f64, measures: &Measures) -> f64 {
    (measures.beta / wanted - 1.0).max(0.0)
}
