//! What sampling patterns are judged by in rendering and image processing.

mod bilateral;
mod coverage;
mod image;
mod reconstruction;
mod similarity;
mod tiled;
mod zone_plate;

pub use bilateral::{BilateralParams, bilateral, subsampled_bilateral};
pub use coverage::dot_coverage;
pub use image::{Image, ImageDifference};
pub use reconstruction::ReconstructionFilter;
pub use similarity::Similarity;
pub use zone_plate::{ZonePlate, ZonePlateParams, zone_plate};
