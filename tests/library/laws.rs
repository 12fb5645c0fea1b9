//! Laws that hold for every method, in every space: one table of cases.

use std::sync::Arc;

use crate::spaces;

use evenly::{
    CancelToken, CvtParams, Measures, Method, Mode, Optimizer, Outcome, PointSet, Polygon, ProcrustesParams, PushPullParams, Rectangle,
    Report, RunContext, Schedule, Setting, Settings, Space, Torus, WellSpacedParams, angle_bounds_deg, cvt, hexagonal, jittered, measure,
    procrustes, push_pull, tessellate, warp, well_spaced, white,
};
use proptest::prelude::*;

use spaces::{n_distinct, nth, rectangle, spaces, torus};

/// A method of the registry, as it is told.
#[derive(Clone)]
struct Case(Arc<dyn Optimizer>);

impl std::fmt::Debug for Case {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "{} {:?}", self.0.method(), self.0.parameters())
    }
}

/// What methods are told so that they take little time, or another way; a few passes where nothing stands here.
fn told(method: &str) -> Vec<Settings> {
    let set = |all: &[(&str, Setting)]| all.iter().fold(Settings::default(), |told, (name, value)| told.with(name, value.clone()));
    let (count, number) = (|n| ("iterations", Setting::Count(n)), |name, x| (name, Setting::Number(x)));
    let choice = |name, value: &str| (name, Setting::Choice(value.into()));
    match method {
        "procrustes" => vec![set(&[]), set(&[choice("mode", "paper")])],
        "push-pull" => {
            let easy = [choice("preset", "fast"), count(300)];
            vec![set(&easy), set(&[&easy[..], &[choice("schedule", "summed")]].concat())]
        }
        "well-spaced" => vec![set(&[number("beta", 0.9)])],
        "opt-beta" => vec![set(&[number("beta", 0.578), count(6)])],
        "cvt" => vec![set(&[count(10)])],
        "farthest-point" => vec![set(&[("min_distance", Setting::Off), count(6)]), set(&[("local", Setting::On), count(9)])],
        "capacity" => vec![set(&[count(100)])],
        _ => vec![set(&[count(20)])],
    }
}

impl Case {
    /// Every optimiser of the registry; warping alone moves no points to rest.
    fn all() -> Vec<Self> {
        let optimizers = Method::all().filter(|method| method.is_optimizer() && method.name() != "warp");
        let cases = optimizers.flat_map(|method| told(method.name()).into_iter().map(move |told| method.optimizer(&told, 0)));
        cases.map(|case| Self(case.unwrap().unwrap().into())).collect()
    }

    fn of(optimizer: impl Optimizer + 'static) -> Self {
        Self(Arc::new(optimizer))
    }

    fn name(&self) -> &'static str {
        self.0.method().name()
    }

    fn run(&self, points: &mut PointSet) -> Report {
        self.0.run(points, &mut RunContext::default()).unwrap()
    }
}

fn is_inside(space: &Space, p: [f64; 2]) -> bool {
    let (origin, size) = (space.origin(), space.size());
    (0..2).all(|axis| {
        let end = origin[axis] + size[axis];
        p[axis] >= origin[axis] && if space.is_periodic() { p[axis] < end } else { p[axis] <= end }
    })
}

/// What every run must leave behind.
fn assert_sound(points: &PointSet, n: usize, report: &Report, case: &str) {
    assert_eq!((points.n_points(), report.n_points), (n, n), "{case}");
    assert!(points.positions().iter().all(|&p| is_inside(points.space(), p)), "{case}");
    if n >= 3 {
        assert_eq!(n_distinct(points), n, "{case}");
        assert_eq!(report.inverted_triangles, 0, "{case}");
        if report.method == "procrustes" {
            assert_eq!(report.energy.len(), report.iterations + 1, "{case}");
            // A ring of points on a narrow torus relaxes by its long waves alone.
            let [width, height] = points.space().size();
            let is_narrow = width / height > 50.0 && points.space().is_periodic();
            assert!(report.outcome == Outcome::Converged || is_narrow, "{case}");
        } else if report.method == "cvt" {
            assert!(report.energy.windows(2).all(|pair| pair[1] < pair[0]), "{case}");
        } else if report.method != "farthest-point" {
            assert_eq!(report.stable_share.len(), report.iterations, "{case}");
        }
    }
}

/// Ebeida et al., proposition 6.4: beta bounds all angles, in every state; and on a torus the number of neighbours.
fn assert_bounded(measures: &Measures, space: &Space, case: &str) {
    let Some([least, most]) = angle_bounds_deg(measures.beta) else { return };
    assert!(measures.angle_rms_deg.is_nan() || measures.min_angle_deg >= least - 1e-6 && measures.max_angle_deg <= most + 1e-6, "{case}");
    for &k in measures.valence.keys().filter(|_| space.is_periodic()) {
        // A vertex with k neighbours has an angle of 360 / k degrees or more, and one of that or less.
        let mean = 360.0 / k as f64;
        assert!(mean >= least - 1e-6 && mean <= most + 1e-6, "{case}: {k} neighbours");
    }
}

#[test]
fn every_method_is_sound_in_every_space_for_every_number() {
    for method in Case::all() {
        for space in spaces() {
            for n in (1..=24).chain([50, 333, 1000]) {
                let mut points = white(&space, n, n as u64).unwrap();
                let report = method.run(&mut points);
                let case = format!("{method:?}, {space}, {n}");
                assert_sound(&points, n, &report, &case);
                if let Ok(measures) = measure(&points) {
                    assert_bounded(&measures, &space, &case);
                }
            }
        }
    }
}

/// Found by random runs: on a cover of two periods, a point and its copy are half a period apart, and either way round is as short.
#[test]
fn an_edge_of_exactly_half_a_period_is_never_made() {
    for method in Case::all() {
        let mut points = hexagonal(torus([0.0, 0.0], [4624.430939384358, 773.5360734614178]), 13).unwrap();
        assert_eq!(method.run(&mut points).inverted_triangles, 0);
    }
}

#[test]
fn the_energy_never_ends_higher_and_never_rises_in_plain_steps() {
    for method in Case::all() {
        if method.name() != "procrustes" {
            continue;
        }
        for space in spaces() {
            let mut points = white(&space, 700, 3).unwrap();
            let report = method.run(&mut points);
            let case = format!("{method:?}, {space}");
            if space.is_periodic() {
                assert!(report.energy.last() <= report.energy.first(), "{case}");
            }
            if method.0.parameters().contains(&("mode", Setting::Choice("paper".into()))) {
                assert_eq!(report.energy_rises, 0, "{case}");
            }
        }
    }
}

#[test]
fn fewer_than_three_points_come_back_as_they_are() {
    for method in Case::all() {
        for n in [1, 2] {
            let mut points = white(nth(1), n, 5).unwrap();
            let before = points.clone();
            let report = method.run(&mut points);
            assert_eq!(points, before);
            assert_eq!(report.outcome, Outcome::NothingToDo);
            assert!(report.notes[0].contains("nothing to optimise"));
        }
    }
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    for method in Case::all() {
        for space in [nth(0), nth(4)] {
            let run = |n_threads: usize| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().unwrap();
                pool.install(|| {
                    let mut points = white(&space, 40_000, 11).unwrap();
                    warp(&mut points);
                    let report = method.run(&mut points);
                    let measures = measure(&points).unwrap();
                    (points, report, measures)
                })
            };
            let one = run(1);
            for n_threads in [2, 3, 8] {
                assert!(run(n_threads) == one, "{method:?}, {space}, {n_threads} threads");
            }
        }
    }
}

#[test]
fn the_order_of_the_input_does_not_matter() {
    for method in Case::all() {
        for space in [nth(0), nth(3)] {
            let start = white(&space, 500, 2).unwrap();
            let shuffled: Vec<[f64; 2]> = (0..500).map(|i| start.positions()[i * 77 % 500]).collect();
            let run = |positions: Vec<[f64; 2]>| {
                let mut points = PointSet::new(&space, positions).unwrap();
                warp(&mut points);
                method.run(&mut points);
                points
            };
            let (plain, other) = (run(start.positions().to_vec()), run(shuffled));
            for i in 0..500 {
                assert_eq!(other.positions()[i], plain.positions()[i * 77 % 500], "{method:?}, {space}");
            }
        }
    }
}

#[test]
fn scaling_by_a_power_of_two_scales_the_result_to_the_bit() {
    for method in Case::all() {
        for make in [torus, rectangle] {
            let run = |scale: f64| {
                let mut points = white(make([0.0, 0.0], [3.0 * scale, 2.0 * scale]), 400, 9).unwrap();
                warp(&mut points);
                method.run(&mut points);
                points.positions().iter().map(|p| p.map(|x| x / scale)).collect::<Vec<_>>()
            };
            let plain = run(1.0);
            assert_eq!(run(2f64.powi(40)), plain);
            assert_eq!(run(2f64.powi(-40)), plain);
        }
    }
}

#[test]
fn shifting_and_scaling_at_will_change_only_the_rounding() {
    for method in Case::all() {
        for make in [torus, rectangle] {
            let run = |origin: [f64; 2], scale: f64| {
                let start = white(make([0.0, 0.0], [1.0, 2.0]), 300, 4).unwrap();
                let moved = start.positions().iter().map(|p| [origin[0] + scale * p[0], origin[1] + scale * p[1]]).collect();
                let mut points = PointSet::new(make(origin, [scale, 2.0 * scale]), moved).unwrap();
                let report = method.run(&mut points);
                (measure(&points).unwrap(), report)
            };
            let (plain, report) = run([0.0, 0.0], 1.0);
            let (moved, other) = run([-3.0, 50.0], 7.3);
            match method.name() {
                "procrustes" => {
                    assert!((plain.angle_rms_deg - moved.angle_rms_deg).abs() < 0.2);
                    assert!((report.energy[0] - other.energy[0]).abs() < 1e-9);
                }
                "push-pull" => {
                    // Visits magnify rounding: other points come out, but as good ones.
                    for (measures, report) in [(&plain, &report), (&moved, &other)] {
                        assert_eq!(report.outcome, Outcome::Converged, "{method:?}");
                        assert_eq!(method.0.targets().unwrap().unmet(measures), [], "{method:?}");
                    }
                    assert!((plain.mean_distance - moved.mean_distance).abs() < 0.02);
                }
                "well-spaced" => {
                    let targets = method.0.targets().unwrap();
                    assert_eq!((targets.unmet(&plain), targets.unmet(&moved)), (vec![], vec![]));
                }
                _ => assert!((plain.mean_distance - moved.mean_distance).abs() < 0.03, "{method:?}"),
            }
        }
    }
}

/// Sets that make other programs stumble, as fractions of the domain.
fn hard_sets() -> Vec<(&'static str, Vec<[f64; 2]>)> {
    let some = white(torus([0.0, 0.0], [1.0, 1.0]), 200, 1).unwrap();
    let squeezed = |low: f64, width: f64| some.positions().iter().map(move |p| [low + width * p[0], low + width * p[1]]);
    let grid = |n: usize| (0..n * n).map(move |i| [(i % n) as f64 / n as f64, (i / n) as f64 / n as f64]).collect();
    vec![
        ("a grid", grid(20)),
        ("a small grid", grid(2)),
        ("a row", (0..50).map(|i| [i as f64 / 50.0, 0.5]).collect()),
        ("a column on the boundary", (0..50).map(|i| [0.0, i as f64 / 50.0]).collect()),
        ("a diagonal", (0..50).map(|i| [i as f64 / 64.0; 2]).collect()),
        ("one place", vec![[0.3, 0.7]; 40]),
        ("the corner", vec![[0.0, 0.0]; 40]),
        ("three in one place", vec![[0.5, 0.5]; 3]),
        ("pairs", squeezed(0.0, 1.0).chain(squeezed(0.0, 1.0)).collect()),
        ("a cluster", squeezed(0.4, 1e-3).collect()),
        ("two far clusters", squeezed(0.1, 1e-3).chain(squeezed(0.6, 1e-3)).collect()),
        ("half empty", some.positions().iter().map(|p| [0.5 * p[0], p[1]]).collect()),
    ]
}

#[test]
fn hard_sets_are_spread() {
    for method in Case::all() {
        for space in [nth(0), nth(1), nth(3), nth(4)] {
            for (name, fractions) in hard_sets() {
                for is_warped in [false, true] {
                    let n = fractions.len();
                    let (origin, size) = (space.origin(), space.size());
                    let place = |p: &[f64; 2]| [origin[0] + size[0] * p[0], origin[1] + size[1] * p[1]];
                    let mut points = PointSet::new(&space, fractions.iter().map(place).collect()).unwrap();
                    if is_warped {
                        warp(&mut points);
                    }
                    let report = method.run(&mut points);
                    let case = format!("{name}, {method:?}, {space}, warped {is_warped}");
                    assert_eq!(points.n_points(), n, "{case}");
                    assert_eq!(n_distinct(&points), n, "{case}");
                    assert_eq!(report.inverted_triangles, 0, "{case}");
                    assert!(points.positions().iter().all(|&p| is_inside(&space, p)), "{case}");
                }
            }
        }
    }
}

#[test]
fn what_was_separated_is_told() {
    let run = |positions: Vec<[f64; 2]>, space: Space| {
        let mut points = PointSet::new(&space, positions).unwrap();
        procrustes(&mut points, &ProcrustesParams::default(), &mut RunContext::default()).unwrap()
    };
    let doubled = run(vec![[0.1, 0.1], [0.6, 0.2], [0.1, 0.1], [0.3, 0.9], [0.1, 0.1]], nth(0));
    assert_eq!((doubled.coincident_points, doubled.was_collinear), (2, false));
    let lined = run((0..9).map(|i| [0.1 * f64::from(i), 0.5]).collect(), nth(3));
    assert_eq!((lined.coincident_points, lined.was_collinear), (0, true));
}

#[test]
fn points_near_a_line_in_a_polygon_spread_as_from_noise() {
    let l_shape = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.5, 1.0], [0.5, 0.6], [0.0, 0.6]];
    let space = Space::from(&Polygon::from_rings(vec![l_shape]).unwrap());
    for (width, n) in [(0.0, 200), (1e-15, 10), (1e-12, 1000), (1e-4, 200)] {
        let on_line = (0..n).map(|k| [0.02 + 0.96 * f64::from(k) / f64::from(n), 0.3 + width * f64::from(k * 7 % n) / f64::from(n)]);
        let mut points = PointSet::new(&space, on_line.collect()).unwrap();
        let report = cvt(&mut points, &CvtParams::default(), &mut RunContext::default()).unwrap();
        assert!(report.was_collinear && measure(&points).unwrap().beta < 1.3, "{width} {n}");
    }
}

#[test]
fn a_cancelled_run_keeps_its_best_state() {
    for method in Case::all() {
        let mut points = white(nth(0), 2000, 8).unwrap();
        let before = measure(&points).unwrap();
        let cancel = CancelToken::default();
        let handle = cancel.clone();
        let mut run = RunContext::default().with_cancel(cancel).on_progress(move |progress| {
            if progress.iteration == 5 {
                handle.cancel();
            }
        });
        let report = method.0.run(&mut points, &mut run).unwrap();
        assert_eq!((report.outcome, report.iterations), (Outcome::Cancelled, 5), "{method:?}");
        let after = measure(&points).unwrap();
        // Equal areas are all that the last wants; the triangles may suffer.
        let is_better = match method.name() {
            "capacity" => after.capacity_sd < 0.5 * before.capacity_sd,
            _ => after.angle_rms_deg < before.angle_rms_deg,
        };
        assert!(is_better, "{method:?}");
    }
}

#[test]
fn bad_parameters_are_refused_and_leave_the_points_alone() {
    let good = ProcrustesParams::default();
    for params in [
        ProcrustesParams { side: 0.0, ..good },
        ProcrustesParams { side: f64::NAN, ..good },
        ProcrustesParams { side: -1.5, ..good },
        ProcrustesParams { side: 100.0, ..good },
        ProcrustesParams { tolerance: 0.0, ..good },
        ProcrustesParams { tolerance: f64::INFINITY, ..good },
        ProcrustesParams { max_iterations: 0, ..good },
    ] {
        let mut points = white(nth(0), 100, 0).unwrap();
        let before = points.clone();
        assert!(procrustes(&mut points, &params, &mut RunContext::default()).is_err());
        assert_eq!(points, before);
    }
    let good = PushPullParams::default();
    for params in [
        PushPullParams { min_distance: Some(1.01), ..good },
        PushPullParams { min_distance: Some(0.0), ..good },
        PushPullParams { min_distance: Some(f64::NAN), ..good },
        PushPullParams { coverage_radius: Some(0.57), ..good },
        PushPullParams { coverage_radius: Some(f64::INFINITY), ..good },
        PushPullParams { coverage_radius: Some(f64::NAN), ..good },
        PushPullParams { capacity_tolerance: Some(-0.1), ..good },
        PushPullParams { capacity_tolerance: Some(-0.1), ..good },
        PushPullParams { capacity_tolerance: Some(f64::NAN), ..good },
        PushPullParams { relaxation: 0.0, ..good },
        PushPullParams { relaxation: 2.0, ..good },
        PushPullParams { relaxation: f64::NAN, ..good },
        PushPullParams { max_passes: Some(0), ..good },
        PushPullParams { min_distance: None, coverage_radius: None, capacity_tolerance: None, ..good },
        // The three points of a triangle with sides of 1 leave a hole of 0.5774.
        PushPullParams { min_distance: Some(1.0), coverage_radius: Some(0.577), ..good },
    ] {
        let mut points = white(nth(0), 100, 0).unwrap();
        let before = points.clone();
        assert!(push_pull(&mut points, &params, &mut RunContext::default()).is_err(), "{params:?}");
        assert_eq!(points, before);
    }
    for beta in [0.0, 0.577, 2.1, -1.0, f64::NAN, f64::INFINITY] {
        let mut points = white(nth(0), 100, 0).unwrap();
        let params = WellSpacedParams { beta, ..WellSpacedParams::default() };
        assert!(well_spaced(&mut points, &params, &mut RunContext::default()).is_err(), "{beta}");
    }
    for size in [[0.0, 1.0], [1.0, -1.0], [f64::NAN, 1.0], [1.0, f64::INFINITY], [1.0, 1e9]] {
        assert!(Torus::new([0.0, 0.0], size).is_err() && Rectangle::new([0.0, 0.0], size).is_err());
    }
    assert!(Torus::new([1e9, 0.0], [1e-9, 1e-9]).is_err());
    assert!(Torus::new([f64::NAN, 0.0], [1.0, 1.0]).is_err());
    assert!(white(torus([1e12, 0.0], [1.0, 1.0]), 1_000_000, 0).is_err());
    assert!(white(nth(0), 0, 0).is_err());
    let outside = PointSet::new(nth(3), vec![[0.5, 0.5], [1.5, 0.0]]).unwrap_err();
    assert!(outside.to_string().starts_with("point 1 is (1.5, 0), outside"));
}

#[test]
fn starts_have_exactly_n_distinct_points_inside() {
    for space in spaces() {
        for n in [1, 2, 3, 7, 12, 100, 997] {
            for points in [white(&space, n, 1), jittered(&space, n, 1), hexagonal(&space, n)] {
                let mut points = points.unwrap();
                for _ in 0..2 {
                    assert_eq!((points.n_points(), n_distinct(&points)), (n, n), "{space}, {n}");
                    assert!(points.positions().iter().all(|&p| is_inside(&space, p)), "{space}, {n}");
                    warp(&mut points);
                }
            }
        }
    }
}

#[test]
fn seeds_differ_and_repeat() {
    let make = |seed| white(nth(0), 100, seed).unwrap();
    assert_eq!(make(3), make(3));
    assert_ne!(make(3), make(4));
}

#[test]
fn the_hexagonal_lattice_has_the_measures_of_theory() {
    let points = hexagonal(torus([0.0, 0.0], [1.0, 3f64.sqrt()]), 2 * 40 * 40).unwrap();
    let m = measure(&points).unwrap();
    for (found, expected) in [
        (m.min_distance, 1.0),
        (m.mean_distance, 1.0),
        (m.coverage_radius, 1.0 / 3f64.sqrt()),
        (m.bond_order, 1.0),
        (m.bond_order_global, 1.0),
        (m.triangle_quality, 1.0),
        (m.min_angle_deg, 60.0),
        (m.max_angle_deg, 60.0),
        (m.angle_rms_deg + 1.0, 1.0),
        (m.capacity_sd + 1.0, 1.0),
        (m.capacity_max_deviation + 1.0, 1.0),
    ] {
        assert!((found / expected - 1.0).abs() < 1e-9, "{m:?}");
    }
    assert_eq!(m.valence.into_iter().collect::<Vec<_>>(), [(6, 3200)]);
    assert_eq!(m.obtuse_fraction, 0.0);
}

#[test]
fn voronoi_cells_fill_the_domain_and_triangles_too() {
    let area = |polygon: &[[f64; 2]]| {
        let next = polygon.iter().cycle().skip(1);
        let [x, y] = polygon.first().copied().unwrap_or_default();
        0.5 * polygon.iter().zip(next).map(|(a, b)| (a[0] - x) * (b[1] - y) - (b[0] - x) * (a[1] - y)).sum::<f64>()
    };
    for space in spaces() {
        for n in [3, 8, 60, 2000] {
            let mut points = white(&space, n, 6).unwrap();
            for _ in 0..2 {
                let tessellation = tessellate(&points).unwrap();
                let cells: f64 = tessellation.cells.iter().map(|cell| area(cell)).sum();
                assert!((cells / space.area() - 1.0).abs() < 1e-5, "{space}, {n}: {}", cells / space.area());
                let triangles: f64 = tessellation.corners.iter().map(|corners| area(corners)).sum();
                assert!(triangles / space.area() < 1.0 + 1e-5, "{space}, {n}");
                Case::all()[0].run(&mut points);
            }
        }
    }
}

#[test]
fn a_point_that_is_there_twice_is_counted_and_has_distance_zero() {
    let mut positions = white(nth(0), 100, 1).unwrap().positions().to_vec();
    let plain = measure(&PointSet::new(nth(0), positions.clone()).unwrap()).unwrap();
    positions.push(positions[17]);
    let m = measure(&PointSet::new(nth(0), positions).unwrap()).unwrap();
    assert_eq!((m.n_points, m.coincident_points, m.min_distance), (101, 1, 0.0));
    assert_eq!(m.angle_rms_deg, plain.angle_rms_deg);
    assert!(m.mean_distance < plain.mean_distance);
    // Three alone at .02, two together.
    let few = vec![[0.1, 0.1], [0.1, 0.1], [0.6, 0.6], [0.62, 0.6], [0.6, 0.62]];
    let m = measure(&PointSet::new(nth(0), few).unwrap()).unwrap();
    assert!((m.mean_distance * m.hex_spacing - 0.012).abs() < 1e-12);
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(120) })]
    #[test]
    fn any_points_in_any_domain_are_optimised(
        width in -12..12i32, aspect in -4.0..4.0f64, seed in 0..1000u64, n in 3..60usize, side in 0.5..2.0f64, which in 0..8usize,
        distance in prop::option::of(0.1..1.0f64), radius in prop::option::of(0.578..2.0f64), tolerance in 0.01..1.0f64,
    ) {
        let size = [10f64.powi(width), 10f64.powi(width) * aspect.exp()];
        let space = if which % 2 == 0 { torus([-size[1], size[0]], size) } else { rectangle([-size[1], size[0]], size) };
        let mode = if which % 4 < 2 { Mode::Paper } else { Mode::Fast };
        let schedule = if which % 4 < 2 { Schedule::InTurn } else { Schedule::Summed };
        let push = PushPullParams {
            min_distance: distance, coverage_radius: radius, capacity_tolerance: Some(tolerance), schedule, relaxation: 0.5 * side,
            max_passes: Some(60), seed,
        };
        let method = if which < 4 { Case::of(ProcrustesParams { side, mode, ..ProcrustesParams::default() }) } else { Case::of(push) };
        let mut points = white(&space, n, seed).unwrap();
        let report = method.run(&mut points);
        prop_assert_eq!(report.inverted_triangles, 0);
        prop_assert_eq!(n_distinct(&points), n);
        prop_assert!(points.positions().iter().all(|&p| is_inside(&space, p)));
        if let (Some(targets), Outcome::Converged) = (method.0.targets(), report.outcome) {
            prop_assert_eq!(targets.unmet(&measure(&points).unwrap()), []);
        }
    }
}
