//! Bilateral filtering, of all pixels of a kernel or of a few: where blue noise saves time.
//!
//! Tomasi and Manduchi, "Bilateral Filtering for Gray and Color Images", ICCV 1998; with samples, Banterle, Corsini, Cignoni and Scopigno, "A Low-Memory, Straightforward and Fast
//! Bilateral Filter Through Subsampling in Spatial Domain", Computer Graphics Forum 31(1), 2012; as an application of well-spaced points, Ebeida et al. (2014), section 7.1 and Table 2.
//! The papers leave open where a kernel's samples come from: here the set is laid over the picture, repeated if it is a torus, and a kernel takes those that lie in it.

use rayon::prelude::*;

use super::image::Image;
use super::tiled::tiled;
use crate::error::Error;
use crate::points::PointSet;

/// How [`bilateral`] filters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BilateralParams {
    /// The kernel's width and height, in pixels, 2 to 1000; its Gaussian's standard deviation is a fifth of it.
    pub kernel_px: f64,
    /// The standard deviation of the Gaussian over differences of intensity, a millionth at least: the smaller, the sharper edges stay.
    pub range: f64,
    /// Samples in a kernel on average, 1 or more; not looked at where all pixels are taken.
    pub n_samples: f64,
}

impl Default for BilateralParams {
    /// The papers' recommendation: 40 pixels and 30 samples.
    fn default() -> Self {
        Self { kernel_px: 40.0, range: 0.1, n_samples: 30.0 }
    }
}

/// Filters with all pixels of each kernel.
///
/// # Errors
/// [`Error::InvalidParameter`] for a parameter out of its range.
pub fn bilateral(image: &Image, params: &BilateralParams) -> Result<Image, Error> {
    validate(params)?;
    let half = 0.5 * params.kernel_px;
    let kernel = Kernel::new(params);
    let of_place: Vec<f64> = (0..=half as usize).map(|offset| kernel.of_place(offset as f64)).collect();
    let near = |at: usize, n: usize| (at as f64 - half).ceil().max(0.0) as usize..=((at as f64 + half).floor() as usize).min(n - 1);
    filtered(image, |x, y, mean| {
        let centre = image.pixel(x, y);
        for row in near(y, image.height()) {
            for column in near(x, image.width()) {
                let pixel = image.pixel(column, row);
                let of_place = of_place[row.abs_diff(y)] * of_place[column.abs_diff(x)];
                mean.add(pixel, of_place * kernel.of_range(centre, pixel));
            }
        }
    })
}

/// Filters with those pixels alone on which a sample of the set lies. The set is laid over the picture so that a kernel holds
/// [`n_samples`](BilateralParams::n_samples) on average.
///
/// # Errors
/// As [`bilateral`]; [`Error::Degenerate`] for no points, and a rectangle whose points do not cover the picture.
pub fn subsampled_bilateral(image: &Image, samples: &PointSet, params: &BilateralParams) -> Result<Image, Error> {
    validate(params)?;
    let half = 0.5 * params.kernel_px;
    let kernel = Kernel::new(params);
    let spacing = params.kernel_px / params.n_samples.sqrt();
    let size = [image.width() as f64, image.height() as f64];
    let places = tiled(samples, spacing, size, 0.0)?;
    // Samples by cells as large as half a kernel, or a few pixels.
    let cell = half.max(8.0);
    let n_cells = size.map(|side| ((side / cell).ceil() as usize).max(1));
    let mut cells: Vec<Vec<[f64; 2]>> = vec![Vec::new(); n_cells[0] * n_cells[1]];
    for [x, y] in places {
        // Places count from the bottom, rows from the top; pixels are where their middles are.
        let at = [x - 0.5, size[1] - y - 0.5];
        let [column, row] = [0, 1].map(|axis| ((at[axis].max(0.0) / cell) as usize).min(n_cells[axis] - 1));
        cells[column + row * n_cells[0]].push(at);
    }
    let near = |at: usize, axis: usize| {
        let of = |at: f64| ((at.max(0.0) / cell) as usize).min(n_cells[axis] - 1);
        of(at as f64 - half)..=of(at as f64 + half)
    };
    filtered(image, |x, y, mean| {
        let centre = image.pixel(x, y);
        for row in near(y, 1) {
            for column in near(x, 0) {
                for [u, v] in &cells[column + row * n_cells[0]] {
                    let (dx, dy) = (u - x as f64, v - y as f64);
                    if dx.abs().max(dy.abs()) <= half {
                        let pixel = image.pixel(
                            (u.round().max(0.0) as usize).min(image.width() - 1),
                            (v.round().max(0.0) as usize).min(image.height() - 1),
                        );
                        mean.add(pixel, kernel.of_place(dx) * kernel.of_place(dy) * kernel.of_range(centre, pixel));
                    }
                }
            }
        }
        // Where no sample is like it, the pixel stays as it is.
        mean.add(centre, 1e-9);
    })
}

fn validate(params: &BilateralParams) -> Result<(), Error> {
    let wrong = |name, value: f64, expected| Err(Error::InvalidParameter { name, value: value.to_string(), expected });
    if !(2.0..=1000.0).contains(&params.kernel_px) {
        return wrong("kernel_px", params.kernel_px, "from 2 to 1000");
    }
    if !(params.range >= 1e-6 && params.range.is_finite()) {
        return wrong("range", params.range, "finite, and a millionth at least");
    }
    if !(params.n_samples >= 1.0 && params.n_samples <= params.kernel_px * params.kernel_px) {
        return wrong("n_samples", params.n_samples, "1 or more, and no more than the kernel has pixels");
    }
    Ok(())
}

/// Each pixel from the weighted mean that `visit` fills.
fn filtered(image: &Image, visit: impl Fn(usize, usize, &mut Mean) + Sync) -> Result<Image, Error> {
    let (width, n_channels) = (image.width(), image.n_channels());
    let mut values = vec![0.0; image.values().len()];
    values.par_chunks_mut(width * n_channels).enumerate().for_each(|(y, row)| {
        for (x, pixel) in row.chunks_mut(n_channels).enumerate() {
            let mut mean = Mean::default();
            visit(x, y, &mut mean);
            pixel.iter_mut().zip(mean.sums).for_each(|(value, sum)| *value = sum / mean.weight);
        }
    });
    Image::new(width, image.height(), n_channels, values)
}

/// A weighted mean of pixels in the making.
#[derive(Default)]
struct Mean {
    sums: [f64; 3],
    weight: f64,
}

impl Mean {
    fn add(&mut self, pixel: &[f64], weight: f64) {
        self.sums.iter_mut().zip(pixel).for_each(|(sum, value)| *sum += weight * value);
        self.weight += weight;
    }
}

/// The two Gaussians.
struct Kernel {
    /// -1 / (2 sigma^2) each.
    place: f64,
    range: f64,
}

impl Kernel {
    fn new(params: &BilateralParams) -> Self {
        let exponent = |deviation: f64| -0.5 / (deviation * deviation);
        Self { place: exponent(params.kernel_px / 5.0), range: exponent(params.range) }
    }

    fn of_place(&self, offset: f64) -> f64 {
        libm::exp(self.place * offset * offset)
    }

    fn of_range(&self, centre: &[f64], pixel: &[f64]) -> f64 {
        let squared: f64 = centre.iter().zip(pixel).map(|(a, b)| (a - b) * (a - b)).sum();
        libm::exp(self.range * squared)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::points::Random;
    use crate::{RunContext, Torus, WellSpacedParams, hexagonal, poisson_disk_of, well_spaced, white};

    fn unit() -> Torus {
        Torus::new([0.0, 0.0], [1.0, 1.0]).unwrap()
    }

    /// Waves of all lengths and directions, the longer the stronger as in photographs, and edges.
    fn picture(width: usize, height: usize, n_channels: usize) -> Image {
        let mut random = Random::new(11, 0);
        let waves: Vec<[f64; 4]> = (0..40)
            .map(|k| {
                let (length, angle) = (100.0 * 0.93f64.powi(k), 7.0 * random.unit());
                let frequency = std::f64::consts::TAU / length;
                [frequency * angle.cos(), frequency * angle.sin(), 7.0 * random.unit(), 0.0006 * length]
            })
            .collect();
        let value = |index: usize| {
            let (channel, pixel) = (index % n_channels, index / n_channels);
            let (x, y) = ((pixel % width) as f64, (pixel / width) as f64);
            let edge = 0.3 * f64::from(u8::from((x / 37.0).sin() + (y / 29.0).cos() > 0.3));
            0.4 + edge + waves.iter().map(|[a, b, phase, height]| height * (a * x + b * y + phase + channel as f64).sin()).sum::<f64>()
        };
        Image::new(width, height, n_channels, (0..width * height * n_channels).map(value).collect()).unwrap()
    }

    #[test]
    fn a_flat_picture_stays_and_samples_on_all_pixels_are_the_full_filter() {
        let params = BilateralParams { kernel_px: 9.0, n_samples: 81.0, ..BilateralParams::default() };
        let flat = Image::new(20, 10, 3, vec![0.25; 600]).unwrap();
        assert!(bilateral(&flat, &params).unwrap().values().iter().all(|value| (value - 0.25).abs() < 1e-12));
        let grid = (0..400).map(|k| [(k % 20) as f64 + 0.5, (k / 20) as f64 + 0.5]).collect();
        let grid = PointSet::new(Torus::new([0.0, 0.0], [20.0, 20.0]).unwrap(), grid).unwrap();
        for image in [picture(50, 30, 1), picture(31, 47, 3), picture(1, 1, 1)] {
            let (all, few) = (bilateral(&image, &params).unwrap(), subsampled_bilateral(&image, &grid, &params).unwrap());
            assert!(all.difference(&few).unwrap().rmse < 1e-8);
        }
    }

    #[test]
    fn edges_stay_and_noise_goes() {
        let noisy = |x: usize, y: usize| f64::from(u8::from(x >= 32)) * 0.8 + 0.1 + 0.03 * ((x * 7 + y * 13) as f64).sin();
        let image = Image::new(64, 40, 1, (0..64 * 40).map(|k| noisy(k % 64, k / 64)).collect()).unwrap();
        let smooth = bilateral(&image, &BilateralParams::default()).unwrap();
        assert!((0..64).all(|x| (smooth.pixel(x, 20)[0] - if x < 32 { 0.1 } else { 0.9 }).abs() < 0.02));
    }

    #[test]
    fn even_samples_err_less_and_lattices_are_no_better() {
        // Table 2 of Ebeida et al.: white noise, maximal sets, well-spaced points, triangle tiling.
        let image = picture(300, 200, 1);
        let all = bilateral(&image, &BilateralParams::default()).unwrap();
        let error = |points: &PointSet| {
            let few = subsampled_bilateral(&image, points, &BilateralParams::default()).unwrap();
            few.difference(&all).unwrap().mean_error
        };
        let maximal = poisson_disk_of(unit(), 2000, 5).unwrap();
        let mut even = maximal.clone();
        well_spaced(&mut even, &WellSpacedParams::default(), &mut RunContext::default()).unwrap();
        let errors = [white(unit(), 2000, 5).unwrap(), maximal, even].map(|points| error(&points));
        assert!(errors[0] > 1.2 * errors[1] && errors[1] > errors[2], "{errors:?}");
        assert!(error(&hexagonal(unit(), 2000).unwrap()) > 0.9 * errors[2]);
    }

    #[test]
    fn wrong_parameters_and_pictures_are_errors() {
        let (image, points) = (picture(8, 8, 1), white(unit(), 10, 0).unwrap());
        let default = BilateralParams::default();
        for params in [
            BilateralParams { kernel_px: 1.0, ..default },
            BilateralParams { range: 1e-200, ..default },
            BilateralParams { n_samples: f64::NAN, ..default },
            BilateralParams { n_samples: 1e4, ..default },
        ] {
            assert!(bilateral(&image, &params).is_err() && subsampled_bilateral(&image, &points, &params).is_err());
        }
        assert!(subsampled_bilateral(&image, &PointSet::new(unit(), vec![]).unwrap(), &default).is_err());
        for (width, height, n_channels, n) in [(0, 1, 1, 0), (2, 2, 2, 8), (2, 2, 1, 3), (20_000, 20_000, 1, 1)] {
            assert!(Image::new(width, height, n_channels, vec![0.0; n]).is_err());
        }
        assert!(image.difference(&picture(8, 7, 1)).is_err());
    }
}
