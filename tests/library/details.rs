//! Meshes of polygons with details far below the spacing: no thin triangles but in sharp corners, and no
//! more triangles than details need.

use std::collections::HashSet;

use evenly::{EdgeKind, Mesh, MeshParams, Polygon, RunContext, mesh, mesh_quality};

type Ring = Vec<[f64; 2]>;

fn polygon(rings: Vec<Ring>) -> Polygon {
    Polygon::from_rings(rings).unwrap()
}

fn meshed(polygon: &Polygon, params: &MeshParams) -> Mesh {
    mesh(polygon, params, &mut RunContext::default()).unwrap().0
}

fn square(side: f64) -> Ring {
    vec![[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]]
}

/// The smallest angle of all triangles that do not lie in sharp corners of the polygon.
fn least_deg(mesh: &Mesh) -> f64 {
    (0..mesh.triangles.len() - mesh.n_in_corners).flat_map(|t| mesh.angles_deg(t)).fold(f64::INFINITY, f64::min)
}

fn check(polygon: &Polygon, params: &MeshParams) -> Mesh {
    let mesh = meshed(polygon, params);
    assert!(least_deg(&mesh) >= 25.0, "{:?}: {}", polygon.rings(), least_deg(&mesh));
    let quality = mesh_quality(&mesh);
    assert!((quality.area / polygon.area() - 1.0).abs() < 1e-9);
    // Each side of a triangle has another triangle across, or lies on the boundary.
    let sides: HashSet<[usize; 2]> = mesh.triangles.iter().flat_map(|t| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]]).collect();
    assert_eq!(sides.len(), 3 * mesh.triangles.len());
    let boundary = mesh.edges.iter().filter(|edge| matches!(edge.kind, EdgeKind::Boundary { .. })).map(|edge| edge.ends);
    let open: HashSet<[usize; 2]> = sides.iter().copied().filter(|&[a, b]| !sides.contains(&[b, a])).collect();
    assert_eq!(open, boundary.collect());
    mesh
}

/// A room with a ditch, as wide and as long as told.
fn ditch(width: f64, length: f64) -> Polygon {
    polygon(vec![vec![[0.0, 0.0], [length + 1.0, 0.0], [length + 1.0, 5.0], [length, 5.0], [length, width], [0.0, width]]])
}

#[test]
fn ditches_are_meshed_as_finely_as_they_are_wide_and_no_finer() {
    for (width, length) in [(0.01, 9.0), (0.02, 3.0), (0.05, 20.0)] {
        for seed in 0..6 {
            let mesh = check(&ditch(width, length), &MeshParams { seed, ..MeshParams::new(0.5) });
            let quality = mesh_quality(&mesh);
            assert!(quality.min_edge > 0.3 * width, "{width}, seed {seed}: {}", quality.min_edge);
            let expected = 2.0 * length / width;
            assert!((quality.n_triangles as f64) < 1.1 * expected + 200.0, "{width}, seed {seed}: {}", quality.n_triangles);
        }
    }
}

#[test]
fn details_that_stand_alone_take_few_triangles() {
    let plain = meshed(&polygon(vec![square(10.0)]), &MeshParams::new(1.0)).triangles.len();
    for seed in 0..4 {
        for gap in [0.1, 1e-3, 1e-5] {
            let params = MeshParams { seed, fixed: vec![[5.0, gap]], ..MeshParams::new(1.0) };
            let n = check(&polygon(vec![square(10.0)]), &params).triangles.len() - plain;
            // Some 5 each time that the gap halves.
            assert!((n as f64) < 20.0 + 5.0 * (1.0 / gap).log2(), "{gap}, seed {seed}: {n}");
        }
    }
}

#[test]
fn few_triangles_stand_around_a_lone_point_or_corner() {
    let hole = |tip: f64| vec![[5.0, tip], [4.0, 2.0], [6.0, 2.0]];
    for seed in 0..6 {
        for gap in [1e-2, 1e-4, 1e-5] {
            let at = [4.5 + 0.2 * seed as f64, gap];
            let beside = check(&polygon(vec![square(10.0)]), &MeshParams { seed, fixed: vec![at], ..MeshParams::new(1.0) });
            let below = check(&polygon(vec![square(10.0), hole(gap)]), &MeshParams { seed, ..MeshParams::new(1.0) });
            for (mesh, centre) in [(beside, at), (below, [5.0, gap])] {
                let is_near = |v: usize| (mesh.vertices[v][0] - centre[0]).hypot(mesh.vertices[v][1] - centre[1]) < 1.0;
                let n = mesh.triangles.iter().filter(|t| t.iter().all(|&v| is_near(v))).count();
                assert!(n <= 60, "{gap}, seed {seed}: {n}");
            }
        }
    }
}

#[test]
fn needles_end_at_their_own_width() {
    for (length, width) in [(1000.0, 0.01), (1000.0, 1.0), (100.0, 1e-3), (30.0, 2.0)] {
        let needle = polygon(vec![vec![[0.0, 0.0], [length, 0.0], [length, width]]]);
        let mesh = check(&needle, &MeshParams::new(10.0));
        assert!(mesh.n_in_corners > 0 && mesh.triangles.len() < 1000, "{width}: {}", mesh.triangles.len());
    }
    // Two of them, tip to tip and apart.
    let lens = polygon(vec![vec![[0.0, 0.0], [50.0, -0.01], [100.0, 0.0], [50.0, 0.01]]]);
    check(&lens, &MeshParams::new(1.0));
    let star = polygon(vec![vec![[0.0, 0.0], [100.0, 1.0], [2.0, 2.0], [1.0, 100.0]]]);
    check(&star, &MeshParams::new(1.0));
}

#[test]
fn walls_that_nearly_touch_are_refined_between() {
    let near = MeshParams { lines: vec![vec![[0.0, 0.01], [10.0, 0.01]]], ..MeshParams::new(1.0) };
    check(&polygon(vec![square(10.0)]), &near);
}

#[test]
fn corners_that_nearly_meet_are_welded() {
    let ring = vec![[0.0, 0.0], [10.0, 0.0], [10.0 - 1e-8, 2e-8], [10.0, 10.0], [5.0, 10.0 - 1e-8], [0.0, 10.0]];
    let fine = polygon(vec![ring]);
    let welded = fine.welded(1e-6).unwrap();
    assert_eq!(welded.rings()[0].len(), 5, "{:?}", welded.rings());
    assert!(welded.repairs().last().unwrap().contains("welded"), "{:?}", welded.repairs());
    assert_eq!(welded.welded(1e-6).unwrap(), welded);
    // A corner that all but touches a segment does; what is left are two parts.
    let waist = polygon(vec![vec![[0.0, 0.0], [10.0, 0.0], [10.0, 5.0], [5.0, 1e-9], [0.0, 5.0]]]);
    let parted = waist.welded(1e-6).unwrap();
    assert_eq!(parted.rings().len(), 2, "{:?}", parted.rings());
    check(&parted, &MeshParams::new(1.0));
    let apart = polygon(vec![square(10.0)]);
    assert_eq!(apart.welded(1e-6).unwrap(), apart);
}

/// Bays and capes, as a coast has them.
fn coast(n: usize, roughness: f64, seed: u64) -> Ring {
    let mut state = seed;
    let mut random = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let corner = |k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / n as f64;
        let radius = 1.0 + 0.2 * (3.0 * angle).sin() + roughness * (random() - 0.5);
        [radius * angle.cos(), radius * angle.sin()]
    };
    (0..n).map(corner).collect()
}

fn distance(p: [f64; 2], [a, b]: [[f64; 2]; 2]) -> f64 {
    let (way, to) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let share = ((to[0] * way[0] + to[1] * way[1]) / (way[0] * way[0] + way[1] * way[1])).clamp(0.0, 1.0);
    (to[0] - share * way[0]).hypot(to[1] - share * way[1])
}

#[test]
fn simpler_polygons_keep_their_rings_and_areas() {
    for seed in 0..10 {
        let island = |shift: f64| coast(30, 0.2, seed + 100).iter().map(|[x, y]| [0.05 * x + shift, 0.05 * y + 1.3]).collect::<Ring>();
        let lake = coast(200, 0.05, seed + 50).iter().map(|[x, y]| [0.6 * x, 0.6 * y]).collect::<Ring>();
        let whole = polygon(vec![coast(2000, 0.02, seed), lake, island(0.5), island(-0.5)]);
        for tolerance in [1e-4, 1e-3, 0.01, 0.1] {
            let simple = whole.simplified(tolerance).unwrap();
            let n = |polygon: &Polygon| polygon.rings().iter().map(Vec::len).sum::<usize>();
            assert_eq!(simple.rings().len(), whole.rings().len());
            assert!((simple.area() / whole.area() - 1.0).abs() < 1e-9, "{tolerance}: {} of {}", simple.area(), whole.area());
            assert!(n(&simple) <= n(&whole) && (tolerance < 0.01 || 4 * n(&simple) < n(&whole)), "{tolerance}: {}", n(&simple));
            let sides: Vec<[[f64; 2]; 2]> =
                simple.rings().iter().flat_map(|ring| (0..ring.len()).map(|k| [ring[k], ring[(k + 1) % ring.len()]])).collect();
            let farthest =
                whole.rings().iter().flatten().map(|&p| sides.iter().map(|&side| distance(p, side)).fold(f64::INFINITY, f64::min));
            let farthest = farthest.fold(0.0, f64::max);
            assert!(farthest <= tolerance * (1.0 + 1e-9), "{farthest} of {tolerance}");
        }
        assert!(whole.simplified(0.0).is_err() && whole.simplified(f64::NAN).is_err());
    }
}
