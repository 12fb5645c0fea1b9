//! How alike two pictures look: after a blur, the peak signal-to-noise ratio and the structural similarity.
//!
//! Wang, Bovik, Sheikh and Simoncelli, "Image Quality Assessment: From Error Visibility to Structural Similarity", IEEE Transactions on Image Processing 13(4), 2004,
//! doi 10.1109/TIP.2003.819861, with its Gaussian window of 1.5 pixels and its constants.

use rayon::prelude::*;
use serde::Serialize;

use super::image::Image;
use crate::error::Error;

/// How alike two pictures are.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Similarity {
    /// The peak signal-to-noise ratio, for intensities from 0 to 1; infinite for equal pictures.
    pub psnr_db: f64,
    /// The mean structural similarity over all pixels and channels, 1 for equal pictures.
    pub ssim: f64,
}

/// The window's standard deviation, in pixels, and the constants that steady the quotients.
const WINDOW: f64 = 1.5;
const STEADY_MEAN: f64 = 0.01 * 0.01;
const STEADY_VARIANCE: f64 = 0.03 * 0.03;
/// A Gaussian is cut off after so many standard deviations.
const REACH: f64 = 4.0;

impl Image {
    /// The picture after a Gaussian of this standard deviation in pixels, above 0; beyond its boundary it is mirrored.
    ///
    /// # Errors
    /// [`Error::InvalidParameter`] for a width that is not positive and finite.
    pub fn blurred(&self, sigma_px: f64) -> Result<Self, Error> {
        if !(sigma_px > 0.0 && sigma_px.is_finite()) {
            return Err(Error::InvalidParameter { name: "sigma_px", value: sigma_px.to_string(), expected: "positive and finite" });
        }
        let channels: Vec<Vec<f64>> = (0..self.n_channels()).map(|channel| blur(&self.channel(channel), self.width(), sigma_px)).collect();
        let values = (0..self.width() * self.height()).flat_map(|pixel| channels.iter().map(move |values| values[pixel])).collect();
        Self::new(self.width(), self.height(), self.n_channels(), values)
    }

    fn channel(&self, channel: usize) -> Vec<f64> {
        self.values().iter().skip(channel).step_by(self.n_channels()).copied().collect()
    }

    /// How alike it is to another.
    ///
    /// # Errors
    /// [`Error::InvalidParameter`] if sizes or channels differ.
    pub fn similarity(&self, other: &Self) -> Result<Similarity, Error> {
        let rmse = self.difference(other)?.rmse;
        let of_channel = |channel: usize| ssim(&self.channel(channel), &other.channel(channel), self.width());
        let ssim = (0..self.n_channels()).map(of_channel).sum::<f64>() / self.n_channels() as f64;
        Ok(Similarity { psnr_db: -20.0 * libm::log10(rmse), ssim })
    }
}

fn ssim(a: &[f64], b: &[f64], width: usize) -> f64 {
    let mean_of = |values: Vec<f64>| blur(&values, width, WINDOW);
    let product = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| x * y).collect::<Vec<f64>>();
    let (mean_a, mean_b) = (mean_of(a.to_vec()), mean_of(b.to_vec()));
    let [aa, bb, ab] = [product(a, a), product(b, b), product(a, b)].map(mean_of);
    let pixel = |k: usize| {
        let (ma, mb) = (mean_a[k], mean_b[k]);
        let (variances, covariance) = (aa[k] - ma * ma + bb[k] - mb * mb, ab[k] - ma * mb);
        let of_means = (2.0 * ma * mb + STEADY_MEAN) / (ma * ma + mb * mb + STEADY_MEAN);
        of_means * (2.0 * covariance + STEADY_VARIANCE) / (variances + STEADY_VARIANCE)
    };
    (0..a.len()).map(pixel).sum::<f64>() / a.len() as f64
}

/// Blurs one channel, rows and then columns.
fn blur(values: &[f64], width: usize, sigma_px: f64) -> Vec<f64> {
    let height = values.len() / width;
    transposed(&blur_rows(&transposed(&blur_rows(values, width, sigma_px), width), height, sigma_px), height)
}

fn blur_rows(values: &[f64], width: usize, sigma_px: f64) -> Vec<f64> {
    let reach = (REACH * sigma_px).ceil() as i64;
    let weights: Vec<f64> = (-reach..=reach).map(|k| libm::exp(-0.5 * (k as f64 / sigma_px).powi(2))).collect();
    let total: f64 = weights.iter().sum();
    // Beyond the boundary the picture is mirrored, again and again where the kernel is wider than it.
    let mirrored = |column: i64| {
        let turned = column.rem_euclid(2 * width as i64) as usize;
        if turned < width { turned } else { 2 * width - 1 - turned }
    };
    let rows = values.par_chunks(width).flat_map_iter(|row| {
        let padded: Vec<f64> = (-reach..width as i64 + reach).map(|column| row[mirrored(column)]).collect();
        (0..width).map(|k| padded[k..].iter().zip(&weights).map(|(value, weight)| value * weight).sum::<f64>() / total).collect::<Vec<_>>()
    });
    rows.collect()
}

/// Columns as rows.
fn transposed(values: &[f64], width: usize) -> Vec<f64> {
    let height = values.len() / width;
    (0..width).flat_map(|column| (0..height).map(move |row| values[column + row * width])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(width: usize, height: usize, value: impl Fn(usize, usize) -> f64) -> Image {
        let values = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| value(x, y)).collect();
        Image::new(width, height, 1, values).unwrap()
    }

    #[test]
    fn a_blur_keeps_the_mean_and_takes_out_what_is_fine() {
        let stripes = picture(60, 41, |x, y| ((x + y) % 2) as f64);
        let blurred = stripes.blurred(3.0).unwrap();
        assert!(blurred.values().iter().all(|value| (value - 0.5).abs() < 0.02));
        let spot = picture(61, 61, |x, y| if (x, y) == (30, 30) { 1.0 } else { 0.0 }).blurred(2.0).unwrap();
        assert!((spot.values().iter().sum::<f64>() - 1.0).abs() < 1e-9);
        assert!((spot.values()[30 + 61 * 30] - 1.0 / (std::f64::consts::TAU * 4.0)).abs() < 1e-4);
        assert!(stripes.blurred(0.0).is_err());
        // A kernel wider than the picture.
        assert!((picture(1, 3, |_, y| y as f64).blurred(50.0).unwrap().values()[0] - 1.0).abs() < 0.01);
    }

    #[test]
    fn similarity_is_one_for_equals_and_falls_with_noise() {
        let ramp = picture(50, 50, |x, y| (x + y) as f64 / 98.0);
        let same = ramp.similarity(&ramp).unwrap();
        assert!(same.psnr_db == f64::INFINITY && (same.ssim - 1.0).abs() < 1e-12);
        let noisy = picture(50, 50, |x, y| (x + y) as f64 / 98.0 + 0.1 * ((x * 7 + y * 13) % 3) as f64 - 0.1);
        let seen = ramp.similarity(&noisy).unwrap();
        assert!(seen.ssim < 0.8 && (seen.psnr_db - 21.76).abs() < 0.1, "{seen:?}");
        assert!(ramp.similarity(&picture(50, 49, |_, _| 0.0)).is_err());
    }
}
