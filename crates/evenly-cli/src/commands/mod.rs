//! The verbs, one file each.

pub mod analyze;
pub mod compare;
pub mod generate;
pub mod optimize;
pub mod shell;
