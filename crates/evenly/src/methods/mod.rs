//! The methods, one file each; what serves one method alone stands in a folder of its name.

mod capacity;
mod cvt;
mod distmesh;
mod farthest_point;
mod lloyd;
mod local;
mod obstacles;
mod opt_beta;
mod optimizer;
mod prepare;
mod procrustes;
mod push_pull;
mod registry;
mod relax;
mod targets;
mod warp;
mod well_spaced;

pub use capacity::{CapacityParams, capacity};
pub use cvt::{CvtParams, cvt};
pub use distmesh::{DistMeshParams, distmesh};
pub use farthest_point::{FarthestPointParams, farthest_point};
pub use lloyd::{LloydParams, lloyd};
pub use local::LocalMethod;
pub(crate) use local::{ByRule, Local};
pub(crate) use opt_beta::to_least_ratio;
pub use opt_beta::{OptBetaParams, opt_beta};
pub use optimizer::Optimizer;
pub use procrustes::{Mode, ProcrustesParams, procrustes};
pub(crate) use push_pull::PushPull;
pub use push_pull::{PushPullParams, PushPullPreset, push_pull};
pub use registry::Method;
pub use targets::{Targets, UnmetTarget};
use warp::Warp;
pub use well_spaced::{WellSpacedParams, angle_bounds_deg, well_spaced};
