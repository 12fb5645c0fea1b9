//! The engine of all local methods: who is visited, in which order, on which thread, what is looked at again, and when to stop.
//!
//! It knows no rule and no space: a [`Rule`](crate::star::Rule) sees stars, a [`Ground`] places.

mod cells;
mod engine;
mod ground;
mod summed;
mod visit;

pub(crate) use cells::Cells;
pub use engine::Schedule;
pub(crate) use engine::{Ending, Order, Plan, Sweep};
pub(crate) use ground::{Buffer, Ground, Reading};
