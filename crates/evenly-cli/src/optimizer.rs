//! The optimisers behind one face: which one runs, with which parameters, and what it was asked to reach.

use evenly::{
    Error, Measures, PointSet, ProcrustesParams, PushPullParams, Report, RunContext, Space, UnmetTarget, WellSpacedParams, procrustes,
    push_pull, warp, warp_isotropic, well_spaced,
};
use serde::Serialize;

#[derive(Clone, Copy, Serialize)]
#[serde(untagged)]
pub enum Optimizer {
    Procrustes(ProcrustesParams),
    PushPull(PushPullParams),
    WellSpaced(WellSpacedParams),
}

impl Optimizer {
    pub fn name(&self) -> &'static str {
        match self {
            Self::Procrustes(_) => "procrustes",
            Self::PushPull(_) => "push-pull",
            Self::WellSpaced(_) => "well-spaced",
        }
    }

    /// Whether it was asked to reach something that can be measured.
    pub fn has_targets(&self) -> bool {
        matches!(self, Self::PushPull(_) | Self::WellSpaced(_))
    }

    /// What its own chance depends on.
    pub fn seed(&self) -> Option<u64> {
        match self {
            Self::Procrustes(_) => None,
            Self::PushPull(params) => Some(params.seed),
            Self::WellSpaced(params) => Some(params.seed),
        }
    }

    /// Evens out a start as suits the method.
    pub fn warp(&self, points: &mut PointSet) {
        match self {
            Self::Procrustes(_) => warp(points),
            Self::PushPull(_) | Self::WellSpaced(_) => warp_isotropic(points),
        }
    }

    pub fn run(&self, points: &mut PointSet, run: &mut RunContext) -> Result<Report, Error> {
        match self {
            Self::Procrustes(params) => procrustes(points, params, run),
            Self::PushPull(params) => push_pull(points, params, run),
            Self::WellSpaced(params) => well_spaced(points, params, run),
        }
    }

    /// What to expect, where it is no good.
    pub fn advice(&self, space: &Space) -> Option<String> {
        match self {
            Self::Procrustes(_) => None,
            Self::PushPull(params) => params.advice(space),
            Self::WellSpaced(params) => params.advice(space),
        }
    }

    /// By how much points with these measures miss a target; 0 for a method that has none.
    pub fn worst_miss(&self, measures: &Measures) -> f64 {
        match self {
            Self::Procrustes(_) => 0.0,
            Self::PushPull(params) => params.worst_miss(measures),
            Self::WellSpaced(params) => params.worst_miss(measures),
        }
    }

    /// The targets that points with these measures miss; `None` for a method that has none.
    pub fn unmet(&self, measures: &Measures) -> Option<Vec<UnmetTarget>> {
        match self {
            Self::Procrustes(_) => None,
            Self::PushPull(params) => Some(params.unmet(measures)),
            Self::WellSpaced(params) => Some(params.unmet(measures).into_iter().collect()),
        }
    }
}
