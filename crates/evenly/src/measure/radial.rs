//! Spatial and spectral statistics that depend on distance alone: the pair correlation, and the radial mean of the power spectrum.
//!
//! The definitions are those of Heck, Schloemer and Deussen, "Blue Noise Sampling with Controlled Aliasing", ACM Transactions on Graphics 32(3), 2013, doi
//! 10.1145/2487228.2487233, and of their tool psa: the radial power is the Hankel transform of the pair correlation,
//! P(f) = |1 + 2 pi int (g(r) - 1) r J0(2 pi f r) w(r) dr| with a Blackman-like window w. White noise has g = 1 and P = 1. Where sets have a spike in g, as
//! maximal Poisson-disk sets do at their radius, how the integrals are summed shows in the second digit of what is derived. They are summed here so that psa's
//! own figures come out: bins of 1 / 200, each taken where it begins; powers in the disk taken at the ends of their steps.
//!
//! Lengths are in mean spacings, sqrt(A / n), frequencies in their inverse. Cost: some 1000 distances a point where they are even; as many as there are points within reach where they are heaped.

use rayon::prelude::*;
use serde::Serialize;

use super::bessel::Bessel;
use super::correlation::{BINS, correlate, level};
use super::sets::{mean_spacing, require_alike};
use crate::error::Error;
use crate::points::PointSet;

/// What [`radial_spectrum`] finds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RadialSpectrum {
    /// How many sets it is the mean of.
    pub n_sets: usize,
    /// The effective Nyquist frequency: up to there less than a tenth of white noise's power passes, on average over the disk of frequencies. More aliases
    /// less.
    pub effective_nyquist: f64,
    /// The oscillation: 10 times the root mean square distance of the power from 1, over a ring of frequencies 5 wide, from where the power first comes near
    /// 1. Less makes aliasing look more like noise.
    pub oscillation: f64,
    /// Frequencies at which the power is given.
    pub frequencies: Vec<f64>,
    /// The radial mean of the power spectrum; 1 for white noise.
    pub radial_power: Vec<f64>,
    /// Distances at which the pair correlation is given: where each bin begins.
    pub distances: Vec<f64>,
    /// How many points there are at a distance from a point, relative to what white noise has.
    pub pair_correlation: Vec<f64>,
}

/// The largest distance that is looked at, in mean spacings: for few points, and from [`MANY`] on. A larger one shows finer features, and both figures
/// that are derived grow with it: they can be compared at equal numbers of points alone.
pub(super) const REACH: [f64; 2] = [8.0, 16.0];
const MANY: usize = 4096;
/// The largest frequency, and the steps to 1.
const MAX_FREQUENCY: f64 = 10.0;
const STEPS: usize = 200;

/// The radial mean of the power spectrum, the pair correlation, and what Heck et al. derive from them; the mean over sets.
///
/// In a rectangle only points count that are so far from the boundary that it hides no pair.
///
/// # Errors
/// [`Error::Degenerate`] for no sets, an empty one, sets of different domains or of numbers of points more than a tenth apart, and for so few points, or so
/// narrow a domain, that no distance of two spacings can be looked at.
///
/// # Example
/// ```
/// use evenly::{Torus, radial_spectrum, white};
///
/// let noise = white(Torus::new([0.0, 0.0], [1.0, 1.0])?, 5000, 7)?;
/// let spectrum = radial_spectrum(&[noise])?;
/// assert!(spectrum.effective_nyquist < 0.1);
/// # Ok::<(), evenly::Error>(())
/// ```
pub fn radial_spectrum(sets: &[PointSet]) -> Result<RadialSpectrum, Error> {
    require_alike(sets)?;
    let n_bins = n_bins(sets.iter().map(reach).fold(f64::INFINITY, f64::min))?;
    let mut correlation = vec![0.0; n_bins];
    for points in sets {
        let spacing = (points.space().domain().area() / points.n_points() as f64).sqrt();
        for (mean, g) in correlation.iter_mut().zip(correlate(points, n_bins, &|_| spacing)?) {
            *mean += g / sets.len() as f64;
        }
    }
    // A rectangle's inside is a little less dense than all of it, where points stand on its boundary.
    if !sets[0].space().is_periodic() {
        level(&mut correlation)?;
    }
    Ok(RadialSpectrum::of(sets.len(), correlation))
}

impl RadialSpectrum {
    pub(crate) fn of(n_sets: usize, pair_correlation: Vec<f64>) -> Self {
        let distances: Vec<f64> = (0..pair_correlation.len()).map(|bin| bin as f64 / BINS as f64).collect();
        let frequencies: Vec<f64> = (1..=(MAX_FREQUENCY * STEPS as f64) as usize).map(|step| step as f64 / STEPS as f64).collect();
        let radial_power = transform(&frequencies, &distances, &pair_correlation);
        let effective_nyquist = effective_nyquist(&frequencies, &radial_power);
        let oscillation = oscillation(&frequencies, &radial_power);
        Self { n_sets, effective_nyquist, oscillation, frequencies, radial_power, distances, pair_correlation }
    }
}

/// How far a set lets one look, in mean spacings: on a torus half its shorter side, in a rectangle a quarter of it.
fn reach(points: &PointSet) -> f64 {
    let [width, height] = points.space().size();
    let share = if points.space().is_periodic() { 0.5 } else { 0.25 };
    REACH[usize::from(points.n_points() >= MANY)].min(share * width.min(height) / mean_spacing(points))
}

/// So many bins reach that far, in mean spacings.
pub(super) fn n_bins(reach: f64) -> Result<usize, Error> {
    if reach < 2.0 {
        let few = "too few points, or too narrow a domain, for a spectrum: it takes 16 points on a square torus, 64 in a square";
        return Err(Error::Degenerate(few.into()));
    }
    Ok((reach * BINS as f64) as usize)
}

/// The Hankel transform of a pair correlation, at each frequency.
fn transform(frequencies: &[f64], distances: &[f64], correlation: &[f64]) -> Vec<f64> {
    use std::f64::consts::{PI, TAU};
    let reach = correlation.len() as f64 / BINS as f64;
    let window = |r: f64| 0.43 + 0.5 * libm::cos(PI * r / reach) + 0.08 * libm::cos(TAU * r / reach);
    let excess: Vec<f64> = distances.iter().zip(correlation).map(|(&r, &g)| (g - 1.0) * r * window(r)).collect();
    let bessel = Bessel::up_to(TAU * MAX_FREQUENCY * reach);
    let power = |&f: &f64| {
        let sum: f64 = distances.iter().zip(&excess).map(|(&r, excess)| excess * bessel.j0(TAU * f * r)).sum();
        (1.0 + TAU / BINS as f64 * sum).abs()
    };
    frequencies.par_iter().map(power).collect()
}

/// The largest frequency, before the mean power in the disk first rises through a half, at which that mean is below a tenth.
fn effective_nyquist(frequencies: &[f64], power: &[f64]) -> f64 {
    let (mut sum, mut nyquist, mut before) = (0.0, 0.0, f64::INFINITY);
    for (&f, &p) in frequencies.iter().zip(power) {
        // The mean of the power over a disk of radius f, 2 / f^2 int P u du.
        sum += p * f / STEPS as f64;
        let mean = 2.0 * sum / (f * f);
        if before <= 0.5 && mean > 0.5 {
            break;
        }
        if mean < 0.1 {
            nyquist = f;
        }
        before = mean;
    }
    nyquist
}

/// Ten times the root mean square distance of the power from 1, over the ring of frequencies from where it first comes near 1 to five more.
fn oscillation(frequencies: &[f64], power: &[f64]) -> f64 {
    const WIDTH: f64 = 5.0;
    const NEAR_ONE: f64 = 0.98;
    let Some(first) = power.iter().position(|&p| p >= NEAR_ONE) else { return 0.0 };
    let low = frequencies[first];
    let (mut sum, mut area) = (0.0, 0.0);
    for (&f, &p) in frequencies.iter().zip(power).skip(first).take_while(|(f, _)| **f <= low + WIDTH) {
        sum += (p - 1.0).powi(2) * f;
        area += f;
    }
    10.0 * (sum / area).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Rectangle, Torus, hexagonal, poisson_disk_of, white};

    fn spectrum(points: PointSet) -> RadialSpectrum {
        radial_spectrum(&[points]).unwrap()
    }

    fn torus() -> Torus {
        Torus::new([0.0, 0.0], [1.0, 1.0]).unwrap()
    }

    #[test]
    fn white_noise_has_power_and_correlation_one() {
        for points in [white(torus(), 20_000, 1).unwrap(), white(Rectangle::new([5.0, 0.0], [30.0, 20.0]).unwrap(), 20_000, 1).unwrap()] {
            let s = spectrum(points);
            let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
            assert!((mean(&s.pair_correlation) - 1.0).abs() < 0.02 && (mean(&s.radial_power[20..]) - 1.0).abs() < 0.02);
            assert!(s.oscillation < 0.3 && s.effective_nyquist < 0.05, "{}", s.oscillation);
        }
    }

    #[test]
    fn what_keeps_its_distance_has_no_pairs_below_it_and_little_power() {
        let points = poisson_disk_of(torus(), 5000, 2).unwrap();
        let s = spectrum(points);
        let below = s.distances.iter().zip(&s.pair_correlation).filter(|(r, _)| **r < 0.8);
        assert!({ below }.all(|(_, &g)| g == 0.0));
        assert!(
            (0.65..0.75).contains(&s.effective_nyquist) && (1.0..2.0).contains(&s.oscillation),
            "{} {}",
            s.effective_nyquist,
            s.oscillation
        );
    }

    #[test]
    fn a_lattice_has_its_first_peak_where_its_rows_are() {
        let size = [1.0, 3f64.sqrt() / 2.0];
        let s = spectrum(hexagonal(Torus::new([0.0, 0.0], size).unwrap(), 60 * 60).unwrap());
        let peak = s.frequencies.iter().zip(&s.radial_power).take(300).max_by(|a, b| a.1.total_cmp(b.1)).unwrap();
        // The reciprocal lattice of one with a point a unit area: sqrt(2 / sqrt(3)).
        assert!((peak.0 - 1.0746).abs() < 0.02 && *peak.1 > 5.0, "{peak:?}");
    }

    #[test]
    fn a_spectrum_takes_points_enough_and_does_not_depend_on_threads() {
        assert!(radial_spectrum(&[]).is_err() && radial_spectrum(&[white(torus(), 10, 0).unwrap()]).is_err());
        let narrow = Torus::new([0.0, 0.0], [1000.0, 1.0]).unwrap();
        assert!(radial_spectrum(&[white(narrow, 1000, 0).unwrap()]).is_err());
        let points = white(torus(), 5000, 3).unwrap();
        let run = |n_threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().unwrap();
            pool.install(|| spectrum(points.clone()))
        };
        assert_eq!(run(1), run(3));
    }
}
