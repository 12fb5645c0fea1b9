//! [`MeshMethod`]: by which rule the points of a mesh move.

use serde::Serialize;

use crate::error::Error;
use crate::optimize::{DistMeshParams, LloydParams, OptBetaParams};

/// How the points of a mesh find their places. Those on the border and on lines move along their segment, and corners stay, whatever the method.
///
/// Where triangles are bad then, points are added or removed and the method goes on there; the last bad ones are polished.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum MeshMethod {
    /// To one shortest distance and one largest circumradius: beta 0.74.
    #[default]
    PushPull,
    /// To the least ratio of each cell by itself. It knows no spacing: where that is to vary, the points keep it only as they were scattered.
    OptBeta(OptBetaParams),
    /// To the centroids of the cells, weighted by the spacing's inverse to the fourth.
    Lloyd(LloydParams),
    /// Where springs push that are as long as the spacing.
    DistMesh(DistMeshParams),
}

impl MeshMethod {
    /// # Errors
    /// As the method's parameters have it.
    pub(super) fn validate(&self) -> Result<(), Error> {
        match self {
            Self::PushPull => Ok(()),
            Self::OptBeta(params) => params.validate(),
            Self::Lloyd(params) => params.validate(),
            Self::DistMesh(params) => params.validate(),
        }
    }
}
