//! Laws of power spectra.

use super::waves::Waves;
use super::*;
use crate::{Rectangle, Torus, hexagonal, jittered, poisson_disk_of, white};

fn torus() -> Torus {
    Torus::new([0.0, 0.0], [1.0, 1.0]).unwrap()
}

fn all(waves: &Waves, add_power: fn(&Waves, f64, &mut [f64])) -> Vec<f64> {
    let mut power = vec![0.0; (waves.half[0] + 1) * (2 * waves.half[1] + 1)];
    add_power(waves, 1.0 / waves.white_power(), &mut power);
    power
}

/// The definition.
fn summed(waves: &Waves) -> Vec<f64> {
    let mut power = Vec::new();
    for a in 0..=waves.half[0] {
        for b in -(waves.half[1] as i64)..=waves.half[1] as i64 {
            let (mut real, mut imaginary) = (-waves.of_density(a, b), 0.0);
            for ((x, y), weight) in waves.x.iter().zip(&waves.y).zip(&waves.weight) {
                let phase = std::f64::consts::TAU * (a as f64 * x + b as f64 * y).fract();
                real += weight * phase.cos();
                imaginary += weight * phase.sin();
            }
            power.push((real * real + imaginary * imaginary) / waves.white_power());
        }
    }
    power
}

#[test]
fn both_ways_agree_with_the_definition() {
    let cases = [
        (white(torus(), 500, 1).unwrap(), [40, 40]),
        (white(Rectangle::new([1.0, 2.0], [3.0, 2.0]).unwrap(), 300, 2).unwrap(), [90, 30]),
        (white(Torus::new([0.0, 0.0], [100.0, 1.0]).unwrap(), 400, 3).unwrap(), [200, 2]),
        (white(Torus::new([0.0, 0.0], [1.0, 3000.0]).unwrap(), 100, 3).unwrap(), [0, 2500]),
        (PointSet::new(torus(), vec![[0.0, 0.0], [0.5, 0.999], [0.99999, 0.0]]).unwrap(), [7, 5]),
    ];
    for (points, half) in cases {
        let waves = Waves::new(&points, half);
        let truth = summed(&waves);
        for (way, most) in [(all(&waves, direct::add_power), 1e-9), (all(&waves, gridding::add_power), 1e-6)] {
            let error = way.iter().zip(&truth).map(|(a, b)| (a - b).abs() / b.abs().max(1.0)).fold(0.0, f64::max);
            assert!(error < most, "{half:?}: {error:e}");
        }
    }
}

#[test]
fn gridding_is_exact_to_a_millionth() {
    for points in [white(torus(), 20_000, 4).unwrap(), poisson_disk_of(torus(), 20_000, 4).unwrap(), jittered(torus(), 20_000, 4).unwrap()]
    {
        let waves = Waves::new(&points, [300, 280]);
        let (exact, fast) = (all(&waves, direct::add_power), all(&waves, gridding::add_power));
        let error = exact.iter().zip(&fast).map(|(a, b)| (a - b).abs() / a.max(1.0)).fold(0.0, f64::max);
        assert!(error < 1e-6, "{error:e}");
    }
}

#[test]
fn white_noise_has_power_1_in_every_direction() {
    for points in [white(torus(), 30_000, 5).unwrap(), white(Rectangle::new([0.0, 0.0], [2.0, 1.0]).unwrap(), 30_000, 5).unwrap()] {
        let s = power_spectrum(&[points], 2.0).unwrap();
        let n = s.ring_power.len() as f64;
        assert!((s.ring_power.iter().sum::<f64>() / n - 1.0).abs() < 0.02);
        assert!((s.anisotropy_db[20..].iter().sum::<f64>() / (n - 20.0)).abs() < 0.5);
    }
}

#[test]
fn anisotropy_falls_with_the_number_of_sets() {
    let sets: Vec<PointSet> = (0..10).map(|seed| white(torus(), 1000, seed).unwrap()).collect();
    let s = power_spectrum(&sets, 4.0).unwrap();
    let mean = s.anisotropy_db[10..].iter().sum::<f64>() / (s.anisotropy_db.len() - 10) as f64;
    assert!(s.n_sets == 10 && (mean + 10.0).abs() < 0.7, "{mean}");
}

#[test]
fn a_lattice_has_its_peaks_and_nothing_else() {
    // 40 columns and 46 rows of two points.
    let points = hexagonal(Torus::new([0.0, 0.0], [40.0, 40.0 * 3f64.sqrt() / 2.0]).unwrap(), 40 * 40).unwrap();
    let s = power_spectrum(&[points], 1.5).unwrap();
    let [a_max, b_max] = s.half_size().map(|half| half as i64);
    for a in -a_max..=a_max {
        for b in -b_max..=b_max {
            // One row is shifted by half a column against the next.
            let is_peak = a % 40 == 0 && b % 20 == 0 && (a / 40 + b / 20) % 2 == 0;
            let power = s.power(a, b).unwrap();
            assert!((power - if is_peak { 1600.0 } else { 0.0 }).abs() < 1e-6, "{a} {b} {power}");
        }
    }
}

#[test]
fn power_over_a_period_of_frequencies_counts_the_points_of_each_place() {
    // Parseval: on a grid of m x m places, the mean power over m x m frequencies is the sum of the squared numbers of points a place, by n.
    const SIDE: i64 = 24;
    let noise = white(torus(), 300, 6).unwrap();
    let snap = |x: f64| (x * SIDE as f64).floor() / SIDE as f64;
    let positions: Vec<[f64; 2]> = noise.positions().iter().map(|p| p.map(snap)).collect();
    let mut counts = std::collections::HashMap::new();
    positions.iter().for_each(|p| *counts.entry(p.map(f64::to_bits)).or_insert(0.0) += 1.0);
    let expected = counts.values().map(|n: &f64| n * n).sum::<f64>() / 300.0;
    let s = power_spectrum(&[PointSet::new(torus(), positions).unwrap()], 1.0).unwrap();
    let half = SIDE / 2;
    let period = || (-half..half).flat_map(|a| (-half..half).map(move |b| (a, b)));
    let mean = period().filter_map(|(a, b)| s.power(a, b)).sum::<f64>() / (SIDE * SIDE) as f64;
    assert!(s.half_size()[0] as i64 >= half && (mean - expected).abs() < 1e-9, "{mean} {expected}");
}

#[test]
fn a_shift_changes_nothing_and_neither_do_threads_or_scale() {
    let points = poisson_disk_of(torus(), 25_000, 7).unwrap();
    let run = |points: &PointSet, n_threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().unwrap();
        pool.install(|| power_spectrum(std::slice::from_ref(points), 2.0)).unwrap()
    };
    let once = run(&points, 1);
    assert_eq!(once, run(&points, 3));
    let far = Torus::new([1e6, -7.0], [1e-3, 1e-3]).unwrap();
    let moved = points.positions().iter().map(|p| [1e6 + (p[0] + 0.3).fract() * 1e-3, -7.0 + (p[1] + 0.9).fract() * 1e-3]).collect();
    let moved = run(&PointSet::new(far, moved).unwrap(), 2);
    // So far from 0, places are rounded to a ten-millionth of the domain.
    let error = once.ring_power.iter().zip(&moved.ring_power).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(error < 1e-3, "{error:e}");
}

#[test]
fn few_points_are_fine_and_what_has_no_mean_is_an_error() {
    let one = PointSet::new(torus(), vec![[0.3, 0.4]]).unwrap();
    let s = power_spectrum(std::slice::from_ref(&one), 4.0).unwrap();
    assert!(s.ring_power.iter().all(|p| (p - 1.0).abs() < 1e-12));
    // The same set lying and standing.
    let long = white(Torus::new([0.0, 0.0], [1000.0, 1.0]).unwrap(), 1000, 0).unwrap();
    let turned = long.positions().iter().map(|p| [p[1], p[0]]).collect();
    let turned = PointSet::new(Torus::new([0.0, 0.0], [1.0, 1000.0]).unwrap(), turned).unwrap();
    let [lying, standing] = [long, turned].map(|points| power_spectrum(&[points], 20.0).unwrap());
    for (a, b) in [(0, 0), (3, 0), (600, -1), (-7, 1)] {
        let (p, q) = (lying.power(a, b).unwrap(), standing.power(b, a).unwrap());
        assert!((p - q).abs() < 1e-9 * p.max(1.0), "{a} {b}: {p} {q}");
    }
    assert!(lying.half_size() == [20_000, 20] && lying.power(0, 21).is_none() && standing.power(20, 20_000).is_some());
    let empty = PointSet::new(torus(), vec![]).unwrap();
    let other = white(Torus::new([0.0, 0.0], [2.0, 1.0]).unwrap(), 1, 0).unwrap();
    let more = white(torus(), 2, 0).unwrap();
    for sets in [vec![], vec![empty.clone()], vec![one.clone(), empty], vec![one.clone(), other], vec![one.clone(), more]] {
        assert!(power_spectrum(&sets, 4.0).is_err());
    }
    for frequency in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(power_spectrum(std::slice::from_ref(&one), frequency).is_err());
    }
}
