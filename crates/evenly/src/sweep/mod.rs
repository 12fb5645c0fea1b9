//! The engine of all local methods: who is visited, in which order, on which thread, what is looked at again, and when to stop.
//!
//! It knows no rule and no space: a [`Rule`](crate::star::Rule) sees stars, a [`LiveMesh`](crate::triangulation::LiveMesh) places.

mod cells;
mod engine;
mod summed;
mod visit;

pub use engine::Schedule;
pub(crate) use engine::{Ending, Order, Plan, Sweep};
