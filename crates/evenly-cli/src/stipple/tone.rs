//! How true the tone is: the picture and the drawing, both seen from so far that dots blur.

use evenly::{Error, Image, PointSet, dot_coverage};
use serde::Serialize;

use super::ink::Ink;

/// The drawing against the picture.
#[derive(Serialize)]
pub struct ToneReport {
    /// How much of the picture's darkness the dots have, on average.
    pub ink_share: f64,
    /// After a Gaussian of four dot spacings, and with the ink brought to the picture's mean.
    pub psnr_db: f64,
    pub ssim: f64,
}

/// The Gaussian's standard deviation, in dot spacings.
const BLUR: f64 = 4.0;
/// Pixels to a dot spacing, and the largest side of the pictures that are compared.
const FINE: f64 = 2.0;
const LARGEST: f64 = 4096.0;

/// Compares dots of these radii, in the units of the points' domain, with what they are to show.
///
/// # Errors
/// As [`dot_coverage`].
pub fn compare_tone(points: &PointSet, ink: &Ink, radii: &[f64]) -> Result<ToneReport, Error> {
    let [width, height] = points.space().size();
    let spacing = (points.space().area() / points.n_points().max(1) as f64).sqrt();
    let per_unit = (FINE / spacing).min(LARGEST / width.max(height));
    let [columns, rows] = [width, height].map(|side| (side * per_unit).round().max(1.0) as usize);
    let seen = dot_coverage(points, radii, columns, rows)?;
    let mean = seen.values().iter().sum::<f64>() / seen.values().len() as f64;
    let ink_share = mean / ink.mean_darkness;
    let grey = |values: Vec<f64>| Image::new(columns, rows, 1, values)?.blurred(BLUR * spacing * per_unit);
    let scale = if mean > 0.0 { 1.0 / ink_share } else { 0.0 };
    let drawn = grey(seen.values().iter().map(|value| 1.0 - scale * value).collect())?;
    let wanted = grey(ink.darkness.resampled(columns, rows).into_iter().map(|value| 1.0 - ink.mean_darkness * value).collect())?;
    let similarity = wanted.similarity(&drawn)?;
    Ok(ToneReport { ink_share, psnr_db: similarity.psnr_db, ssim: similarity.ssim })
}
