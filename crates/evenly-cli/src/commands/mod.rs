//! The verbs, one file each.

pub mod analyze;
pub mod bilateral;
pub mod compare;
pub mod generate;
pub mod mesh;
pub mod methods;
pub mod optimize;
pub mod remesh;
pub mod reproduce;
pub mod sample;
pub mod shell;
pub mod stipple;
pub mod zoneplate;
