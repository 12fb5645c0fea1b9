//! The methods, one file each; what serves one method alone stands in a folder of its name.

mod procrustes;

pub use procrustes::{Mode, ProcrustesParams, procrustes};
