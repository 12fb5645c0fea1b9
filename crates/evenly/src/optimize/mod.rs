//! The methods, one file each.

mod border;
mod mesh;
mod procrustes;

pub use procrustes::{Mode, ProcrustesParams, procrustes};
