//! Points where they are wanted: every method that knows a density, on pictures that are hard in different ways.

use crate::densities;

use std::f64::consts::TAU;

use densities::{blobs, hash, waves};
use evenly::{
    CapacityParams, Density, DistMeshParams, LloydParams, Measures, Outcome, PointSet, ProcrustesParams, PushPullParams, Rectangle, Report,
    RunContext, Space, Torus, WellSpacedParams, capacity, cvt, distmesh, eliminate, farthest_point, lloyd, measure, measure_each, opt_beta,
    poisson_disk_of_density, procrustes, push_pull, warp, warp_isotropic, well_spaced, white_by_density,
};

fn torus() -> Space {
    Torus::new([0.0, 0.0], [1.0, 1.0]).unwrap().into()
}

fn rectangle() -> Space {
    Rectangle::new([0.0, 0.0], [1.0, 1.0]).unwrap().into()
}

fn function(width: usize, density: impl Fn([f64; 2]) -> f64) -> Density {
    Density::function(&torus(), width, width, density).unwrap()
}

/// The five densities that Push-Pull is known to converge on: 9:1 waves, a ramp with a jump, blobs of 21:1 and 100:1, and waves with noise on every pixel.
fn five(width: usize) -> [(&'static str, Density); 5] {
    [
        ("waves", function(width, waves(0.8))),
        ("ramp", function(width, |p| 1.0 + 8.0 * p[0])),
        ("blobs 21:1", function(width, blobs(0.05))),
        ("blobs 100:1", function(width, blobs(0.01))),
        ("noise", function(width, |p| waves(0.8)(p) * (0.5 + hash(p)))),
    ]
}

fn start(space: &Space, density: &Density, n_points: usize, seed: u64) -> PointSet {
    let mut points = white_by_density(space, density, n_points, seed).unwrap();
    warp_isotropic(&mut points);
    points
}

#[test]
fn push_pull_converges_on_all_five_densities_and_points_follow_them() {
    for (name, density) in five(232) {
        let mut points = start(&torus(), &density, 2500, 11);
        let report = push_pull(&mut points, &PushPullParams::default(), &mut RunContext::default()).unwrap();
        assert_eq!(report.outcome, Outcome::Converged, "{name}");
        let measures = measure(&points).unwrap();
        assert!(measures.min_distance >= 0.85 - 1e-6 && measures.coverage_radius <= 0.67 + 1e-6, "{name}: {measures:?}");
        assert!(measures.capacity_max_deviation <= 0.0386 + 1e-6 && measures.density_error.unwrap() < 0.05, "{name}: {measures:?}");
    }
}

#[test]
fn push_pull_converges_in_a_rectangle_too() {
    for (name, density) in &five(232)[..4] {
        let mut points = start(&rectangle(), density, 2500, 5);
        let report = push_pull(&mut points, &PushPullParams::default(), &mut RunContext::default()).unwrap();
        assert_eq!(report.outcome, Outcome::Converged, "{name}");
        assert!(measure(&points).unwrap().density_error.unwrap() < 0.05, "{name}");
    }
}

#[test]
fn procrustes_keeps_the_shape_of_triangles_at_nineteen_to_one() {
    let density = function(500, |p| 1.0 + 0.9 * (TAU * p[0]).sin() * (TAU * p[1]).sin());
    for seed in 0..2 {
        let mut points = white_by_density(torus(), &density, 10_000, seed).unwrap();
        warp(&mut points);
        let report = procrustes(&mut points, &ProcrustesParams::default(), &mut RunContext::default()).unwrap();
        let measures = measure(&points).unwrap();
        assert_eq!((report.outcome, report.inverted_triangles), (Outcome::Converged, 0));
        assert!(measures.angle_rms_deg < 10.5 && measures.density_error.unwrap() < 0.05, "{measures:?}");
        // The paper's ten by ten cells, each against its share of the density.
        let mut squares = 0.0;
        for (column, row) in (0..10).flat_map(|row| (0..10).map(move |column| (column, row))) {
            let is_in = |p: &&[f64; 2]| (p[0] * 10.0) as usize == column && (p[1] * 10.0) as usize == row;
            let integral = |k: usize| ((TAU * k as f64 / 10.0).cos() - (TAU * (k + 1) as f64 / 10.0).cos()) / TAU;
            let wanted = 1e4 * (0.01 + 0.9 * integral(column) * integral(row));
            squares += (points.positions().iter().filter(is_in).count() as f64 / wanted - 1.0).powi(2);
        }
        assert!((squares / 100.0).sqrt() < 0.05, "{}", (squares / 100.0).sqrt());
    }
}

type Method = (&'static str, fn(&mut PointSet, &mut RunContext) -> Result<Report, evenly::Error>);

const METHODS: [Method; 6] = [
    ("push-pull", |points, run| push_pull(points, &PushPullParams { max_passes: Some(60), ..PushPullParams::default() }, run)),
    ("well-spaced", |points, run| well_spaced(points, &WellSpacedParams { max_passes: Some(60), ..WellSpacedParams::default() }, run)),
    ("capacity", |points, run| capacity(points, &CapacityParams { max_passes: Some(60), ..CapacityParams::default() }, run)),
    ("lloyd", |points, run| lloyd(points, &LloydParams { iterations: 30, ..LloydParams::default() }, run)),
    ("distmesh", |points, run| distmesh(points, &DistMeshParams { iterations: 60, ..DistMeshParams::default() }, run)),
    ("procrustes", |points, run| procrustes(points, &ProcrustesParams { max_iterations: 60, ..ProcrustesParams::default() }, run)),
];

fn run(method: Method, points: &mut PointSet) -> Measures {
    method.1(points, &mut RunContext::default()).unwrap();
    measure(points).unwrap()
}

#[test]
fn every_method_follows_a_density_with_empty_parts_and_puts_nothing_there() {
    // A disk, dense on one side, on empty ground; a hole in it, and a single full pixel far away.
    let is_empty = |p: [f64; 2]| {
        let from = |x: f64, y: f64| (p[0] - x).hypot(p[1] - y);
        (from(0.5, 0.5) > 0.35 || from(0.45, 0.55) < 0.1) && !((p[0] * 100.0) as usize == 3 && (p[1] * 100.0) as usize == 96)
    };
    let density = function(100, |p| if is_empty(p) { 0.0 } else { 0.5 + p[0] });
    let middle = |p: &[f64; 2]| is_empty(p.map(|x| ((x * 100.0).floor() + 0.5) / 100.0));
    for space in [torus(), rectangle()] {
        for method in METHODS {
            let mut points = start(&space, &density, 1500, 3);
            assert!(!points.positions().iter().any(middle));
            let measures = run(method, &mut points);
            assert!(!points.positions().iter().any(middle), "{}", method.0);
            assert!(measures.density_error.unwrap() < 0.12, "{} {space}: {:?}", method.0, measures.density_error);
        }
    }
}

#[test]
fn a_constant_picture_is_as_good_as_none() {
    let constant = Density::image(37, 23, &[0.25; 37 * 23]).unwrap();
    for space in [torus(), rectangle()] {
        let mut with = start(&space, &constant, 600, 2);
        let without = with.clone().with_density(&Density::uniform());
        let (a, b) = (measure(&with).unwrap(), measure(&without).unwrap());
        for (x, y) in [
            (a.min_distance, b.min_distance),
            (a.mean_distance, b.mean_distance),
            (a.coverage_radius, b.coverage_radius),
            (a.capacity_sd, b.capacity_sd),
            (a.capacity_max_deviation, b.capacity_max_deviation),
        ] {
            assert!((x - y).abs() < 1e-6, "{a:?} {b:?}");
        }
        let report = push_pull(&mut with, &PushPullParams::default(), &mut RunContext::default()).unwrap();
        assert_eq!(report.outcome, Outcome::Converged);
        assert!(measure(&with.with_density(&Density::uniform())).unwrap().coverage_radius < 0.67 + 1e-6);
    }
}

#[test]
fn threads_do_not_change_a_bit() {
    let density = function(200, blobs(0.02));
    let made = |method: Method, n_threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().unwrap();
        pool.install(|| {
            let mut points = start(&torus(), &density, 3000, 1);
            run(method, &mut points);
            points
        })
    };
    for method in METHODS {
        assert!(made(method, 1) == made(method, 3), "{}", method.0);
    }
}

#[test]
fn odd_domains_pictures_and_numbers_of_points_break_nothing() {
    let spaces: [Space; 4] = [
        Torus::new([1e9, -1e9], [100.0, 1.0]).unwrap().into(),
        Rectangle::new([1e9, 5.0], [1.0, 100.0]).unwrap().into(),
        Torus::new([0.0, 0.0], [1e-9, 1e-9]).unwrap().into(),
        Rectangle::new([-1.0, 0.0], [1e-9, 1e-9]).unwrap().into(),
    ];
    let mut lonely = vec![0.0; 10_000];
    lonely[4321] = 1.0;
    let steep: Vec<f32> = (0..64).map(|k| 10f32.powi(k % 8 * 9 - 36)).collect();
    let densities = [
        Density::image(1, 1, &[0.3]).unwrap(),
        Density::image(10_000, 1, &lonely).unwrap(),
        Density::image(100, 100, &lonely).unwrap(),
        Density::image(8, 8, &steep).unwrap(),
        function(50, blobs(0.0)),
    ];
    for space in spaces {
        for density in &densities {
            for n in [1, 3, 40] {
                for method in METHODS {
                    // Where rounding leaves no room, that is said.
                    let Ok(mut points) = white_by_density(&space, density, n, 1) else { continue };
                    warp(&mut points);
                    if method.1(&mut points, &mut RunContext::default()).is_ok() {
                        let is_inside = |p: &[f64; 2]| PointSet::new(&space, vec![*p]).is_ok() && p.iter().all(|x| x.is_finite());
                        assert!(points.n_points() == n && points.positions().iter().all(is_inside), "{} {space}", method.0);
                    }
                }
                if let Ok(points) = poisson_disk_of_density(&space, density, n, 1) {
                    assert_eq!(points.n_points(), n);
                    assert_eq!(eliminate(&points, n.div_ceil(2)).unwrap().n_points(), n.div_ceil(2));
                }
            }
        }
    }
}

#[test]
fn sparse_pictures_and_half_empty_ones_leave_distinct_points_where_there_is_density() {
    // One pixel in twenty, by a hash; and the left half empty.
    let sparse = function(60, |p| if hash(p) < 0.05 { 1.0 } else { 0.0 });
    let half = function(60, |p| if p[0] < 0.5 { 0.0 } else { 1.0 });
    for density in [&sparse, &half] {
        for space in [torus(), rectangle()] {
            for method in METHODS {
                // Points that follow it, and points that do not.
                let even = white_by_density(&space, &Density::uniform(), 300, 4).unwrap().with_density(density);
                for mut points in [start(&space, density, 300, 4), even] {
                    if method.1(&mut points, &mut RunContext::default()).is_err() {
                        continue;
                    }
                    let mut places: Vec<[u64; 2]> = points.positions().iter().map(|p| p.map(f64::to_bits)).collect();
                    places.sort_unstable();
                    places.dedup();
                    assert_eq!(places.len(), 300, "{} {space} {}", method.0, points.positions().len());
                    let outside = points.positions().iter().find(|p| !p.iter().all(|x| (0.0..=1.0).contains(x)));
                    assert_eq!(outside, None, "{} {space}", method.0);
                }
            }
        }
    }
}

#[test]
fn methods_without_a_density_say_so() {
    let mut points = start(&torus(), &function(50, waves(0.5)), 100, 1);
    let before = points.clone();
    let run = &mut RunContext::default();
    assert!(opt_beta(&mut points, &evenly::OptBetaParams::default(), run).is_err());
    assert!(cvt(&mut points, &evenly::CvtParams::default(), run).is_err());
    assert!(farthest_point(&mut points, &evenly::FarthestPointParams::default(), run).is_err());
    assert_eq!(points, before);
}

/// Half of the domain, a disk, a board of fields, a ring of single pixels with some that stand alone: triangles know nothing of black areas.
#[test]
fn procrustes_keeps_points_apart_at_the_edges_of_black_areas() {
    let disk = |p: [f64; 2]| f64::from(u8::from((p[0] - 0.5).hypot(p[1] - 0.5) < 0.3));
    let board = |p: [f64; 2]| f64::from(u8::from(((8.0 * p[0]) as usize + (8.0 * p[1]) as usize).is_multiple_of(2)));
    let ring = |p: [f64; 2]| {
        let is_alone = [0, 1].iter().all(|&axis| ((p[axis] * 200.0) as usize).is_multiple_of(25));
        f64::from(u8::from(((p[0] - 0.5).hypot(p[1] - 0.5) - 0.35).abs() < 0.005)) + 0.5 * f64::from(u8::from(is_alone))
    };
    let pictures = [Density::image(2, 1, &[0.0, 1.0]).unwrap(), function(100, disk), function(200, board), function(200, ring)];
    for (picture, density) in pictures.iter().enumerate() {
        for (space, n, seed) in [(rectangle(), 200, 1), (torus(), 1000, 2), (rectangle(), 3000, 3)] {
            let mut points = start(&space, density, n, seed);
            let report = procrustes(&mut points, &ProcrustesParams::default(), &mut RunContext::default()).unwrap();
            let nearest = measure_each(&points).unwrap().iter().map(|point| point.nearest).fold(f64::INFINITY, f64::min);
            assert_eq!((points.n_points(), report.outcome), (n, Outcome::Converged), "{picture}, {n}: {:?}", report.notes);
            assert!(nearest >= 0.4, "{picture}, {n}: {nearest}");
        }
    }
}

#[test]
fn what_the_white_part_has_no_room_for_is_told() {
    // A single pixel of ten thousand, and no other within reach.
    let mut pixels = vec![0.0; 10_000];
    (pixels[5050], pixels[150]) = (1.0, 1e-3);
    let density = Density::image(100, 100, &pixels).unwrap();
    let mut points = start(&rectangle(), &density, 7, 1);
    let report = procrustes(&mut points, &ProcrustesParams::default(), &mut RunContext::default()).unwrap();
    assert!(report.outcome == Outcome::Converged || report.notes.iter().any(|note| note.contains("no room")), "{report:?}");
}

/// What each point adds is what all have together.
#[test]
fn the_measures_of_each_point_are_those_of_all() {
    for density in [Density::uniform(), five(64)[2].1.clone()] {
        for space in [torus(), rectangle()] {
            let points = white_by_density(&space, &density, 700, 4).unwrap();
            let (all, each) = (measure(&points).unwrap(), measure_each(&points).unwrap());
            assert_eq!(each.len(), 700);
            let nearest = each.iter().map(|point| point.nearest).fold(f64::INFINITY, f64::min);
            let reach = each.iter().map(|point| point.reach).fold(0.0, f64::max);
            let deviation = each.iter().map(|point| (point.capacity - 1.0).abs()).fold(0.0, f64::max);
            assert_eq!([nearest, reach, deviation], [all.min_distance, all.coverage_radius, all.capacity_max_deviation]);
            assert!((each.iter().map(|point| point.capacity).sum::<f64>() / 700.0 - 1.0).abs() < 1e-6);
        }
    }
}
