//! The methods, one file each; what serves one method alone stands in a folder of its name.

mod prepare;
mod procrustes;
mod push_pull;
mod well_spaced;

pub use procrustes::{Mode, ProcrustesParams, procrustes};
pub use push_pull::{PushPullParams, PushPullPreset, UnmetTarget, push_pull};
pub use well_spaced::{WellSpacedParams, angle_bounds_deg, well_spaced};
