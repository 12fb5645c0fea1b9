//! The methods, one file each; what serves one method alone stands in a folder of its name.

mod capacity;
mod cvt;
mod distmesh;
mod farthest_point;
mod lloyd;
mod obstacles;
mod opt_beta;
mod prepare;
mod procrustes;
mod push_pull;
mod relax;
mod targets;
mod well_spaced;

pub use capacity::{CapacityParams, capacity};
pub use cvt::{CvtParams, cvt};
pub use distmesh::{DistMeshParams, distmesh};
pub use farthest_point::{FarthestPointParams, farthest_point};
pub use lloyd::{LloydParams, lloyd};
pub(crate) use opt_beta::to_least_ratio;
pub use opt_beta::{OptBetaParams, opt_beta};
pub use procrustes::{Mode, ProcrustesParams, procrustes};
pub(crate) use push_pull::PushPull;
pub use push_pull::{PushPullParams, PushPullPreset, push_pull};

pub use targets::{Targets, UnmetTarget};
pub use well_spaced::{WellSpacedParams, angle_bounds_deg, well_spaced};
