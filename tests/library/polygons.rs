//! Points in polygons: laws that hold for every method, whatever the boundary.

use crate::methods;
use crate::shapes;

use evenly::{
    DartParams, Density, Measures, Outcome, PointSet, PoissonDiskParams, Polygon, PushPullParams, PushPullPreset, Rectangle, RunContext,
    Space, Targets, dart, eliminate, jittered, measure, poisson_disk, poisson_disk_of, poisson_disk_of_density, push_pull, tessellate,
    white, white_by_density,
};
use proptest::prelude::*;

use methods::OPTIMIZERS;
use shapes::{Ring, comb, l_shape, moved, needle, nested, passage, rectangle, slit, spiral, star};

fn space(rings: &[Ring]) -> Space {
    Space::from(&Polygon::from_rings(rings.to_vec()).unwrap())
}

fn starts(space: &Space, n: usize, seed: u64) -> [(&'static str, PointSet); 5] {
    [
        ("white", white(space, n, seed).unwrap()),
        ("jittered", jittered(space, n, seed).unwrap()),
        ("poisson-disk", poisson_disk_of(space, n, seed).unwrap()),
        ("dart", dart(space, &DartParams { n_points: Some(n), seed, ..DartParams::default() }).unwrap()),
        ("eliminate", eliminate(&white(space, 5 * n, seed).unwrap(), n).unwrap()),
    ]
}

fn assert_inside(points: &PointSet, n: usize, case: &str) {
    assert_eq!(points.n_points(), n, "{case}");
    let taken = PointSet::new(points.space(), points.positions().to_vec());
    assert!(taken.is_ok(), "{case}: {taken:?}");
    let mut bits: Vec<[u64; 2]> = points.positions().iter().map(|p| p.map(f64::to_bits)).collect();
    bits.sort_unstable();
    bits.dedup();
    assert_eq!(bits.len(), n, "{case}");
}

fn shape() -> impl Strategy<Value = Vec<Ring>> {
    let shape = prop_oneof![
        Just(l_shape()),
        (3..9usize, 0.1..0.9f64).prop_map(|(n, inner)| star(n, inner)),
        (2..6usize, 0.02..0.4f64).prop_map(|(n, width)| comb(n, width)),
        (1.0..2.5f64, 0.2..0.8f64).prop_map(|(n, width)| spiral(n, width)),
        (1..5usize).prop_map(nested),
        (1e-3..0.1f64).prop_map(needle),
        prop_oneof![Just(1e-9), 1e-3..0.1f64].prop_map(slit),
        prop_oneof![Just(1e-9), 1e-3..0.1f64].prop_map(passage),
    ];
    let places = prop_oneof![Just((1.0, 0.0)), Just((1e-9, 3.0)), Just((1e6, 1e9)), Just((1.0, -1e6))];
    (shape, 0.0..6.3f64, places).prop_map(|(rings, turn, (scale, far))| moved(&rings, turn, scale, [far * scale, -far]))
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(24) })]
    #[test]
    fn every_method_leaves_so_many_distinct_points_inside(rings in shape(), n in 1..120usize, seed in 0..1000u64) {
        let Ok(polygon) = Polygon::from_rings(rings) else { return Ok(()) };
        let space = Space::from(&polygon);
        for (start, points) in starts(&space, n, seed) {
            let taken = PointSet::new(&space, points.positions().to_vec());
            prop_assert!(points.n_points() == n && taken.is_ok(), "{start}: {taken:?}");
        }
        for (method, optimize) in OPTIMIZERS {
            let mut points = jittered(&space, n, seed).unwrap();
            optimize(&mut points);
            assert_inside(&points, n, &format!("{method} in {space}"));
        }
    }
}

#[test]
fn a_square_is_a_square() {
    let rectangle = Space::from(Rectangle::new([-3.0, 5.0], [2.0, 2.0]).unwrap());
    let square = space(&[vec![[-3.0, 5.0], [-1.0, 5.0], [-1.0, 7.0], [-3.0, 7.0]]]);
    let points = white(&rectangle, 500, 3).unwrap();
    let [of_rectangle, of_square] =
        [rectangle, square].map(|space| measure(&PointSet::new(space, points.positions().to_vec()).unwrap()).unwrap());
    let numbers =
        |m: &Measures| [m.min_distance, m.mean_distance, m.coverage_radius, m.capacity_sd, m.cvt_energy, m.angle_rms_deg, m.bond_order];
    for (a, b) in numbers(&of_rectangle).into_iter().zip(numbers(&of_square)) {
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }
}

#[test]
fn a_maximal_set_is_one_as_far_as_can_be_seen() {
    // Of points on both sides of a wall that is thinner than the spacing one may be missing.
    for (rings, leeway) in [(l_shape(), 1.01), (star(7, 0.3), 1.01), (nested(3), 1.01), (slit(1e-3), 1.2), (comb(4, 0.05), 1.2)] {
        let space = space(&rings);
        let params = PoissonDiskParams { seed: 5, is_visible: true, ..PoissonDiskParams::for_about(&space, 800) };
        let measures = measure(&poisson_disk(&space, &params).unwrap()).unwrap();
        let spacing = params.spacing / measures.hex_spacing;
        let distance = measures.boundary.as_ref().unwrap().min_distance_visible.unwrap();
        assert!(distance >= spacing * (1.0 - 1e-9) && measures.coverage_radius <= leeway * spacing, "{space}: {measures:?}");
    }
}

/// The flag promises that no two points are nearer, whatever stands between them: across a slit, and between parts.
#[test]
fn poisson_disks_keep_their_distance_across_walls() {
    let parcels = vec![rectangle([0.0, 0.0], [100.0, 100.0]), rectangle([102.0, 0.0], [98.0, 100.0])];
    for (rings, spacing) in [(parcels, 8.0), (slit(1e-3), 0.03), (comb(4, 0.05), 0.02), (nested(3), 0.05)] {
        let space = space(&rings);
        let params = PoissonDiskParams { spacing, seed: 2, ..PoissonDiskParams::for_about(&space, 1) };
        let points = poisson_disk(&space, &params).unwrap();
        let p = points.positions();
        let pairs = (0..p.len()).flat_map(|j| (0..j).map(move |i| (p[i][0] - p[j][0]).hypot(p[i][1] - p[j][1])));
        let nearest = pairs.fold(f64::INFINITY, f64::min);
        let measures = measure(&points).unwrap();
        assert!(nearest >= spacing && (measures.min_distance * measures.hex_spacing / nearest - 1.0).abs() < 1e-9, "{space}: {nearest}");
        assert!(measures.boundary.unwrap().min_distance_visible.unwrap() >= measures.min_distance);
        // Each place is covered, by a point that it need not see.
        let white = white(&space, 3000, 1).unwrap();
        let covered = |q: &[f64; 2]| p.iter().any(|p| (p[0] - q[0]).hypot(p[1] - q[1]) <= spacing * (1.0 + 1e-9));
        assert!(white.positions().iter().all(covered), "{space}");
    }
}

#[test]
fn targets_are_reached_and_cells_are_what_is_seen() {
    for rings in [l_shape(), slit(1e-3), nested(2), passage(0.1)] {
        let space = space(&rings);
        for seed in 0..2 {
            let mut points = jittered(&space, 600, seed).unwrap();
            let params = PushPullParams { seed, ..PushPullParams::default() };
            let report = push_pull(&mut points, &params, &mut RunContext::default()).unwrap();
            let measures = measure(&points).unwrap();
            assert_eq!((report.outcome, params.unmet(&measures)), (Outcome::Converged, vec![]), "{space}, {seed}");
            // Behind corners cells overlap by a little, or leave a little out.
            let cells = tessellate(&points).unwrap().cells;
            let area = |cell: &[[f64; 2]]| -> f64 {
                let ends = cell.iter().zip(cell.iter().cycle().skip(1));
                0.5 * ends.map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>()
            };
            let covered: f64 = cells.iter().map(|cell| area(cell)).sum();
            assert!((0.9999..1.01).contains(&(covered / space.area())), "{}", covered / space.area());
        }
    }
}

#[test]
fn nothing_is_seen_across_a_slit() {
    // Two rooms, and a wall as thin as can be: a point on each side of it.
    let rooms = space(&[vec![
        [0.0, 0.0],
        [1.0, 0.0],
        [1.0, 1.0],
        [0.500_001, 1.0],
        [0.500_001, 0.1],
        [0.499_999, 0.1],
        [0.499_999, 1.0],
        [0.0, 1.0],
    ]]);
    let points = PointSet::new(&rooms, vec![[0.49, 0.9], [0.51, 0.9], [0.2, 0.3], [0.8, 0.3]]).unwrap();
    let measures = measure(&points).unwrap();
    let seen = measures.boundary.as_ref().and_then(|boundary| boundary.min_distance_visible).unwrap();
    assert!(seen * measures.hex_spacing > 0.5, "{measures:?}");
    assert!((measures.min_distance * measures.hex_spacing - 0.02).abs() < 1e-9, "{measures:?}");
    let cells = tessellate(&points).unwrap().cells;
    assert!(cells[0].iter().all(|corner| corner[0] <= 0.5 + 1e-9) && cells[1].iter().all(|corner| corner[0] >= 0.5 - 1e-9));
}

#[test]
fn the_number_of_threads_changes_no_bit_in_a_polygon() {
    let space = space(&star(7, 0.3));
    for (method, optimize) in OPTIMIZERS {
        let run = |n_threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().unwrap();
            pool.install(|| {
                let mut points = jittered(&space, 5000, 11).unwrap();
                optimize(&mut points);
                let measures = measure(&points).unwrap();
                (points, measures)
            })
        };
        let one = run(1);
        assert!([2, 3].into_iter().all(|n_threads| run(n_threads) == one), "{method}");
    }
}

#[test]
fn what_lies_outside_is_refused() {
    let space = space(&l_shape());
    for (place, is_inside) in [([0.25, 0.25], true), ([0.75, 0.75], false), ([0.5, 0.5], true), ([0.0, 0.7], true), ([-1e-3, 0.5], false)] {
        assert_eq!(PointSet::new(&space, vec![place]).is_ok(), is_inside, "{place:?}");
    }
}

#[test]
fn edges_of_45_degrees_are_no_worse_than_others() {
    let diamond = space(&[vec![[1.0, 0.0], [2.0, 1.0], [1.0, 2.0], [0.0, 1.0]]]);
    for n in [1, 30, 500] {
        assert_eq!(poisson_disk_of(&diamond, n, 1).unwrap().n_points(), n);
    }
}

#[test]
fn parts_may_lie_far_from_each_other() {
    let square = |x: f64| vec![[x, x], [x + 1.0, x], [x + 1.0, x + 1.0], [x, x + 1.0]];
    for far in [1e3, 1e5, 1e9] {
        let space = space(&[square(0.0), square(far)]);
        for (method, optimize) in OPTIMIZERS {
            let mut points = jittered(&space, 60, 2).unwrap();
            optimize(&mut points);
            assert_inside(&points, 60, method);
        }
        let params = PoissonDiskParams::for_about(&space, 60);
        assert_eq!(poisson_disk(&space, &params).is_ok(), far < 1e4);
    }
}

#[test]
fn a_density_holds_inside() {
    let space = space(&l_shape());
    let density = Density::image(2, 1, &[1.0, 4.0]).unwrap();
    for points in [white_by_density(&space, &density, 400, 1).unwrap(), poisson_disk_of_density(&space, &density, 400, 1).unwrap()] {
        assert_inside(&points, 400, "by density");
        // The right half of the L has a third of its area, and two thirds of its mass.
        let n_right = points.positions().iter().filter(|p| p[0] > 0.5).count();
        assert!((220..310).contains(&n_right), "{n_right}");
    }
    // Its mean is 1 inside, whatever lies outside: cells have their share.
    let outside = Density::function(&space, 64, 64, |p| if p[0] > 0.5 && p[1] > 0.5 { 50.0 } else { 1.0 + p[0] }).unwrap();
    let mut points = eliminate(&white_by_density(&space, &outside, 3000, 1).unwrap(), 600).unwrap();
    let report = push_pull(&mut points, &PushPullParams::preset(PushPullPreset::Fast), &mut RunContext::default()).unwrap();
    let measures = measure(&points).unwrap();
    assert_eq!(report.outcome, Outcome::Converged, "{measures:?}");
    assert!(measures.min_distance > 0.74 && measures.coverage_radius < 0.76, "{measures:?}");
}
