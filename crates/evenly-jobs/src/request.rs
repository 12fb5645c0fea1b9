//! [`Request`]: any job, as one message.

use serde::{Deserialize, Serialize};

use crate::compare::{CompareOutcome, CompareRequest};
use crate::context::Context;
use crate::error::Error;
use crate::mesh::{MeshOutcome, MeshRequest};
use crate::points::{GenerateRequest, OptimizeRequest, PointsOutcome};
use crate::remesh::{RemeshOutcome, RemeshRequest};
use crate::resource::Resources;
use crate::sample::{SampleOutcome, SampleRequest};
use crate::stipple::{StippleOutcome, StippleRequest};

/// What evenly is asked for.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(tag = "job", rename_all = "snake_case")]
pub enum Request {
    /// Points from nothing.
    Generate(GenerateRequest),
    /// Better points from points.
    Optimize(OptimizeRequest),
    /// Triangles in a polygon.
    Mesh(MeshRequest),
    /// A surface's new mesh.
    Remesh(RemeshRequest),
    /// Points on a surface.
    Sample(SampleRequest),
    /// A picture as dots.
    Stipple(StippleRequest),
    /// Several methods on the same points.
    Compare(CompareRequest),
}

/// What comes back.
pub enum Outcome {
    /// Of `generate` and `optimize`.
    Points(PointsOutcome),
    /// Of `mesh`.
    Mesh(MeshOutcome),
    /// Of `remesh`.
    Remesh(RemeshOutcome),
    /// Of `sample`.
    Sample(SampleOutcome),
    /// Of `stipple`.
    Stipple(StippleOutcome),
    /// Of `compare`.
    Compare(CompareOutcome),
}

impl Request {
    /// Does what is asked for.
    ///
    /// # Errors
    /// What is wrong with the request, or its data.
    pub fn run(&self, resources: &mut dyn Resources, context: &mut Context) -> Result<Outcome, Error> {
        Ok(match self {
            Self::Generate(request) => Outcome::Points(request.run(resources, context)?),
            Self::Optimize(request) => Outcome::Points(request.run(resources, context)?),
            Self::Mesh(request) => Outcome::Mesh(request.run(resources, context)?),
            Self::Remesh(request) => Outcome::Remesh(request.run(resources, context)?),
            Self::Sample(request) => Outcome::Sample(request.run(resources, context)?),
            Self::Stipple(request) => Outcome::Stipple(request.run(resources, context)?),
            Self::Compare(request) => Outcome::Compare(request.run(resources, context)?),
        })
    }
}
