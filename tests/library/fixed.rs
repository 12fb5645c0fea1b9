//! Points that stay where they are, whatever method runs.

use crate::methods;
use crate::shapes;

use evenly::{
    Outcome, PointSet, PoissonDiskParams, Polygon, PushPullParams, Rectangle, RunContext, Space, Torus, eliminate, measure,
    poisson_disk_around, push_pull, warp, white,
};
use proptest::prelude::*;

use methods::OPTIMIZERS;

fn spaces() -> [Space; 4] {
    [
        Torus::new([0.0, 0.0], [1.0, 1.0]).unwrap().into(),
        Rectangle::new([1e6, -3.0], [5.0, 1.0]).unwrap().into(),
        Space::from(&Polygon::from_rings(shapes::l_shape()).unwrap()),
        Space::from(&Polygon::from_rings(shapes::star(7, 0.3)).unwrap()),
    ]
}

fn n_distinct(points: &PointSet) -> usize {
    let mut bits: Vec<[u64; 2]> = points.positions().iter().map(|p| p.map(f64::to_bits)).collect();
    bits.sort_unstable();
    bits.dedup();
    bits.len()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(16) })]
    #[test]
    fn no_method_moves_them(which in 0..4usize, n in 1..150usize, share in 0.0..1.0f64, seed in 0..1000u64, is_shared: bool) {
        let space = &spaces()[which];
        let n_fixed = (share * n as f64) as usize;
        let mut positions = white(space, n, seed).unwrap().positions().to_vec();
        if is_shared && n_fixed > 0 && n > n_fixed {
            // One that is free begins where one stays.
            positions[n - 1] = positions[0];
        }
        for (method, optimize) in OPTIMIZERS {
            let mut points = PointSet::new(space, positions.clone()).unwrap().with_fixed(n_fixed).unwrap();
            warp(&mut points);
            optimize(&mut points);
            prop_assert_eq!((points.n_points(), points.n_fixed()), (n, n_fixed), "{}", method);
            prop_assert_eq!(&points.positions()[..n_fixed], &positions[..n_fixed], "{}", method);
            prop_assert!(n < 3 || n_distinct(&points) == n, "{}", method);
        }
        let some = PointSet::new(space, positions[..n_fixed].to_vec()).unwrap();
        let thinned = eliminate(&PointSet::new(space, positions.clone()).unwrap().with_fixed(n_fixed).unwrap(), n_fixed.max(1)).unwrap();
        prop_assert_eq!(&thinned.positions()[..n_fixed], some.positions());
    }
}

#[test]
fn targets_are_reached_around_a_few() {
    for space in spaces().iter().take(3) {
        let (origin, size) = (space.origin(), space.size());
        let at = |x: f64, y: f64| [origin[0] + x * size[0], origin[1] + y * size[1]];
        let fixed = [at(0.2, 0.2), at(0.3, 0.4), at(0.4, 0.1)];
        let others = white(space, 997, 5).unwrap();
        let all = fixed.iter().chain(others.positions()).copied().collect();
        let mut points = PointSet::new(space, all).unwrap().with_fixed(3).unwrap();
        warp(&mut points);
        let report = push_pull(&mut points, &PushPullParams::default(), &mut RunContext::default()).unwrap();
        assert_eq!((report.outcome, &points.positions()[..3]), (Outcome::Converged, &fixed[..]), "{space}");
        assert!(measure(&points).unwrap().min_distance >= 0.85);
    }
}

#[test]
fn what_they_make_impossible_is_said() {
    let torus = &spaces()[0];
    let near = [[0.5, 0.5], [0.5001, 0.5]].into_iter();
    let all = near.chain(white(torus, 500, 1).unwrap().positions().iter().copied()).collect();
    let mut points = PointSet::new(torus, all).unwrap().with_fixed(2).unwrap();
    let report =
        push_pull(&mut points, &PushPullParams { max_passes: Some(300), ..PushPullParams::default() }, &mut RunContext::default()).unwrap();
    assert!(
        report.outcome == Outcome::Forced && report.notes.iter().any(|note| note.starts_with("2 points at fixed points")),
        "{report:?}"
    );
    let twice = PointSet::new(torus, vec![[0.5, 0.5], [0.1, 0.1], [0.5, 0.5]]).unwrap();
    assert!(twice.clone().with_fixed(3).is_err() && twice.clone().with_fixed(4).is_err() && twice.with_fixed(2).is_ok());
}

#[test]
fn a_maximal_set_grows_around_them() {
    for space in &spaces()[..3] {
        let (origin, size) = (space.origin(), space.size());
        let fixed = vec![[origin[0] + 0.2 * size[0], origin[1] + 0.2 * size[1]], [origin[0] + 0.4 * size[0], origin[1] + 0.3 * size[1]]];
        let params = PoissonDiskParams::for_about(space, 500);
        let points = poisson_disk_around(&PointSet::new(space, fixed.clone()).unwrap(), &params).unwrap();
        assert_eq!((&points.positions()[..2], points.n_fixed()), (&fixed[..], 2));
        let measures = measure(&points).unwrap();
        let spacing = params.spacing / measures.hex_spacing;
        assert!(measures.min_distance >= spacing * (1.0 - 1e-9) && measures.coverage_radius <= 1.01 * spacing, "{measures:?}");
        let near = vec![fixed[0], [fixed[0][0] + 0.5 * params.spacing, fixed[0][1]]];
        assert!(poisson_disk_around(&PointSet::new(space, near).unwrap(), &params).is_err());
    }
}
