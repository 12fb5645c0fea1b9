//! The papers' tables and figures, recomputed.

mod filtering;
mod html;
mod lab;
mod models;
mod opt_beta;
mod part;
mod procrustes;
mod push_pull;
mod recipes;
mod spread;
mod study;
mod surfaces;

pub use html::html;
pub use lab::Lab;
pub use study::{Done, Study};

/// The papers.
pub const STUDIES: [Study; 3] = [procrustes::STUDY, push_pull::STUDY, opt_beta::STUDY];
