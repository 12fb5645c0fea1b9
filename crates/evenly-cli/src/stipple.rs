//! From a picture to a drawing: what each pen draws, where on the paper, how large the dots are, and how true the tone is.

mod dots;
mod edges;
mod ink;
mod paper;
mod pen;
mod spread;
mod tone;

pub use dots::{Dots, DotsParams, dots};
pub use edges::edges_of;
pub use ink::{Ink, Tones, shares};
pub use paper::Paper;
pub use spread::optimizer;
pub use tone::{ToneReport, Wanted};
