//! What the methods promise that others are compared with.

use crate::spaces;

use evenly::{
    CapacityParams, CvtParams, DistMeshParams, FarthestPointParams, LloydParams, OptBetaParams, Outcome, PointSet, RunContext,
    angle_bounds_deg, capacity, cvt, distmesh, farthest_point, lloyd, measure, opt_beta, poisson_disk_of, white,
};

use spaces::{nth, rectangle, torus};

fn beta(points: &PointSet) -> f64 {
    measure(points).unwrap().beta
}

/// Ebeida et al., section 6.2: Opt-beta makes the smallest beta, then CVT, DistMesh, Far-Point. One spot decides on each run, so medians count.
#[test]
fn opt_beta_ends_lowest_then_cvt_then_distmesh_then_farthest_point() {
    let median = |method: fn(&mut PointSet)| {
        let mut betas: Vec<f64> = (1..=5)
            .map(|seed| {
                let mut points = poisson_disk_of(nth(0), 2000, seed).unwrap();
                method(&mut points);
                beta(&points)
            })
            .collect();
        betas.sort_by(f64::total_cmp);
        betas[2]
    };
    let betas = [
        median(|points| {
            let params = OptBetaParams { beta: Some(0.578), iterations: 100, ..OptBetaParams::default() };
            opt_beta(points, &params, &mut RunContext::default()).unwrap();
        }),
        median(|points| {
            let params = LloydParams { iterations: 250, tolerance: 0.0, seed: 0 };
            lloyd(points, &params, &mut RunContext::default()).unwrap();
        }),
        median(|points| {
            let params = DistMeshParams { iterations: 250, tolerance: 0.0, ..DistMeshParams::default() };
            distmesh(points, &params, &mut RunContext::default()).unwrap();
        }),
        median(|points| {
            let params = FarthestPointParams { min_distance: None, is_local: true, iterations: 60, ..FarthestPointParams::default() };
            farthest_point(points, &params, &mut RunContext::default()).unwrap();
        }),
    ];
    assert!(betas.is_sorted_by(|a, b| a < b), "{betas:?}");
    assert!(betas[0] < 0.80 && betas[3] > 0.87, "{betas:?}");
}

/// One spot decides how many sweeps it takes, 18 to 109 with 10,000 points; the bounds hold in every state on the way.
#[test]
fn opt_beta_reaches_its_target_within_the_bounds_of_its_angles() {
    for seed in 1..=3 {
        for iterations in [1, 3, 200] {
            let mut points = poisson_disk_of(nth(0), 4000, seed).unwrap();
            let params = OptBetaParams { iterations, ..OptBetaParams::default() };
            let report = opt_beta(&mut points, &params, &mut RunContext::default()).unwrap();
            let m = measure(&points).unwrap();
            assert!((m.beta / report.energy.iter().copied().fold(f64::MAX, f64::min) - 1.0).abs() < 1e-9);
            if let Some([least, most]) = angle_bounds_deg(m.beta) {
                assert!(m.min_angle_deg >= least - 1e-6 && m.max_angle_deg <= most + 1e-6, "{m:?}");
            }
            if iterations == 200 {
                assert_eq!(report.outcome, Outcome::Converged);
                assert!(m.beta <= 0.85 && report.iterations <= 109 && m.bond_order < 0.56, "{} {m:?}", report.iterations);
            }
        }
    }
}

#[test]
fn no_move_of_lloyds_method_raises_the_energy() {
    for space in [nth(0), nth(1), nth(3)] {
        let mut points = white(&space, 500, 3).unwrap();
        let mut energy = measure(&points).unwrap().cvt_energy;
        for seed in 0..15 {
            lloyd(&mut points, &LloydParams { iterations: 1, tolerance: 0.0, seed }, &mut RunContext::default()).unwrap();
            let after = measure(&points).unwrap().cvt_energy;
            assert!(after < energy, "{space}: {after} {energy}");
            energy = after;
        }
    }
}

/// Liu et al. 2009: a quasi-Newton method is as far after a hundred iterations as Lloyd's after a thousand, on average: both end in one of many valleys.
#[test]
fn a_hundred_quasi_newton_iterations_are_worth_a_thousand_of_lloyds() {
    for space in [torus([0.0, 0.0], [1.0, 1.0]), rectangle([0.0, 0.0], [2.0, 1.0])] {
        let (mut of_lloyd, mut of_cvt) = (0.0, 0.0);
        for seed in 0..6 {
            let start = white(&space, 1000, seed).unwrap();
            let (mut slow, mut fast) = (start.clone(), start);
            lloyd(&mut slow, &LloydParams { iterations: 1000, tolerance: 0.0, seed }, &mut RunContext::default()).unwrap();
            let report = cvt(&mut fast, &CvtParams::default(), &mut RunContext::default()).unwrap();
            let (slow, fast) = (measure(&slow).unwrap(), measure(&fast).unwrap());
            assert!(report.iterations <= 100 && (report.energy.last().unwrap() / fast.cvt_energy - 1.0).abs() < 1e-9);
            // The paper's Figure 4 is as regular.
            assert!(fast.bond_order > 0.79 && fast.mean_distance > 0.92, "{fast:?}");
            of_lloyd += slow.cvt_energy / 6.0;
            of_cvt += fast.cvt_energy / 6.0;
        }
        assert!(of_cvt < of_lloyd * 1.0004, "{space}: {of_cvt} {of_lloyd}");
    }
}

#[test]
fn the_smallest_distance_never_falls_and_is_as_large_as_wanted() {
    for space in [nth(0), nth(3), torus([0.0, 0.0], [30.0, 1.0])] {
        for is_local in [false, true] {
            let mut points = white(&space, 600, 2).unwrap();
            let mut distance = 0.0;
            for _ in 0..8 {
                let params = FarthestPointParams { min_distance: None, is_local, iterations: 1, ..FarthestPointParams::default() };
                farthest_point(&mut points, &params, &mut RunContext::default()).unwrap();
                let after = measure(&points).unwrap().min_distance;
                assert!(after >= distance * (1.0 - 1e-9), "{space}: {after} {distance}");
                distance = after;
            }
        }
    }
    let mut points = white(nth(0), 2000, 5).unwrap();
    let params = FarthestPointParams { min_distance: Some(0.925), ..FarthestPointParams::default() };
    let report = farthest_point(&mut points, &params, &mut RunContext::default()).unwrap();
    let m = measure(&points).unwrap();
    assert_eq!(report.outcome, Outcome::Converged);
    assert!(m.min_distance >= 0.925 && m.mean_distance >= 0.932 && m.bond_order < 0.53, "{m:?}");
}

#[test]
fn what_is_asked_for_is_done_and_no_more() {
    let mut points = white(nth(0), 300, 1).unwrap();
    let report = lloyd(&mut points, &LloydParams { iterations: 7, tolerance: 0.0, seed: 0 }, &mut RunContext::default()).unwrap();
    assert_eq!((report.outcome, report.iterations), (Outcome::IterationsDone, 7));
    let report = lloyd(&mut points, &LloydParams { tolerance: 0.5, ..LloydParams::default() }, &mut RunContext::default()).unwrap();
    assert_eq!((report.outcome, report.iterations), (Outcome::Converged, 1));
    let mut points = white(nth(3), 300, 1).unwrap();
    let report = capacity(&mut points, &CapacityParams::default(), &mut RunContext::default()).unwrap();
    assert_eq!(report.outcome, Outcome::Converged);
    assert!(measure(&points).unwrap().capacity_max_deviation <= 0.0386 + 1e-6);
}

#[test]
fn bad_parameters_are_refused() {
    let mut points = white(nth(0), 9, 1).unwrap();
    let before = points.clone();
    let mut run = RunContext::default();
    let beta = OptBetaParams::default();
    assert!(opt_beta(&mut points, &OptBetaParams { beta: Some(0.5), ..beta }, &mut run).is_err());
    assert!(opt_beta(&mut points, &OptBetaParams { damping: Some(f64::NAN), ..beta }, &mut run).is_err());
    assert!(opt_beta(&mut points, &OptBetaParams { iterations: 0, ..beta }, &mut run).is_err());
    assert!(lloyd(&mut points, &LloydParams { tolerance: -1.0, ..LloydParams::default() }, &mut run).is_err());
    assert!(cvt(&mut points, &CvtParams { tolerance: f64::INFINITY, ..CvtParams::default() }, &mut run).is_err());
    assert!(distmesh(&mut points, &DistMeshParams { pressure: 0.0, ..DistMeshParams::default() }, &mut run).is_err());
    assert!(distmesh(&mut points, &DistMeshParams { step: 1.5, ..DistMeshParams::default() }, &mut run).is_err());
    assert!(capacity(&mut points, &CapacityParams { capacity_tolerance: -0.1, ..CapacityParams::default() }, &mut run).is_err());
    let far = FarthestPointParams::default();
    assert!(farthest_point(&mut points, &FarthestPointParams { min_distance: Some(1.5), ..far }, &mut run).is_err());
    assert!(farthest_point(&mut points, &FarthestPointParams { relaxation: 2.0, ..far }, &mut run).is_err());
    assert_eq!(points, before);
}
