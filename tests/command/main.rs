//! What the command line promises, in one binary.

#![allow(clippy::unwrap_used)]

#[path = "../shared/shapes.rs"]
mod shapes;
#[path = "../shared/solids.rs"]
mod solids;

mod cli;
mod mesh_files;
mod proof;
mod regions;
mod shell;
mod stipple;
mod surface_files;
