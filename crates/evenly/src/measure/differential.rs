//! Statistics of distances where the density varies: differential domain analysis.
//!
//! A Fourier spectrum mixes places of different spacing and shows nothing. Distances do not mix when each is taken in the spacing of its place: Wei and Wang,
//! "Differential Domain Analysis for Non-uniform Sampling", ACM Transactions on Graphics 30(4), 2011, doi 10.1145/2010324.1964945. What differs: lengths alone are
//! scaled, the same in all directions, and the spectrum is that of the scaled pair correlation, so that uniform and other sets can be compared.

use std::f64::consts::PI;

use glam::DVec2;
use rayon::prelude::*;

use super::correlation::{correlate, level};
use super::radial::{REACH, RadialSpectrum, n_bins};
use super::rows::Rows;
use super::sets::require_alike;
use crate::error::Error;
use crate::points::PointSet;

/// What [`radial_spectrum`](crate::radial_spectrum) finds, of a set whose density varies. The distances from each point are taken in its own spacing, in input units; points
/// count that have room for eight of theirs, or as many as half of the points have room for.
///
/// The spacing is 1 / sqrt(density); [`local_spacings`] has it, or guesses it where the density is not known.
///
/// # Errors
/// [`Error::Degenerate`] as for [`radial_spectrum`](crate::radial_spectrum); [`Error::InvalidParameter`] if there is not one spacing a point, positive and finite.
///
/// # Example
/// ```
/// use evenly::{Rectangle, differential_spectrum, local_spacings, white};
///
/// let noise = white(Rectangle::new([0.0, 0.0], [1.0, 1.0])?, 5000, 7)?;
/// let spectrum = differential_spectrum(&noise, &local_spacings(&noise)?)?;
/// assert!(spectrum.effective_nyquist < 0.2);
/// # Ok::<(), evenly::Error>(())
/// ```
pub fn differential_spectrum(points: &PointSet, spacings: &[f64]) -> Result<RadialSpectrum, Error> {
    require_alike(std::slice::from_ref(points))?;
    let wrong = |value: String| Error::InvalidParameter { name: "spacings", value, expected: "one positive, finite length a point" };
    if spacings.len() != points.n_points() {
        return Err(wrong(format!("{} lengths", spacings.len())));
    }
    if let Some(spacing) = spacings.iter().find(|&&spacing| !(spacing > 0.0 && spacing.is_finite())) {
        return Err(wrong(spacing.to_string()));
    }
    let (domain, positions) = points.normalized();
    let scale = 1.0 / domain.restore_length(1.0);
    let mut rooms: Vec<f64> = positions.iter().zip(spacings).map(|(&p, spacing)| domain.room(p) / (spacing * scale)).collect();
    let middle = rooms.len() / 2;
    let (_, &mut median, _) = rooms.select_nth_unstable_by(middle, f64::total_cmp);
    let n_bins = n_bins(REACH[0].min(median))?;
    let mut correlation = correlate(points, n_bins, &|index| spacings[index] * scale)?;
    level(&mut correlation)?;
    Ok(RadialSpectrum::of(1, correlation))
}

/// Each point's own spacing, 1 / sqrt(density), in input units: as the density that the set keeps has it, at most thirty times the mean; or else a guess from the disks with 32 to 64 neighbours, or, of few points, up to half of them. It is good to some
/// hundredths where the density is even over so many, and too large at a rectangle's boundary.
///
/// # Errors
/// [`Error::Degenerate`] for fewer than three points, a torus too narrow for them, or so many in one place that they have no distance.
pub fn local_spacings(points: &PointSet) -> Result<Vec<f64>, Error> {
    const NEIGHBOURS: usize = 64;
    /// Of the mean density: less makes no spacing.
    const LEAST: f64 = 1e-3;
    let (domain, positions) = points.normalized();
    if let Some(field) = points.field(&domain) {
        let mean = points.hex_spacing() * 0.75f64.sqrt().sqrt();
        return Ok(positions.iter().map(|&place| mean / field.at(place).max(LEAST).sqrt()).collect());
    }
    if positions.len() < 3 {
        return Err(Error::Degenerate("a spacing takes three points or more".into()));
    }
    // A torus shows no farther than half its shorter side: half the points of that disk are there even where they are sparse.
    let seen = if domain.is_periodic { 0.25 * PI * domain.size.min_element().powi(2) / domain.area() } else { 1.0 };
    let rank = NEIGHBOURS.min((0.5 * seen * positions.len() as f64) as usize);
    let rows = Rows::new(&domain, &positions, 4.0);
    // Of one neighbour alone the pair correlation would show a spike where that neighbour is.
    let ranks = (rank / 2).max(1)..=rank;
    let spacing = |&place: &DVec2| match rows.distances_to_nearest(place, rank) {
        Some(distances) if distances.last().is_some_and(|&farthest| farthest > 0.0) => {
            let area: f64 = ranks.clone().map(|k| PI * distances[k - 1].powi(2) / k as f64).sum();
            Ok(domain.restore_length((area / ranks.clone().count() as f64).sqrt()))
        }
        Some(_) => Err(Error::Degenerate(format!("more than {rank} points share a place: there is no local spacing"))),
        None => Err(Error::Degenerate("too few points around some, or too narrow a domain, for a local spacing".into())),
    };
    positions.par_iter().map(spacing).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::points::Random;
    use crate::{Rectangle, Torus, poisson_disk_of, radial_spectrum, white};

    /// The spacing wanted at a place: three times as large at one side as at the other.
    fn wanted(p: [f64; 2]) -> f64 {
        0.008 * (1.0 + 2.0 * p[0])
    }

    /// Darts, none nearer to another than three quarters of its spacing, equally many thrown at each squared spacing.
    fn darts(wanted: impl Fn([f64; 2]) -> f64, place: impl Fn(f64) -> f64) -> PointSet {
        let mut random = Random::new(1, 9);
        let mut kept: Vec<[f64; 2]> = Vec::new();
        for _ in 0..60_000 {
            let dart = [place(random.unit()), random.unit()];
            let reach = 0.75 * wanted(dart);
            if kept.iter().all(|p| libm::hypot(p[0] - dart[0], p[1] - dart[1]) >= reach.min(0.75 * wanted(*p))) {
                kept.push(dart);
            }
        }
        PointSet::new(Rectangle::new([0.0, 0.0], [1.0, 1.0]).unwrap(), kept).unwrap()
    }

    #[test]
    fn darts_of_varying_size_look_like_darts_of_one_size() {
        let uniform = radial_spectrum(&[darts(|_| 0.016, |u| u)]).unwrap();
        let varying = darts(wanted, |u| u / (3.0 - 2.0 * u));
        let known: Vec<f64> = varying.positions().iter().map(|&p| wanted(p)).collect();
        // The darts' true spacing is a constant part of the one wanted: in all, there is a point in each squared spacing.
        let integral = 1.0 / (0.008f64.powi(2) * 3.0);
        let ratio = (integral / varying.n_points() as f64).sqrt();
        let known: Vec<f64> = known.iter().map(|spacing| ratio * spacing).collect();
        let guessed = local_spacings(&varying).unwrap();
        let power = |s: &RadialSpectrum, f: f64| s.radial_power[(200.0 * f) as usize];
        let blind = radial_spectrum(std::slice::from_ref(&varying)).unwrap();
        // Looked at as one, the spacings blur each other.
        assert!(power(&blind, 1.2) < power(&uniform, 1.2) - 0.25);
        for spacings in [known, guessed] {
            let seen = differential_spectrum(&varying, &spacings).unwrap();
            for f in [0.3, 0.6, 1.2, 1.5, 2.0, 2.3] {
                assert!((power(&seen, f) - power(&uniform, f)).abs() < 0.15, "{f}: {} {}", power(&seen, f), power(&uniform, f));
            }
        }
    }

    #[test]
    fn of_a_uniform_set_it_is_the_plain_analysis() {
        let noise = white(Torus::new([0.0, 0.0], [2.0, 2.0]).unwrap(), 4000, 3).unwrap();
        let spacing = (4.0f64 / 4000.0).sqrt();
        let (plain, seen) =
            (radial_spectrum(std::slice::from_ref(&noise)).unwrap(), differential_spectrum(&noise, &vec![spacing; 4000]).unwrap());
        let error = plain.pair_correlation.iter().zip(&seen.pair_correlation).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(error < 0.1, "{error}");
        let mean = local_spacings(&noise).unwrap().iter().sum::<f64>() / 4000.0;
        assert!((mean / spacing - 1.0).abs() < 0.02);
        // The neighbours by whom a spacing is guessed leave no spike.
        let guessed = differential_spectrum(&noise, &local_spacings(&noise).unwrap()).unwrap();
        let tenths: Vec<f64> =
            guessed.pair_correlation[200..].chunks(20).map(|bins| bins.iter().sum::<f64>() / bins.len() as f64).collect();
        assert!(tenths.iter().all(|g| (g - 1.0).abs() < 0.15), "{tenths:?}");
    }

    #[test]
    fn wrong_spacings_are_errors() {
        let noise = white(Torus::new([0.0, 0.0], [1.0, 1.0]).unwrap(), 1000, 3).unwrap();
        for spacings in [vec![], vec![0.1; 999], vec![0.0; 1000], vec![f64::NAN; 1000], vec![1.0; 1000], vec![1e-6; 1000]] {
            assert!(differential_spectrum(&noise, &spacings).is_err());
        }
        let heap = PointSet::new(noise.space(), vec![[0.5, 0.5]; 1000]).unwrap();
        assert!(local_spacings(&heap).is_err() && local_spacings(&white(noise.space(), 2, 0).unwrap()).is_err());
        // In a strip of four spacings the disk around a point holds a dozen others: fewer neighbours, and the same spacing.
        let strip = poisson_disk_of(Torus::new([0.0, 0.0], [100.0, 1.0]).unwrap(), 2000, 1).unwrap();
        let mean = local_spacings(&strip).unwrap().iter().sum::<f64>() / 2000.0;
        assert!((mean / 0.05f64.sqrt() - 1.0).abs() < 0.1, "{mean}");
        assert!(local_spacings(&white(Torus::new([0.0, 0.0], [1e4, 1.0]).unwrap(), 1000, 1).unwrap()).is_err());
    }
}
