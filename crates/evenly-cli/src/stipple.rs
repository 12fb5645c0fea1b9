//! From a picture to a drawing: what each pen draws, where on the paper, how large the dots are, and how true the tone is.

mod edges;
mod ink;
mod paper;
mod pen;
mod spread;
mod tone;

pub use edges::edges_of;
pub use ink::{Ink, Tones, shares};
pub use paper::Paper;
pub use pen::{dot_areas, widest_dot};
pub use spread::{optimizer, spread};
pub use tone::{ToneReport, Wanted};
