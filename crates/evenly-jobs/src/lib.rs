//! What evenly is asked for, as plain data, and how it is done: the command line, Python and others send the same requests, and get the same outcomes.
//!
//! A [`Request`] goes to JSON and back. Its data are in it, or have names under which the face finds them ([`Resources`]). Nothing here opens a file or prints.
//!
//! ```
//! use evenly_jobs::{Context, Ending, GenerateRequest, Nothing};
//!
//! let request = r#"{"n_points": 500, "method": "push-pull", "parameters": {"min_distance": 0.85}, "seed": 7}"#;
//! let request: GenerateRequest = serde_json::from_str(request)?;
//! let outcome = request.run(&mut Nothing, &mut Context::default())?;
//! let measured = outcome.measured();
//! assert_eq!((outcome.points.n_points(), outcome.ending(Some(&measured))), (500, Ending::Done));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod compare;
mod context;
mod error;
mod given;
mod memory;
mod mesh;
mod message;
mod method;
mod points;
mod remesh;
mod request;
mod resource;
mod sample;
#[cfg(test)]
mod schema;
mod space;
mod steps;
mod stipple;
mod surface;

pub use compare::{Column, CompareOutcome, CompareRequest, CompareRun, Compared};
pub use context::{Context, Event, Stage};
pub use error::{Error, names};
pub use given::positioned;
pub use mesh::{MeshMeasured, MeshOutcome, MeshRequest, UnmetAngle};
pub use message::{Message, Plain, Wording};
pub use method::{Job, default_of, jobs_of, registry};
pub use points::{Ending, GenerateRequest, OptimizeRequest, PointsLengths, PointsMeasured, PointsOutcome};
pub use remesh::{RemeshMeasured, RemeshOutcome, RemeshRequest};
pub use request::{Outcome, Request};
pub use resource::{Colours, Data, Lengths, Lines, Nothing, Pixels, Places, Positions, Regions, Resource, Resources, Rings, Triangles};
pub use sample::{SampleOutcome, SampleRequest};
pub use space::{Domain, Metric};
pub use steps::{Step, Steps};
pub use stipple::{DotLayer, DotSizes, DrawOrder, InkTone, Layers, StippleOutcome, StippleRequest, ToneReport, Wanted};
pub use surface::{OrOff, Sizing, is_resource, place_attributes, surface_of};
