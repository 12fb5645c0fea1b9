//! The zone plate sin(x^2 + y^2): all waves of all directions in one picture, the test of sampling patterns for anti-aliasing.
//!
//! One sample a pixel, and a reconstruction filter, as in Ahmed, Guo, Yan et al., "A Simple Push-Pull Algorithm for Blue-Noise Sampling", 2017, section 5.2, and Ebeida et al.,
//! "Improving Spatial Coverage while Preserving the Blue Noise of Point Sets", 2014, section 6.3. They judge by eye; here the error, the difference to the plate
//! seen through the same filter without sampling, is split by what Heck, Schloemer and Deussen (2013) call noise and aliasing. Noise is what disturbs waves slow
//! enough to be sampled. Aliasing is that false coarse patterns gather: the error's coarse part, looked at by the frequency of the wave that it stands on, is even for
//! white noise, and rises above its mean where a pattern is in step with the wave.

use rayon::prelude::*;
use serde::Serialize;

use super::image::Image;
use super::reconstruction::ReconstructionFilter;
use super::tiled::tiled;
use crate::error::Error;
use crate::points::PointSet;

/// How [`zone_plate`] samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ZonePlateParams {
    /// Pixels a side, 16 to 4096. A torus' set is repeated until it fills them; a rectangle's must be large enough.
    pub pixels: usize,
    /// The wave's frequency at the right and the upper side, in waves a pixel, above 0 and at most 8. From a half on no regular grid of samples can tell it.
    pub max_frequency: f64,
    /// What makes pixels of samples.
    pub filter: ReconstructionFilter,
}

impl Default for ZonePlateParams {
    fn default() -> Self {
        Self { pixels: 512, max_frequency: 1.5, filter: ReconstructionFilter::Mitchell }
    }
}

/// What [`zone_plate`] finds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ZonePlate {
    /// The sampled plate, its middle in the lower left corner; grey, 0 to 1 where the filter does not overshoot.
    #[serde(skip)]
    pub image: Image,
    /// The plate through the same filter without sampling.
    #[serde(skip)]
    pub ideal: Image,
    /// Root mean square of the error, as a part of the wave's amplitude.
    pub error: f64,
    /// The same where the wave is slower than 0.4 waves a pixel: what should not be there at all.
    pub noise: f64,
    /// By how much false coarse patterns exceed their mean where they gather: 0 for none, as for white noise; root mean square over the plate.
    pub aliasing: f64,
    /// Pixels that no sample adds to; they are grey.
    pub empty_pixels: usize,
}

/// Samples the plate with one sample a pixel.
///
/// # Errors
/// [`Error::Degenerate`] for no points, and a rectangle whose points are fewer than the pixels; [`Error::InvalidParameter`] for a parameter out of its range.
///
/// # Example
/// ```
/// use evenly::{Torus, ZonePlateParams, jittered, white, zone_plate};
///
/// let unit = Torus::new([0.0, 0.0], [1.0, 1.0])?;
/// let params = ZonePlateParams { pixels: 128, ..ZonePlateParams::default() };
/// let noisy = zone_plate(&white(unit, 128 * 128, 1)?, &params)?;
/// let better = zone_plate(&jittered(unit, 128 * 128, 1)?, &params)?;
/// assert!(better.noise < noisy.noise);
/// # Ok::<(), evenly::Error>(())
/// ```
pub fn zone_plate(points: &PointSet, params: &ZonePlateParams) -> Result<ZonePlate, Error> {
    let wrong = |name, value: String, expected| Err(Error::InvalidParameter { name, value, expected });
    let ZonePlateParams { pixels, max_frequency, filter } = *params;
    if !(16..=4096).contains(&pixels) {
        return wrong("pixels", pixels.to_string(), "from 16 to 4096");
    }
    if !(max_frequency > 0.0 && max_frequency <= 8.0) {
        return wrong("max_frequency", max_frequency.to_string(), "above 0 and at most 8");
    }
    let plate = Plate { pixels, filter, chirp: std::f64::consts::PI * max_frequency / pixels as f64 };
    let (sampled, empty_pixels) = plate.sample(&tiled(points, 1.0, [pixels as f64; 2], filter.radius())?);
    let ideal = plate.ideal();
    let error: Vec<f64> = sampled.iter().zip(&ideal).map(|(a, b)| a - b).collect();
    let rms = |squares: &mut dyn Iterator<Item = f64>| {
        let (sum, n) = squares.fold((0.0, 0.0), |(sum, n), square| (sum + square, n + 1.0));
        if n > 0.0 { f64::sqrt(sum / n) } else { 0.0 }
    };
    let slow = (0..error.len()).filter(|&index| plate.frequency(index) < SLOW);
    let noise = rms(&mut slow.map(|index| error[index] * error[index]));
    let shown = |waves: &[f64]| Image::new(pixels, pixels, 1, waves.iter().map(|wave| 0.5 + 0.5 * wave).collect());
    Ok(ZonePlate {
        image: shown(&sampled)?,
        ideal: shown(&ideal)?,
        error: rms(&mut error.iter().map(|e| e * e)),
        noise,
        aliasing: plate.aliasing(&error),
        empty_pixels,
    })
}

/// Waves slower than this, in waves a pixel, are those that should come out right.
const SLOW: f64 = 0.4;

struct Plate {
    pixels: usize,
    filter: ReconstructionFilter,
    /// The wave is sin(chirp r^2), r in pixels from the lower left corner.
    chirp: f64,
}

impl Plate {
    /// A pixel's middle, from the lower left corner; rows begin at the top.
    fn middle(&self, index: usize) -> [f64; 2] {
        [(index % self.pixels) as f64 + 0.5, (self.pixels - 1 - index / self.pixels) as f64 + 0.5]
    }

    /// The wave's frequency at a pixel, in waves a pixel.
    fn frequency(&self, index: usize) -> f64 {
        let [x, y] = self.middle(index);
        self.chirp * libm::hypot(x, y) / std::f64::consts::PI
    }

    /// Each pixel is the mean of the samples near it, weighted by the filter, or, where its negative lobes all but cancel, by its positive part; and how many pixels
    /// have no sample.
    fn sample(&self, places: &[[f64; 2]]) -> (Vec<f64>, usize) {
        let n = self.pixels as i64;
        /// What the weights of a pixel must sum to at least; of even samples it is 1.
        const LEAST: f64 = 0.1;
        let mut sums = vec![[[0.0, 0.0]; 2]; self.pixels * self.pixels];
        let reach = self.filter.radius();
        for &[x, y] in places {
            let value = libm::sin(self.chirp * (x * x + y * y));
            let near = |at: f64| ((at - 0.5 - reach).ceil() as i64).max(0)..=((at - 0.5 + reach).floor() as i64).min(n - 1);
            for row in near(y) {
                let of_row = self.filter.weight(row as f64 + 0.5 - y);
                for column in near(x) {
                    let weight = of_row * self.filter.weight(column as f64 + 0.5 - x);
                    for ([sum, weights], weight) in sums[(column + (n - 1 - row) * n) as usize].iter_mut().zip([weight, weight.max(0.0)]) {
                        *sum += weight * value;
                        *weights += weight;
                    }
                }
            }
        }
        let n_empty = sums.iter().filter(|[_, [_, weights]]| *weights == 0.0).count();
        let mean = |[[sum, weights], [positive, of_positive]]: [[f64; 2]; 2]| match () {
            () if weights >= LEAST => sum / weights,
            () if of_positive > 0.0 => positive / of_positive,
            () => 0.0,
        };
        (sums.into_iter().map(mean).collect(), n_empty)
    }

    /// The wave through the filter: sin(x^2 + y^2) = sin x^2 cos y^2 + cos x^2 sin y^2, each factor along its axis.
    fn ideal(&self) -> Vec<f64> {
        const STEPS: usize = 256;
        let reach = self.filter.radius();
        let along: Vec<[f64; 2]> = (0..self.pixels)
            .map(|pixel| {
                let mut sums = [0.0; 3];
                for step in 0..STEPS {
                    let offset = reach * (2.0 * (step as f64 + 0.5) / STEPS as f64 - 1.0);
                    let weight = self.filter.weight(offset);
                    let (sine, cosine) = libm::sincos(self.chirp * (pixel as f64 + 0.5 + offset).powi(2));
                    sums = [sums[0] + weight * sine, sums[1] + weight * cosine, sums[2] + weight];
                }
                [sums[0] / sums[2], sums[1] / sums[2]]
            })
            .collect();
        let value = |index: usize| {
            let [[sx, cx], [sy, cy]] = [along[index % self.pixels], along[self.pixels - 1 - index / self.pixels]];
            sx * cy + cx * sy
        };
        (0..self.pixels * self.pixels).map(value).collect()
    }

    /// The root mean square of by how much the error's coarse part exceeds its mean, over rings of the wave's frequency.
    fn aliasing(&self, error: &[f64]) -> f64 {
        /// Pixels of a ring: some samples of the coarse error across it.
        const RING: f64 = 8.0;
        let coarse = self.blurred(error);
        let mut rings: Vec<[f64; 2]> = Vec::new();
        for (index, value) in coarse.iter().enumerate() {
            let [x, y] = self.middle(index);
            let ring = (libm::hypot(x, y) / RING) as usize;
            rings.resize(rings.len().max(ring + 1), [0.0; 2]);
            rings[ring][0] += value * value;
            rings[ring][1] += 1.0;
        }
        let mean = coarse.iter().map(|value| value * value).sum::<f64>() / coarse.len() as f64;
        if mean == 0.0 {
            return 0.0;
        }
        let excess = rings.iter().filter(|[_, n]| *n > 0.0).map(|[sum, n]| n * (sum / n / mean - 1.0).max(0.0).powi(2));
        (excess.sum::<f64>() / coarse.len() as f64).sqrt()
    }

    /// Blurred by a Gaussian of two pixels, along rows and then along columns.
    fn blurred(&self, values: &[f64]) -> Vec<f64> {
        const DEVIATION: f64 = 2.0;
        const REACH: usize = 6;
        let weights: Vec<f64> = (0..=2 * REACH).map(|k| libm::exp(-0.5 * ((k as f64 - REACH as f64) / DEVIATION).powi(2))).collect();
        let n = self.pixels;
        let blur = |values: &[f64], index: usize, at: usize, step: usize| {
            let (mut sum, mut weight) = (0.0, 0.0);
            for (k, w) in weights.iter().enumerate() {
                // Beyond the boundary there is nothing.
                if let Some(other) = (at + k).checked_sub(REACH).filter(|other| *other < n) {
                    sum += w * values[index + other * step - at * step];
                    weight += w;
                }
            }
            sum / weight
        };
        let across: Vec<f64> = (0..n * n).into_par_iter().map(|index| blur(values, index, index % n, 1)).collect();
        (0..n * n).into_par_iter().map(|index| blur(&across, index, index / n, n)).collect()
    }
}

#[cfg(test)]
mod tests;
