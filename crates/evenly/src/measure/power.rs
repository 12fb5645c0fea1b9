//! The power spectrum: how much of each wave a point set holds, P(k) = |sum over the points of exp(-2 pi i k x)|^2 / n.
//!
//! A torus holds the waves whose frequencies are whole in both directions, k = (a / width, b / height), and there the spectrum is exact. A rectangle is looked
//! at through a window, sin^2 in both directions, that ends softly at its boundary: on the same frequencies it hides all of the mean density but the lowest nine.
//! White noise has the power 1 (Ulichney, "Digital Halftoning", 1987; Schloemer and Deussen, "Accurate Spectral Analysis of Two-Dimensional Point
//! Sets", Journal of Graphics, GPU, and Game Tools 15(3), 2011).
//!
//! Frequencies are in inverse mean spacings, sqrt(n / A). Cost: up to 20,000 points the sum itself, O(n) a frequency; above, O(n + m log m) for m frequencies, with
//! an error below a millionth.

mod direct;
mod gridding;
mod rings;
mod waves;

use serde::Serialize;

use super::sets::{mean_spacing, require_alike};
use crate::error::Error;
use crate::points::PointSet;
use rings::Rings;
use waves::{Waves, by_short_side};

/// What [`power_spectrum`] finds. A name of JSON is that of its field.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PowerSpectrum {
    /// How many sets it is the mean of.
    pub n_sets: usize,
    /// The largest frequency, in inverse mean spacings.
    pub max_frequency: f64,
    /// Radii of rings of frequencies, each as wide as the lattice of frequencies is coarse: 1 / the domain's shorter side.
    pub ring_frequencies: Vec<f64>,
    /// The mean power of each ring.
    pub ring_power: Vec<f64>,
    /// Each ring's anisotropy (Ulichney 1987), the variance of the power by the square of its mean, in decibels; what depends on no direction has
    /// -10 log10 of the number of sets. NaN where there is no power, or no difference.
    pub anisotropy_db: Vec<f64>,
    /// The lattice's steps, in inverse mean spacings, and the largest [a, b].
    #[serde(skip)]
    step: [f64; 2],
    #[serde(skip)]
    half: [usize; 2],
    /// Row by row for a from 0, b from -b_max; a is that of the domain's shorter side, so that rows are long.
    #[serde(skip)]
    power: Vec<f64>,
}

impl PowerSpectrum {
    /// Up to this frequency there is all that blue noise has to show, in inverse mean spacings.
    pub const MAX_FREQUENCY: f64 = 4.0;

    /// The largest `[a, b]` of the lattice of frequencies `(a / width, b / height)`.
    pub fn half_size(&self) -> [usize; 2] {
        self.half
    }

    /// The power at the frequency `(a / width, b / height)`; `None` outside the lattice.
    pub fn power(&self, a: i64, b: i64) -> Option<f64> {
        let [a, b] = by_short_side(self.half, [a, b]);
        let [a_max, b_max] = by_short_side(self.half, self.half).map(|half| half as i64);
        if a.unsigned_abs() > a_max as u64 || b.unsigned_abs() > b_max as u64 {
            return None;
        }
        // The spectrum of what is real is the same from both sides.
        let (a, b) = if a < 0 { (-a, -b) } else { (a, b) };
        Some(self.power[(a * (2 * b_max + 1) + b + b_max) as usize])
    }

    /// The steps of the lattice, in inverse mean spacings: `(a, b)` is the frequency `(a, b) * step`.
    pub fn step(&self) -> [f64; 2] {
        self.step
    }
}

/// Up to here waves are summed point by point.
const MOST_DIRECT: usize = 20_000;
/// The most frequencies of half the plane: half a gigabyte.
const MOST_FREQUENCIES: f64 = (1u64 << 26) as f64;

/// The mean power spectrum of sets on the same domain, for frequencies up to `max_frequency` inverse mean spacings in each direction; see [`PowerSpectrum::MAX_FREQUENCY`].
/// Of many millions of points the largest frequency is less, as the result says.
///
/// # Errors
/// [`Error::Degenerate`] for no sets, an empty one, and sets of different domains, or with numbers of points more than a tenth apart, which have no
/// frequencies in common; [`Error::InvalidParameter`] for a frequency that is not positive and finite.
///
/// # Example
/// ```
/// use evenly::{Torus, power_spectrum, white};
///
/// let noise = white(Torus::new([0.0, 0.0], [1.0, 1.0])?, 5000, 7)?;
/// let spectrum = power_spectrum(&[noise], 2.0)?;
/// let mean = spectrum.ring_power.iter().sum::<f64>() / spectrum.ring_power.len() as f64;
/// assert!((mean - 1.0).abs() < 0.1);
/// assert_eq!(spectrum.power(3, -5), spectrum.power(-3, 5));
/// # Ok::<(), evenly::Error>(())
/// ```
pub fn power_spectrum(sets: &[PointSet], max_frequency: f64) -> Result<PowerSpectrum, Error> {
    if !(max_frequency > 0.0 && max_frequency.is_finite()) {
        let (value, expected) = (max_frequency.to_string(), "positive and finite");
        return Err(Error::InvalidParameter { name: "max_frequency", value, expected });
    }
    require_alike(sets)?;
    let spacing = sets.iter().map(mean_spacing).sum::<f64>() / sets.len() as f64;
    let step = sets[0].space().size().map(|side| spacing / side);
    let most = (0.5 * MOST_FREQUENCIES * step[0] * step[1]).sqrt();
    let max_frequency = max_frequency.min(most);
    let half = step.map(|step| (max_frequency / step) as usize);
    let [n_rows, n_columns] = by_short_side(half, half);
    let mut power = vec![0.0; (n_rows + 1) * (2 * n_columns + 1)];
    for points in sets {
        let waves = Waves::new(points, half);
        let share = 1.0 / (waves.white_power() * sets.len() as f64);
        if points.n_points() <= MOST_DIRECT {
            direct::add_power(&waves, share, &mut power);
        } else {
            gridding::add_power(&waves, share, &mut power);
        }
    }
    let Rings { frequencies, power: ring_power, anisotropy_db } =
        rings::of(&power, by_short_side(half, half), by_short_side(half, step), max_frequency);
    Ok(PowerSpectrum { n_sets: sets.len(), max_frequency, ring_frequencies: frequencies, ring_power, anisotropy_db, step, half, power })
}

#[cfg(test)]
mod tests;
