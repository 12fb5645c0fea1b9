//! From a picture to a drawing: what each pen draws, where on the paper, how large the dots are, and how true the tone is.

mod edges;
mod ink;
mod paper;
mod pen;
mod spread;
mod tone;

pub use edges::edges_of;
pub use ink::{Ink, inks, shares};
pub use paper::Paper;
pub use pen::{Pen, dot_areas};
pub use spread::{optimizer, spread};
pub use tone::{ToneReport, compare_tone};
