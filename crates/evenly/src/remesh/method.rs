//! [`RemeshMethod`]: by which rule the vertices of a surface mesh move.

use serde::Serialize;

use crate::error::Error;
use crate::optimize::{DistMeshParams, LloydParams, OptBetaParams, PushPullParams, WellSpacedParams};

/// How vertices find their places: the rules of the plane.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum RemeshMethod {
    /// To a smallest distance and a largest circumradius.
    PushPull(PushPullParams),
    /// To a ratio of both.
    WellSpaced(WellSpacedParams),
    /// To the centroids of the cells.
    Lloyd(LloydParams),
    /// To the least ratio of each cell by itself. A ratio has no size: cells keep about those of the start.
    OptBeta(OptBetaParams),
    /// They stay where the start has them: sample elimination, or given points.
    Eliminate,
    /// Where springs push that are as long as the spacing.
    DistMesh(DistMeshParams),
}

impl Default for RemeshMethod {
    /// The paper's {0.90, 0.63}, which leave no obtuse triangle, with a tolerance that takes a third of the time.
    fn default() -> Self {
        Self::PushPull(PushPullParams {
            min_distance: Some(0.90),
            coverage_radius: Some(0.63),
            capacity_tolerance: Some(0.1),
            ..PushPullParams::default()
        })
    }
}

impl RemeshMethod {
    /// Its name, as on the command line.
    pub fn name(&self) -> &'static str {
        match self {
            Self::PushPull(_) => "push-pull",
            Self::WellSpaced(_) => "well-spaced",
            Self::Lloyd(_) => "lloyd",
            Self::OptBeta(_) => "opt-beta",
            Self::Eliminate => "eliminate",
            Self::DistMesh(_) => "distmesh",
        }
    }

    /// # Errors
    /// As the method's parameters have it.
    pub(super) fn validate(&self) -> Result<(), Error> {
        match self {
            Self::PushPull(params) => params.validate(),
            Self::WellSpaced(params) => params.validate(),
            Self::Lloyd(params) => params.validate(),
            Self::OptBeta(params) => params.validate(),
            Self::Eliminate => Ok(()),
            Self::DistMesh(params) => params.validate(),
        }
    }
}
