//! What sampling patterns are judged by in rendering and image processing.

mod bilateral;
mod image;
mod reconstruction;
mod tiled;
mod zone_plate;

pub use bilateral::{BilateralParams, bilateral, subsampled_bilateral};
pub use image::{Image, ImageDifference};
pub use reconstruction::ReconstructionFilter;
pub use zone_plate::{ZonePlate, ZonePlateParams, zone_plate};
