//! What the library promises, in one binary.

#![allow(clippy::unwrap_used)]

#[path = "../shared/densities.rs"]
mod densities;
#[path = "../shared/shapes.rs"]
mod shapes;
#[path = "../shared/solids.rs"]
mod solids;

mod comparators;
mod creases;
mod density;
mod details;
mod fixed;
mod golden;
mod laws;
mod meshes;
mod methods;
mod oracles;
mod polygons;
mod spaces;
mod starts;
mod surfaces;
mod targets;
mod unions;
