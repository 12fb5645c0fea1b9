//! The methods, one file each; what serves one method alone stands in a folder of its name.

mod prepare;
mod procrustes;
mod push_pull;

pub use procrustes::{Mode, ProcrustesParams, procrustes};
pub use push_pull::{PushPullParams, PushPullPreset, UnmetTarget, push_pull};
