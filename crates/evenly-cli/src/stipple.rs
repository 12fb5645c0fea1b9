//! From dots to a drawing: where on the paper they lie, and the edges between them.

mod edges;
mod paper;

pub use edges::edges_of;
pub use paper::Paper;
