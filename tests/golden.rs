//! Numbers: what the paper prints, and what evenly promises to reach. Speed is for the benches.

#![allow(clippy::unwrap_used)]

use evenly::{Measures, Mode, ProcrustesParams, Rectangle, Report, RunContext, Space, Torus, jittered, measure, procrustes, warp, white};

const SEEDS: std::ops::Range<u64> = 0..5;

fn torus() -> Space {
    Torus::new([0.0, 0.0], [1.0, 1.0]).unwrap().into()
}

fn rectangle(width: f64) -> Space {
    Rectangle::new([0.0, 0.0], [width, 1.0]).unwrap().into()
}

/// Optimises white noise, warped or not.
fn run(space: Space, n: usize, seed: u64, mode: Mode, is_warped: bool) -> (Measures, Report) {
    let mut points = white(space, n, seed).unwrap();
    if is_warped {
        warp(&mut points);
    }
    let params = ProcrustesParams { mode, ..ProcrustesParams::default() };
    let report = procrustes(&mut points, &params, &mut RunContext::default()).unwrap();
    (measure(&points).unwrap(), report)
}

/// The paper's own input. Its Table 1 (11.7 degrees, quality .94) is out of reach from white noise: 12.2 to 12.5 from 10,000 points on,
/// whatever the reading of the paper; sets of a few hundred points scatter around 11.7.
#[test]
fn plain_steps_from_white_noise() {
    for (n, seeds) in [(10_000, SEEDS), (100_000, 0..1)] {
        for seed in seeds {
            let (m, report) = run(torus(), n, seed, Mode::Paper, false);
            assert!(m.angle_rms_deg <= 12.5 && m.triangle_quality >= 0.93, "{n}, {seed}: {m:?}");
            assert_eq!((report.inverted_triangles, report.energy_rises), (0, 0), "{n}, {seed}");
            assert!((90..=160).contains(&report.iterations), "{n}, {seed}: {}", report.iterations);
        }
    }
}

/// Better than the paper's Table 1, by a start without long density waves.
#[test]
fn plain_steps_from_warped_white_noise() {
    for (n, seeds) in [(10_000, SEEDS), (100_000, 0..1)] {
        for seed in seeds {
            let (m, report) = run(torus(), n, seed, Mode::Paper, true);
            assert!(m.angle_rms_deg <= 11.3 && m.triangle_quality >= 0.945, "{n}, {seed}: {m:?}");
            assert_eq!((report.inverted_triangles, report.energy_rises), (0, 0), "{n}, {seed}");
        }
    }
}

#[test]
fn plain_steps_from_a_jittered_grid() {
    let mut points = jittered(torus(), 10_000, 1).unwrap();
    let params = ProcrustesParams { mode: Mode::Paper, ..ProcrustesParams::default() };
    procrustes(&mut points, &params, &mut RunContext::default()).unwrap();
    let m = measure(&points).unwrap();
    assert!((m.angle_rms_deg - 11.06).abs() < 0.15 && (m.triangle_quality - 0.947).abs() < 0.002, "{m:?}");
}

#[test]
fn momentum_from_warped_white_noise() {
    for (n, seeds) in [(10_000, SEEDS), (100_000, 0..2)] {
        for seed in seeds {
            let (m, report) = run(torus(), n, seed, Mode::Fast, true);
            assert!(m.angle_rms_deg <= 10.4 && m.triangle_quality >= 0.952, "{n}, {seed}: {m:?}");
            assert!(m.bond_order <= 0.60, "{n}, {seed}: {}", m.bond_order);
            assert!(m.bond_order_global <= 0.05, "{n}, {seed}: {}", m.bond_order_global);
            assert_eq!(report.inverted_triangles, 0, "{n}, {seed}");
            assert!(report.iterations <= 45, "{n}, {seed}: {}", report.iterations);
        }
    }
}

#[test]
fn rectangles_are_covered_to_the_border() {
    for (width, is_warped) in [(1.0, true), (4.0, true), (1.0, false), (4.0, false)] {
        for seed in SEEDS {
            let (m, report) = run(rectangle(width), 10_000, seed, Mode::Fast, is_warped);
            let border = m.border.as_ref().unwrap();
            let case = format!("{width}, {is_warped}, {seed}: {border:?}");
            assert!(border.border_angle_rms_deg <= 13.0 && border.interior_angle_rms_deg <= 12.0, "{case}");
            assert!(border.uncovered_fraction <= 1e-3, "{case}");
            assert_eq!((report.inverted_triangles, border.isolated_points), (0, 0), "{case}");
        }
    }
}
