//! How true the tone is: the picture and the drawing, both seen from so far that dots blur.

use evenly::{Density, Error, Image, PointSet, dot_coverage};
use serde::Serialize;

/// The drawing against the picture.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ToneReport {
    /// How much of the picture's darkness the dots have, on average.
    pub ink_share: f64,
    /// After a Gaussian of four dot spacings, and with the ink brought to the picture's mean. Absent where dots are too fine to be seen.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub psnr_db: Option<f64>,
    /// As `psnr_db`: the mean structural similarity.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ssim: Option<f64>,
}

/// The Gaussian's standard deviation, in dot spacings.
const BLUR: f64 = 4.0;
/// Pixels to a dot spacing, and the largest side of the pictures that are compared.
const FINE: f64 = 2.0;
const LARGEST: f64 = 4096.0;

/// What a drawing is to look like from afar.
pub struct Wanted {
    picture: Image,
    mean_darkness: f64,
    blur_px: f64,
}

impl Wanted {
    /// From a picture's darkness, for so many dots.
    ///
    /// # Errors
    /// As [`Image::new`].
    pub fn new(points: &PointSet, darkness: &Density, mean_darkness: f64) -> Result<Self, Error> {
        let [width, height] = points.space().size();
        let spacing = (points.space().area() / points.n_points().max(1) as f64).sqrt();
        let per_unit = (FINE / spacing).min(LARGEST / width.max(height));
        let [columns, rows] = [width, height].map(|side| (side * per_unit).round().max(1.0) as usize);
        let blur_px = BLUR * spacing * per_unit;
        let tones = darkness.resampled(columns, rows).into_iter().map(|value| 1.0 - mean_darkness * value).collect();
        Ok(Self { picture: Image::new(columns, rows, 1, tones)?.blurred(blur_px)?, mean_darkness, blur_px })
    }

    /// Compares it with dots of these radii, in the units of the points' domain.
    ///
    /// # Errors
    /// As [`dot_coverage`].
    pub fn compare(&self, points: &PointSet, radii: &[f64]) -> Result<ToneReport, Error> {
        let (width, height) = (self.picture.width(), self.picture.height());
        let seen = dot_coverage(points, radii, width, height)?;
        let mean = seen.values().iter().sum::<f64>() / seen.values().len() as f64;
        let ink_share = mean / self.mean_darkness;
        if mean == 0.0 {
            return Ok(ToneReport { ink_share, psnr_db: None, ssim: None });
        }
        let drawn = seen.values().iter().map(|value| 1.0 - value / ink_share).collect();
        let drawn = Image::new(width, height, 1, drawn)?.blurred(self.blur_px)?;
        let similarity = self.picture.similarity(&drawn)?;
        Ok(ToneReport { ink_share, psnr_db: Some(similarity.psnr_db), ssim: Some(similarity.ssim) })
    }
}
