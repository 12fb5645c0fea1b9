//! The power spectrum as a picture: log grey, the frequency 0 in the middle.

use evenly::PowerSpectrum;

use super::svg::{embedded, inset};
use crate::pixels::encode;

/// The powers that are black and white.
const POWERS: [f64; 2] = [1e-2, 1e1];
/// The most pixels a side; of more frequencies than that each pixel has the mean of some.
const MOST: usize = 513;

/// The lattice's frequencies up to the largest in each direction, `size` large.
pub(super) fn waves(spectrum: &PowerSpectrum, place: [f64; 2], size: [f64; 2]) -> String {
    let half = spectrum.half_size().map(|half| half as i64);
    let pixels = half.map(|half| (2 * half as usize + 1).min(MOST));
    let [width, height] = pixels;
    let mut sums = vec![[0.0, 0.0]; width * height];
    let pixel = |at: i64, axis: usize| (at + half[axis]) as usize * pixels[axis] / (2 * half[axis] as usize + 1);
    for b in -half[1]..=half[1] {
        for a in (-half[0]..=half[0]).filter(|&a| (a, b) != (0, 0)) {
            // Large frequencies of y are up.
            let [sum, n] = &mut sums[pixel(a, 0) + width * (height - 1 - pixel(b, 1))];
            *sum += spectrum.power(a, b).unwrap_or(0.0);
            *n += 1.0;
        }
    }
    let [low, high] = POWERS.map(f64::ln);
    let grey = |[sum, n]: [f64; 2]| (255.0 * ((sum / n).max(POWERS[0]).ln() - low) / (high - low)).clamp(0.0, 255.0) as u8;
    let pixels: Vec<u8> = sums.into_iter().map(grey).collect();
    let Ok(png) = encode(&pixels, width as u32, height as u32, png::ColorType::Grayscale, "") else { return String::new() };
    inset(place, size, size, &embedded(&png, size))
}
