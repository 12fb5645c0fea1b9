//! Numbers: what the paper prints, and what evenly promises to reach. Speed is for the benches.

use evenly::{
    Measures, Mode, Outcome, ProcrustesParams, PushPullParams, PushPullPreset, Rectangle, Report, RunContext, Schedule, Space, Targets,
    Torus, WellSpacedParams, jittered, measure, procrustes, push_pull, warp, warp_isotropic, well_spaced, white,
};

const SEEDS: std::ops::Range<u64> = 0..5;

fn torus() -> Space {
    Torus::new([0.0, 0.0], [1.0, 1.0]).unwrap().into()
}

fn rectangle(width: f64) -> Space {
    Rectangle::new([0.0, 0.0], [width, 1.0]).unwrap().into()
}

/// Optimises white noise, warped or not.
fn run(space: Space, n: usize, seed: u64, mode: Mode, is_warped: bool) -> (Measures, Report) {
    let mut points = white(&space, n, seed).unwrap();
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
fn rectangles_are_covered_to_the_boundary() {
    for (width, is_warped) in [(1.0, true), (4.0, true), (1.0, false), (4.0, false)] {
        for seed in SEEDS {
            let (m, report) = run(rectangle(width), 10_000, seed, Mode::Fast, is_warped);
            let boundary = m.boundary.as_ref().unwrap();
            let case = format!("{width}, {is_warped}, {seed}: {boundary:?}");
            assert!(boundary.boundary_angle_rms_deg <= 13.0 && boundary.interior_angle_rms_deg <= 12.0, "{case}");
            assert!(boundary.uncovered_fraction <= 1e-3, "{case}");
            assert_eq!((report.inverted_triangles, boundary.isolated_points), (0, 0), "{case}");
        }
    }
}

/// Push-pull on white noise, warped or not, in any case converged: the measures are those of a fresh triangulation.
fn pushed(space: Space, n: usize, seed: u64, params: &PushPullParams, is_warped: bool) -> (Measures, Report) {
    let mut points = white(&space, n, seed).unwrap();
    if is_warped {
        warp_isotropic(&mut points);
    }
    let report = push_pull(&mut points, params, &mut RunContext::default()).unwrap();
    let measures = measure(&points).unwrap();
    assert_eq!(report.outcome, Outcome::Converged, "{space}, {n}, {seed}: {params:?}");
    assert_eq!(params.unmet(&measures), [], "{space}, {n}, {seed}: {params:?}");
    (measures, report)
}

/// Rows 1 and 2 of the paper's Table 1, whose sets have about a thousand points: davg .847 and .905, BOO (the tool psa's) .487 and .499.
#[test]
fn the_first_rows_of_the_papers_table() {
    for (preset, mean_distance, bond_order) in [(PushPullPreset::Paper1, 0.847, 0.487), (PushPullPreset::Paper2, 0.905, 0.499)] {
        let runs: Vec<Measures> = (0..8).map(|seed| pushed(torus(), 1024, seed, &PushPullParams::preset(preset), false).0).collect();
        let mean = |value: fn(&Measures) -> f64| runs.iter().map(value).sum::<f64>() / runs.len() as f64;
        assert!((mean(|m| m.mean_distance) - mean_distance).abs() < 0.005, "{preset:?}: {}", mean(|m| m.mean_distance));
        assert!((mean(|m| m.bond_order_psa) - bond_order).abs() < 0.03, "{preset:?}: {}", mean(|m| m.bond_order_psa));
    }
}

/// Row 3, which does not converge in the authors' own program: davg .922. It does with a tolerance of 0.1 and a relaxation of 1.2.
#[test]
fn the_third_row_of_the_papers_table() {
    for seed in 0..8 {
        let (m, _) = pushed(torus(), 1024, seed, &PushPullParams::preset(PushPullPreset::Paper3), false);
        assert!(m.beta <= 0.675 && m.obtuse_fraction == 0.0, "{seed}: {m:?}");
        assert!((m.mean_distance - 0.922).abs() < 0.005, "{seed}: {}", m.mean_distance);
    }
}

/// sin(theta) >= r_f / (2 r_c): {0.90, 0.63} keeps all angles within 45.5 and 89 degrees.
#[test]
fn no_triangle_is_obtuse() {
    let params = PushPullParams { min_distance: Some(0.90), coverage_radius: Some(0.63), ..PushPullParams::default() };
    for (n, seeds) in [(1000, 8), (10_000, 3)] {
        for seed in 0..seeds {
            let (m, _) = pushed(torus(), n, seed, &params, true);
            assert!(m.min_angle_deg >= 45.5 && m.max_angle_deg <= 89.0, "{n}, {seed}: {m:?}");
            assert_eq!(m.obtuse_fraction, 0.0);
        }
    }
}

#[test]
fn every_preset_converges_from_warped_noise() {
    for preset in [PushPullPreset::Fast, PushPullPreset::Balanced, PushPullPreset::Tough, PushPullPreset::Paper1, PushPullPreset::Paper3] {
        pushed(torus(), 1000, 9, &PushPullParams::preset(preset), true);
        pushed(torus(), 10_000, 9, &PushPullParams::preset(preset), true);
    }
    for preset in [PushPullPreset::Fast, PushPullPreset::Balanced, PushPullPreset::Tough] {
        for width in [1.0, 4.0] {
            pushed(rectangle(width), 3000, 9, &PushPullParams::preset(preset), true);
        }
    }
}

/// Each target alone, and the paper's parallel variant, which takes several times the visits.
#[test]
fn targets_may_be_left_out_and_moves_summed() {
    let all = PushPullParams::default();
    let none = PushPullParams { min_distance: None, coverage_radius: None, capacity_tolerance: None, ..all };
    for space in [torus(), rectangle(1.0)] {
        for params in [
            PushPullParams { min_distance: Some(0.85), ..none },
            PushPullParams { coverage_radius: Some(0.67), ..none },
            PushPullParams { capacity_tolerance: Some(0.02), ..none },
            PushPullParams { min_distance: None, ..all },
            PushPullParams { coverage_radius: None, ..all },
            PushPullParams { capacity_tolerance: None, ..all },
        ] {
            pushed(space.clone(), 1000, 4, &params, true);
        }
    }
    let (_, in_turn) = pushed(torus(), 2500, 4, &all, true);
    let (_, summed) = pushed(torus(), 2500, 4, &PushPullParams { schedule: Schedule::Summed, relaxation: 0.5, ..all }, true);
    assert!(summed.visits > 2 * in_turn.visits, "{} {}", summed.visits, in_turn.visits);
}

/// Time is linear: about 21 visits a point, whatever their number.
#[test]
fn visits_a_point_do_not_grow() {
    for n in [10_000, 100_000] {
        let (_, report) = pushed(torus(), n, 2, &PushPullParams::default(), true);
        let visits = report.visits as f64 / n as f64;
        assert!((19.0..24.0).contains(&visits), "{n}: {visits}");
    }
}

/// A relaxation that diverges at {0.94, 0.65} is given up, and the targets are still reached.
#[test]
fn a_relaxation_that_diverges_is_given_up() {
    let params = PushPullParams { min_distance: Some(0.94), coverage_radius: Some(0.65), relaxation: 1.2, ..PushPullParams::default() };
    let (_, report) = pushed(torus(), 1024, 1, &params, true);
    assert!(report.notes.iter().any(|note| note.contains("relaxation 1.2 had made no progress")), "{:?}", report.notes);
}

/// Better than Opt-beta itself, which stalls at 0.8: the published sets have 0.75 at best.
#[test]
fn well_spaced_points_reach_their_ratio() {
    for (n, seeds, beta, bond_order, visits) in
        [(10_000, 5, 0.75, 0.50, 20), (10_000, 5, 0.70, 0.56, 50), (100_000, 2, 0.70, 0.56, 50), (10_000, 1, 0.67, 0.61, 600)]
    {
        for seed in 1..=seeds {
            let mut points = white(torus(), n, seed).unwrap();
            warp_isotropic(&mut points);
            let params = WellSpacedParams { beta, ..WellSpacedParams::default() };
            let report = well_spaced(&mut points, &params, &mut RunContext::default()).unwrap();
            let m = measure(&points).unwrap();
            let case = format!("{n}, {seed}, {beta}: {:?}, {m:?}", report.outcome);
            assert!(report.outcome == Outcome::Converged && m.beta <= beta, "{case}");
            assert!(m.bond_order <= bond_order && report.visits <= visits * n, "{case}, {}", report.visits / n);
            assert!(beta > 0.70 || m.obtuse_fraction == 0.0, "{case}");
        }
    }
}
