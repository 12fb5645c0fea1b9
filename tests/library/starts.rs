//! What the methods promise that make points from nothing.

use crate::spaces;

use evenly::{
    CancelToken, DartParams, PointSet, PoissonDiskParams, Rectangle, RunContext, Space, Torus, dart, eliminate, measure, poisson_disk,
    poisson_disk_of, progressive, white,
};
use proptest::prelude::*;

use spaces::{n_distinct, nth, rectangle, spaces, torus};

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(400) })]
    /// No two points nearer than the spacing, no place farther than the coverage radius: seen on a fresh triangulation, to the last bits.
    #[test]
    fn poisson_disk_sets_are_maximal(
        n in 3..1500usize, seed: u64, scale in -6.0..6.0f64, aspect in -4.0..4.0f64, is_periodic: bool, looseness in 1.0..3.0f64,
    ) {
        let width = 10f64.powf(scale);
        let size = [width, width * aspect.exp()];
        let space: Space =
            if is_periodic { Torus::new([0.0, 0.0], size).unwrap().into() } else { Rectangle::new([0.0, 0.0], size).unwrap().into() };
        for factor in [1.0, looseness] {
            let params = PoissonDiskParams { seed, ..PoissonDiskParams::for_about(&space, n) };
            let params = PoissonDiskParams { coverage: Some(factor * params.spacing), ..params };
            let points = poisson_disk(&space, &params).unwrap();
            if let Ok(m) = measure(&points) {
                let (distance, radius) = (m.min_distance * m.hex_spacing, m.coverage_radius * m.hex_spacing);
                // The domain's own sides are known to 2^-48 of the longer one.
                let rounding = 1e-14 * size[0].max(size[1]);
                prop_assert!(distance >= params.spacing - rounding, "{distance} {params:?}");
                prop_assert!(radius <= factor * params.spacing + rounding, "{radius} {params:?}");
            }
        }
    }
}

/// Nothing but the distances is asked of a large set: no pair is missed at the seam, in any place.
#[test]
fn large_maximal_sets_are_maximal() {
    for space in [torus([0.0, 0.0], [1.0, 1.0]), rectangle([0.0, 0.0], [3.0, 1.0]), torus([0.0, 0.0], [100.0, 1.0])] {
        let params = PoissonDiskParams { seed: 3, ..PoissonDiskParams::for_about(&space, 50_000) };
        let points = poisson_disk(&space, &params).unwrap();
        let m = measure(&points).unwrap();
        assert!(m.min_distance * m.hex_spacing >= params.spacing && m.coverage_radius * m.hex_spacing <= params.spacing, "{space}");
        assert!(m.beta > 0.999 && m.beta <= 1.0);
        assert!(points.n_points().abs_diff(50_000) < 300, "{}", points.n_points());
        // In rows of cells, which are at most 1 / sqrt(2) of the spacing high.
        let fallen = points.positions().windows(2).map(|pair| pair[0][1] - pair[1][1]).fold(0.0, f64::max);
        assert!(fallen <= params.spacing * 0.7072, "{fallen}");
    }
}

/// Places that lie far from zero lose bits, the spacing none.
#[test]
fn rounding_brings_no_points_together() {
    for space in [torus([1e9, 0.0], [1.0, 1.0]), rectangle([-3.0, 1e12], [2000.0, 500.0])] {
        let params = PoissonDiskParams { seed: 1, ..PoissonDiskParams::for_about(&space, 3000) };
        let points = poisson_disk(&space, &params).unwrap();
        let m = measure(&points).unwrap();
        assert!(m.min_distance * m.hex_spacing >= params.spacing * (1.0 - 1e-14), "{space}");
        // Gaps may be missed that are as small as what rounding moves points by.
        let coarseness = space.origin().map(|x| (x.abs() + 1.0) * f64::EPSILON).into_iter().fold(0.0, f64::max);
        assert!(m.coverage_radius * m.hex_spacing <= params.spacing + 4.0 * coarseness, "{space}");
    }
}

#[test]
fn two_radii_are_both_used_up() {
    for (looseness, least) in [(1.2, 0.98), (1.5, 0.96), (2.0, 0.93)] {
        let space = nth(0);
        let params = PoissonDiskParams { seed: 5, ..PoissonDiskParams::for_about(&space, 20_000) };
        let params = PoissonDiskParams { coverage: Some(looseness * params.spacing), ..params };
        let beta = measure(&poisson_disk(space, &params).unwrap()).unwrap().beta;
        // Of so few points none may stand quite as near to another as it could.
        assert!(beta <= looseness && beta > least * looseness, "{beta} {looseness}");
    }
}

#[test]
fn exact_numbers_are_exact_in_every_space() {
    for space in spaces() {
        for n in (1..=12).chain([100, 1000]) {
            let thrown = dart(&space, &DartParams { n_points: Some(n), seed: n as u64, ..DartParams::default() }).unwrap();
            let left = eliminate(&white(&space, 5 * n, n as u64).unwrap(), n).unwrap();
            let full = poisson_disk_of(&space, n, n as u64).unwrap();
            assert!([thrown, left, full].iter().all(|points| points.n_points() == n), "{space}, {n}");
        }
    }
}

/// The paper's weights reach 0.69 hexagonal spacings from five candidates a point.
#[test]
fn elimination_keeps_points_apart_and_in_progressive_order() {
    let candidates = white(nth(0), 20_000, 3).unwrap();
    let points = eliminate(&candidates, 4000).unwrap();
    assert!(points.positions().iter().all(|p| candidates.positions().contains(p)));
    for (part, distance) in [(1, 0.68), (2, 0.6), (4, 0.6), (10, 0.57)] {
        let first = PointSet::new(nth(0), points.positions()[..4000 / part].to_vec()).unwrap();
        assert!(measure(&first).unwrap().min_distance > distance, "{part}");
    }
}

/// In a row of points the spacing is that of the row; else whole stretches of it would stay empty.
#[test]
fn long_domains_are_filled_from_end_to_end() {
    for make in [torus, rectangle] {
        let space = make([0.0, 0.0], [1000.0, 1.0]);
        for n in [20, 100] {
            let sets = [
                eliminate(&white(&space, 5 * n, 1).unwrap(), n).unwrap(),
                poisson_disk_of(&space, n, 1).unwrap(),
                dart(&space, &DartParams { n_points: Some(n), ..DartParams::default() }).unwrap(),
            ];
            for (index, points) in sets.iter().enumerate() {
                let mut along: Vec<f64> = points.positions().iter().map(|p| p[0]).chain([0.0, 1000.0]).collect();
                along.sort_by(f64::total_cmp);
                let widest = along.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
                assert!(widest < 3.0 * 1000.0 / n as f64, "{space}, {n}, {index}: {widest}");
            }
        }
    }
}

#[test]
fn darts_fall_until_it_is_full() {
    let space = nth(3);
    let spacing = 0.03;
    let full = dart(&space, &DartParams { spacing: Some(spacing), ..DartParams::default() }).unwrap();
    let m = measure(&full).unwrap();
    assert!(m.min_distance * m.hex_spacing >= spacing && m.coverage_radius * m.hex_spacing < 1.5 * spacing, "{m:?}");
    let few = dart(&space, &DartParams { spacing: Some(spacing), n_points: Some(50), ..DartParams::default() }).unwrap();
    assert_eq!(few.positions(), &full.positions()[..50]);
    // A spacing that shrinks leaves an order in which the first are spread too.
    let points = dart(&space, &DartParams { n_points: Some(1000), ..DartParams::default() }).unwrap();
    let first = PointSet::new(space, points.positions()[..100].to_vec()).unwrap();
    assert!(measure(&points).unwrap().min_distance > 0.6 && measure(&first).unwrap().min_distance > 0.6);
}

#[test]
fn a_progressive_order_can_be_interrupted_and_loses_no_point() {
    let points = white(nth(0), 20_000, 4).unwrap();
    let cancel = CancelToken::default();
    let run = RunContext::default().with_cancel(cancel.clone());
    let whole = progressive(&points, &run).unwrap();
    assert_eq!(whole, eliminate(&points, 20_000).unwrap());
    cancel.cancel();
    let cut = progressive(&points, &run).unwrap();
    assert_eq!(n_distinct(&cut), 20_000);
}
