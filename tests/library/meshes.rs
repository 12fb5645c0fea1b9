//! Meshes of polygons: they cover them, conform to them, and are as good as promised.

use crate::shapes;

use std::collections::HashMap;

use evenly::{
    CancelToken, DistMeshParams, EdgeKind, Error, LloydParams, LocalMethod, Mesh, MeshEdge, MeshParams, MeshRegion, OptBetaParams, Outcome,
    Polygon, RunContext, mesh, mesh_cells, mesh_quality,
};
use proptest::prelude::*;
use shapes::{Ring, circle, comb, holed_square, l_shape, moved, needle, nested, passage, rectangle, slit, spiral, star};

fn polygon(rings: Vec<Ring>) -> Polygon {
    Polygon::from_rings(rings).unwrap()
}

fn meshed(polygon: &Polygon, params: &MeshParams) -> Mesh {
    mesh(polygon, params, &mut RunContext::default()).unwrap().0
}

fn distance([ax, ay]: [f64; 2], [bx, by]: [f64; 2]) -> f64 {
    (ax - bx).hypot(ay - by)
}

/// That the triangles cover the polygon, upright and edge to edge, and that all of its boundary is there.
fn prove(polygon: &Polygon, mesh: &Mesh) -> Result<(), TestCaseError> {
    let quality = mesh_quality(mesh);
    prop_assert!((quality.area / polygon.area() - 1.0).abs() < 1e-9, "{} of {}", quality.area, polygon.area());
    prop_assert!(quality.min_angle_deg > 0.0, "{}", quality.min_angle_deg);
    let mut directed: HashMap<[usize; 2], usize> = HashMap::new();
    for t in &mesh.triangles {
        for k in 0..3 {
            *directed.entry([t[k], t[(k + 1) % 3]]).or_default() += 1;
        }
    }
    prop_assert!(directed.values().all(|&n| n == 1));
    // A side without another triangle is an edge of the boundary, and the other way round.
    let alone = directed.keys().filter(|&&[a, b]| !directed.contains_key(&[b, a])).count();
    let boundary = || mesh.edges.iter().filter(|edge| matches!(edge.kind, EdgeKind::Boundary { .. }));
    prop_assert_eq!(alone, boundary().count());
    prop_assert!(boundary().all(|edge| directed.contains_key(&edge.ends) && !directed.contains_key(&[edge.ends[1], edge.ends[0]])));
    // Each segment of the boundary is divided from its start to its end.
    let segments: Vec<[[f64; 2]; 2]> =
        polygon.rings().iter().flat_map(|ring| (0..ring.len()).map(|k| [ring[k], ring[(k + 1) % ring.len()]])).collect();
    let mut edges: Vec<Vec<[[f64; 2]; 2]>> = vec![Vec::new(); segments.len()];
    for &MeshEdge { ends, kind } in &mesh.edges {
        if let EdgeKind::Boundary { segment } = kind {
            edges[segment].push(ends.map(|v| mesh.vertices[v]));
        }
    }
    for (segment, edges) in segments.iter().zip(&edges) {
        let length: f64 = edges.iter().map(|[a, b]| distance(*a, *b)).sum();
        let whole = distance(segment[0], segment[1]);
        prop_assert!((length / whole - 1.0).abs() < 1e-6, "{} of {}", length, whole);
        prop_assert!(edges.iter().any(|edge| edge[0] == segment[0]) && edges.iter().any(|edge| edge[1] == segment[1]));
    }
    Ok(())
}

/// Shapes of a kind, from hard to harder.
fn shape(kind: usize, hardness: f64) -> Vec<Ring> {
    let thin = 10f64.powf(-9.0 * hardness);
    match kind {
        0 => star(3 + (40.0 * hardness) as usize, 1.0 - 0.95 * hardness),
        1 => comb(2 + (20.0 * hardness) as usize, 0.05 + 0.9 * (1.0 - hardness)),
        2 => spiral(2.0 + 2.0 * hardness, 0.45 - 0.35 * hardness),
        3 => nested(1 + (8.0 * hardness) as usize),
        4 => needle(thin.max(1e-4)),
        5 => slit(0.1 * thin),
        6 => passage(0.1 * thin.max(1e-4)),
        _ => circle(3 + (400.0 * hardness) as usize),
    }
}

/// All methods; those that go on for so many passes with these.
fn methods(iterations: usize) -> [Option<LocalMethod>; 4] {
    [
        None,
        Some(OptBetaParams { beta: Some(0.75), iterations, ..OptBetaParams::default() }.into()),
        Some(LloydParams { iterations, ..LloydParams::default() }.into()),
        Some(DistMeshParams { iterations, ..DistMeshParams::default() }.into()),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(40) })]
    #[test]
    fn every_polygon_is_covered(
        kind in 0..8usize, hardness in 0.0..1.0f64, turn in 0.0..7.0f64, scale in -6.0..6.0f64, spacing in 0.2..0.9f64, growth in 0.1..1.0f64, seed in 0..1000u64,
        is_non_obtuse in prop::bool::weighted(0.2), method in 0..4usize,
    ) {
        let scale = 10f64.powf(scale);
        let polygon = polygon(moved(&shape(kind, hardness), turn, scale, [3.0 * scale, -2.0 * scale]));
        let method = if is_non_obtuse { None } else { methods(30)[method].clone() };
        let params = MeshParams { growth, seed, is_non_obtuse, method, ..MeshParams::new(spacing * scale) };
        prove(&polygon, &meshed(&polygon, &params))?;
    }
}

#[test]
fn plain_domains_have_well_spaced_points_up_to_the_boundary() {
    for rings in [l_shape(), holed_square()] {
        for spacing in [0.0404, 0.0202] {
            for seed in 0..3 {
                let (mesh, report) =
                    mesh(&polygon(rings.clone()), &MeshParams { seed, ..MeshParams::new(spacing) }, &mut RunContext::default()).unwrap();
                let quality = mesh_quality(&mesh);
                assert_eq!(report.outcome, Outcome::Converged);
                assert!(quality.beta <= 0.757, "{}", quality.beta);
                assert!(quality.min_angle_deg >= 41.0 && quality.max_angle_deg <= 97.0, "{quality:?}");
            }
        }
    }
}

#[test]
fn every_method_makes_meshes_that_are_better_than_the_papers() {
    // Opt-beta's Table 1 ends at a beta of .988 and .932, and angles of 32 to 110 degrees.
    for rings in [l_shape(), holed_square()] {
        for (spacing, ratio) in [(0.0404, 0.988), (0.0202, 0.932)] {
            for method in methods(200) {
                let params = MeshParams { method: method.clone(), seed: 3, ..MeshParams::new(spacing) };
                let polygon = polygon(rings.clone());
                let mesh = meshed(&polygon, &params);
                prove(&polygon, &mesh).unwrap();
                let quality = mesh_quality(&mesh);
                assert!(quality.min_angle_deg >= 35.0 && quality.max_angle_deg <= 110.0, "{method:?}: {quality:?}");
                assert!(quality.beta <= ratio || method.as_ref().is_none_or(|method| method.method().name() != "opt-beta"), "{quality:?}");
            }
        }
    }
}

#[test]
fn spacings_that_vary_are_kept_by_lloyds_method_and_by_springs() {
    let square = polygon(vec![rectangle([0.0, 0.0], [1.0, 1.0])]);
    let wanted = |[x, _]: [f64; 2]| 0.01 + 0.09 * x;
    let [_, _, lloyd, springs] = methods(100);
    for method in [lloyd, springs] {
        let mesh = meshed(&square, &MeshParams { wanted: Some(&wanted), method, ..MeshParams::new(0.1) });
        let n_left = mesh.vertices.iter().filter(|p| p[0] < 0.2).count();
        let n_right = mesh.vertices.iter().filter(|p| p[0] > 0.8).count();
        assert!(n_left > 10 * n_right && mesh_quality(&mesh).min_angle_deg > 30.0, "{n_left} {n_right}");
    }
}

#[test]
fn no_triangle_is_obtuse_where_none_shall_be() {
    for rings in [l_shape(), holed_square()] {
        for spacing in [0.0404, 0.0202] {
            for seed in 0..3 {
                let params = MeshParams { seed, is_non_obtuse: true, ..MeshParams::new(spacing) };
                let (mesh, report) = mesh(&polygon(rings.clone()), &params, &mut RunContext::default()).unwrap();
                let quality = mesh_quality(&mesh);
                assert_eq!((report.outcome, quality.obtuse_triangles), (Outcome::Converged, 0), "{quality:?}");
            }
        }
    }
}

#[test]
fn no_triangle_is_obtuse_along_finely_divided_holes() {
    for n_corners in [64, 128, 300] {
        let hole = circle(n_corners)[0].iter().map(|[x, y]| [0.4 * x, 0.4 * y]).rev().collect();
        let polygon = polygon(vec![rectangle([-1.0, -1.0], [2.0, 2.0]), hole]);
        for seed in 0..2 {
            let params = MeshParams { seed, is_non_obtuse: true, ..MeshParams::new(0.12) };
            let mesh = meshed(&polygon, &params);
            prove(&polygon, &mesh).unwrap();
            assert_eq!(mesh_quality(&mesh).obtuse_triangles, 0, "{n_corners}");
        }
    }
}

#[test]
fn detailed_boundaries_are_followed_with_good_angles() {
    for (rings, least) in [(circle(1000), 35.0), (comb(10, 0.4), 32.0), (passage(1e-3), 25.0), (slit(1e-9), 41.0)] {
        let polygon = polygon(rings);
        let mesh = meshed(&polygon, &MeshParams::new(0.05));
        prove(&polygon, &mesh).unwrap();
        let quality = mesh_quality(&mesh);
        assert!(quality.min_angle_deg > least, "{quality:?}");
    }
}

#[test]
fn only_tips_are_sharper_than_25_degrees() {
    let polygon = polygon(star(7, 0.3));
    let mesh = meshed(&polygon, &MeshParams::new(0.05));
    let n_sharp =
        mesh.triangles.iter().filter(|t| mesh_quality(&Mesh { triangles: vec![**t], ..mesh.clone() }).min_angle_deg < 25.0).count();
    assert_eq!(n_sharp, 7);
}

/// Ten times as fine in one spot: whatever the method, edges are as long as was asked for, everywhere.
#[test]
fn every_method_keeps_the_wanted_lengths() {
    let square = Polygon::from_rings(vec![rectangle([0.0, 0.0], [1.0, 1.0])]).unwrap();
    let wanted = |p: [f64; 2]| (0.0025 + 0.1 * (p[0] - 0.5).hypot(p[1] - 0.5)).min(0.025);
    for method in methods(300) {
        let params =
            MeshParams { method: method.clone(), max_edge_length: Some(0.025), wanted: Some(&wanted), seed: 2, ..MeshParams::new(0.025) };
        let (mesh, _) = mesh(&square, &params, &mut RunContext::default()).unwrap();
        let mut by_size = [(0.0, 0.0); 5];
        for t in &mesh.triangles {
            for [a, b] in [0, 1, 2].map(|k| [t[k], t[(k + 1) % 3]]) {
                let (p, q) = (mesh.vertices[a], mesh.vertices[b]);
                let size = 0.5 * (wanted(p) + wanted(q));
                let ratio = (p[0] - q[0]).hypot(p[1] - q[1]) / size;
                assert!((0.5..2.0).contains(&ratio), "{method:?}: {ratio} at {p:?}");
                let (sum, n) = &mut by_size[((size / 0.0025).log10() * 4.99) as usize];
                (*sum, *n) = (*sum + ratio, *n + 1.0);
            }
        }
        assert!(by_size.iter().all(|(sum, n)| (0.9..1.1).contains(&(sum / n))), "{method:?}: {by_size:?}");
        let errors = mesh_quality(&mesh).size_errors.unwrap();
        assert!((0.98..1.08).contains(&errors.size_ratio_mean) && errors.size_ratio_min > 0.5 && errors.size_ratio_max < 2.0, "{errors:?}");
    }
}

#[test]
fn a_large_boundary_is_meshed() {
    let polygon = polygon(star(5000, 0.999));
    let mesh = meshed(&polygon, &MeshParams { growth: 1.0, ..MeshParams::new(0.5) });
    prove(&polygon, &mesh).unwrap();
}

#[test]
fn fixed_points_are_vertices_and_lines_are_edges() {
    let polygon = polygon(l_shape());
    let line = vec![[0.0, 0.25], [0.3, 0.3], [0.7, 0.2], [0.25, 0.77]];
    let params = MeshParams { fixed: vec![[0.2, 0.1], [0.123, 0.9]], lines: vec![line.clone()], ..MeshParams::new(0.05) };
    let mesh = meshed(&polygon, &params);
    prove(&polygon, &mesh).unwrap();
    for point in params.fixed.iter().chain(&line) {
        assert!(mesh.vertices.contains(point), "{point:?}");
    }
    let length: f64 = mesh
        .edges
        .iter()
        .filter(|edge| edge.kind == EdgeKind::Line { line: 0 })
        .map(|edge| distance(mesh.vertices[edge.ends[0]], mesh.vertices[edge.ends[1]]))
        .sum();
    let wanted: f64 = line.windows(2).map(|ends| distance(ends[0], ends[1])).sum();
    assert!((length / wanted - 1.0).abs() < 1e-9, "{length} {wanted}");
    assert!(mesh_quality(&mesh).min_angle_deg > 25.0);
}

#[test]
fn lines_may_overlap_and_touch() {
    let polygon = polygon(vec![vec![[0.0, 0.0], [1.0, 0.0], [0.5, 1.0]]]);
    let lines =
        vec![vec![[0.1, 0.1], [0.3, 0.3]], vec![[0.0, 0.0], [0.5, 0.5]], vec![[0.0, 0.0], [1.0, 0.0]], vec![[0.3, 0.3], [0.3, 0.3]]];
    let fixed = vec![[0.0, 0.0], [0.5, 0.0], [0.25, 0.25], [0.25, 0.25]];
    let mesh = meshed(&polygon, &MeshParams { lines, fixed, ..MeshParams::new(0.05) });
    prove(&polygon, &mesh).unwrap();
    let is_diagonal = |&[x, y]: &[f64; 2]| (x - y).abs() < 1e-9 && x < 0.5 + 1e-9;
    let length: f64 = mesh
        .edges
        .iter()
        .map(|edge| edge.ends.map(|v| mesh.vertices[v]))
        .filter(|ends| ends.iter().all(is_diagonal))
        .map(|[a, b]| distance(a, b))
        .sum();
    assert!((length - 0.5f64.sqrt()).abs() < 1e-9, "{length}");
    assert!(mesh_quality(&mesh).min_angle_deg > 17.0, "{:?}", mesh_quality(&mesh));
}

#[test]
fn lines_are_split_where_they_cross_and_clipped_at_the_boundary() {
    let polygon = polygon(l_shape());
    // A cross, a ring, one across the notch, one from far outside, and one that is outside.
    let lines = vec![
        vec![[0.1, 0.2], [0.9, 0.3]],
        vec![[0.4, 0.05], [0.2, 0.45]],
        vec![[0.1, 0.6], [0.4, 0.6], [0.4, 0.9], [0.1, 0.9], [0.1, 0.6]],
        vec![[0.9, 0.4], [0.4, 0.95]],
        vec![[-1e6, 0.5], [0.3, 0.5]],
        vec![[2.0, 2.0], [3.0, 3.0]],
    ];
    let inside = [0.8f64.hypot(0.1), 0.2f64.hypot(0.4), 1.2, 0.0, 0.3];
    let (mesh, report) = mesh(&polygon, &MeshParams { lines: lines.clone(), ..MeshParams::new(0.05) }, &mut RunContext::default()).unwrap();
    prove(&polygon, &mesh).unwrap();
    for (line, expected) in inside.into_iter().enumerate() {
        let edges = mesh.edges.iter().filter(|edge| edge.kind == EdgeKind::Line { line });
        let length: f64 = edges.map(|edge| edge.ends.map(|v| mesh.vertices[v])).map(|[a, b]| distance(a, b)).sum();
        assert!(line == 3 || (length - expected).abs() < 1e-9, "line {line}: {length}, expected {expected}");
        assert!(length > 0.05);
    }
    assert!(report.notes.iter().any(|note| note.starts_with("1 of 6 lines lie outside")), "{:?}", report.notes);
    assert!(mesh_quality(&mesh).min_angle_deg > 25.0);
}

#[test]
fn many_lines_are_no_trouble() {
    let square = polygon(vec![rectangle([0.0, 0.0], [1.0, 1.0])]);
    let line = |k: usize| {
        let x = (k as f64 + 0.5) / 30.0;
        if k.is_multiple_of(2) { vec![[x, -1.0], [x, 2.0]] } else { vec![[-1.0, x], [2.0, x]] }
    };
    let mesh = meshed(&square, &MeshParams { lines: (0..30).map(line).collect(), ..MeshParams::new(0.05) });
    prove(&square, &mesh).unwrap();
    assert!(mesh_quality(&mesh).min_angle_deg > 25.0);
}

#[test]
fn the_spacing_may_grow_away_from_the_boundary_or_be_given() {
    let square = polygon(vec![rectangle([0.0, 0.0], [1.0, 1.0])]);
    let even = meshed(&square, &MeshParams::new(0.02));
    let graded = meshed(&square, &MeshParams { max_edge_length: Some(0.2), growth: 0.2, ..MeshParams::new(0.02) });
    assert!(graded.vertices.len() * 3 < even.vertices.len(), "{} {}", graded.vertices.len(), even.vertices.len());
    assert!(mesh_quality(&graded).min_angle_deg > 33.0);
    let [even, graded] =
        [None, Some(2.0)].map(|largest| meshed(&square, &MeshParams { max_edge_length: largest, growth: 1.0, ..MeshParams::new(0.1) }));
    assert!(graded.vertices.len() + 20 < even.vertices.len(), "{} {}", graded.vertices.len(), even.vertices.len());
    let wanted = |[x, _]: [f64; 2]| 0.01 + 0.09 * x;
    let given = meshed(&square, &MeshParams { wanted: Some(&wanted), ..MeshParams::new(0.1) });
    let n_left = given.vertices.iter().filter(|p| p[0] < 0.2).count();
    let n_right = given.vertices.iter().filter(|p| p[0] > 0.8).count();
    assert!(n_left > 10 * n_right && mesh_quality(&given).min_angle_deg > 33.0, "{n_left} {n_right}");
}

#[test]
fn the_cells_of_all_vertices_cover_the_domain() {
    let area = |cell: &Vec<[f64; 2]>| -> f64 {
        let ways = cell.iter().map(|p| [p[0] - cell[0][0], p[1] - cell[0][1]]);
        let sides = ways.clone().zip(ways.cycle().skip(1));
        0.5 * sides.map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>()
    };
    let far = moved(&holed_square(), 0.3, 1.0, [1e6, -3e6]);
    for rings in [l_shape(), holed_square(), circle(40), far] {
        let polygon = polygon(rings);
        let cells = mesh_cells(&meshed(&polygon, &MeshParams::new(0.05)));
        let covered: f64 = cells.iter().map(area).sum();
        assert!((covered / polygon.area() - 1.0).abs() < 1e-9, "{covered} of {}", polygon.area());
        assert!(cells.iter().all(|cell| area(cell) > 0.0));
    }
}

#[test]
fn an_interrupted_mesh_is_one_all_the_same() {
    let polygon = polygon(star(9, 0.6));
    let cancel = CancelToken::default();
    cancel.cancel();
    let mut context = RunContext::default().with_cancel(cancel);
    let (mesh, report) = mesh(&polygon, &MeshParams::new(0.03), &mut context).unwrap();
    assert_eq!((report.outcome, report.iterations), (Outcome::Cancelled, 0));
    prove(&polygon, &mesh).unwrap();
}

#[test]
fn the_same_seed_gives_the_same_mesh_on_any_threads() {
    let polygon = polygon(star(9, 0.6));
    let run = |n_threads: usize, seed: u64| {
        let pool = rayon_pool(n_threads);
        pool.install(|| meshed(&polygon, &MeshParams { seed, ..MeshParams::new(0.03) }))
    };
    assert_eq!(run(1, 4), run(3, 4));
    assert_ne!(run(1, 4), run(1, 5));
}

fn rayon_pool(n_threads: usize) -> rayon::ThreadPool {
    rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().unwrap()
}

fn error(rings: Vec<Ring>) -> String {
    Polygon::from_rings(rings).unwrap_err().to_string()
}

#[test]
fn what_is_clean_stays_as_it_is() {
    assert_eq!(polygon(l_shape()).rings(), l_shape());
    for rings in [l_shape(), holed_square(), star(9, 0.4), nested(5), comb(6, 0.3), slit(1e-6)] {
        let once = polygon(rings);
        let twice = polygon(once.rings().to_vec());
        assert_eq!((twice.rings(), twice.area(), twice.repairs().len()), (once.rings(), once.area(), 0));
    }
}

#[test]
fn what_leaves_in_doubt_is_an_error_with_its_place() {
    assert!(error(vec![vec![[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]]).contains("encloses nothing"));
    assert!(error(vec![vec![[0.0, 0.0], [1.0, f64::NAN], [2.0, 2.0]]]).contains("not finite"));
    let apart = vec![vec![rectangle([0.0, 0.0], [1.0, 1.0]), rectangle([2.0, 2.0], [1.0, 1.0])]];
    assert!(Polygon::new(apart).unwrap_err().to_string().contains("a hole that lies outside"));
    assert!(matches!(Polygon::from_rings(Vec::new()), Err(Error::InvalidSpace(_))));
}

#[test]
fn what_can_be_repaired_is_and_is_told() {
    // A hole that runs the wrong way, a spike, doubled points.
    let outer = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 0.0], [4.0, 4.0], [6.0, 6.0], [4.0, 4.0], [0.0, 4.0], [0.0, 0.0]];
    let repaired = Polygon::new(vec![vec![outer, rectangle([1.0, 1.0], [1.0, 1.0])]]).unwrap();
    assert_eq!(repaired.area(), 15.0);
    let told = repaired.repairs().join("; ");
    assert!(told.contains("spike") && told.contains("twice") && told.contains("wrong way"), "{told}");
    // Two parts that share a side are one; holes may touch the boundary in a point.
    let parts = vec![vec![rectangle([0.0, 0.0], [1.0, 1.0])], vec![rectangle([1.0, 0.0], [1.0, 1.0])]];
    let joined = Polygon::new(parts).unwrap();
    assert_eq!((joined.area(), joined.rings().len()), (2.0, 1));
    let touching = vec![rectangle([0.0, 0.0], [2.0, 2.0]), vec![[1.0, 0.0], [1.5, 1.0], [0.5, 1.0]]];
    let polygon = polygon(touching);
    prove(&polygon, &meshed(&polygon, &MeshParams::new(0.1))).unwrap();
    // What rounding has made cross is cut.
    let crossing = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.5, 1.0], [0.5, 1.001], [0.501, 0.999], [0.0, 1.0]];
    let cut = Polygon::from_rings(vec![crossing]).unwrap();
    assert!(cut.repairs().join("; ").contains("crosses itself in 1 place"), "{:?}", cut.repairs());
}

#[test]
fn parts_that_touch_in_sharp_corners_share_the_vertex() {
    let right = vec![[0.0, 0.0], [10.0, 1.0], [10.0, -1.0]];
    let polygon = polygon(vec![right.iter().map(|[x, y]| [-x, *y]).collect(), right]);
    let mesh = meshed(&polygon, &MeshParams::new(1.0));
    prove(&polygon, &mesh).unwrap();
    assert_eq!(mesh.vertices.iter().filter(|p| **p == [0.0, 0.0]).count(), 1);
}

#[test]
fn what_lies_outside_is_refused() {
    let polygon = polygon(l_shape());
    let refused = |params: &MeshParams| mesh(&polygon, params, &mut RunContext::default()).map(|_| ()).unwrap_err().to_string();
    assert!(refused(&MeshParams { fixed: vec![[0.9, 0.9]], ..MeshParams::new(0.1) }).contains("does not hold"));
    assert!(refused(&MeshParams { fixed: vec![[9.0, 9.0]], ..MeshParams::new(0.1) }).contains("does not hold"));
    assert!(refused(&MeshParams { lines: vec![vec![[1.0, 0.5], [0.5, 1.0]]], ..MeshParams::new(0.1) }).contains("does not hold"));
    assert!(refused(&MeshParams::new(1e-300)).contains("too many"));
    assert!(refused(&MeshParams::new(0.0)).contains("edge_length"));
    assert!(refused(&MeshParams::new(1e-7)).contains("too many"));
}

#[test]
fn regions_are_kept_apart_and_the_first_has_the_place() {
    let square = |low: [f64; 2], size: [f64; 2]| polygon(vec![rectangle(low, size)]);
    let parts =
        [square([0.0, 0.0], [0.5, 1.0]), square([0.5, 0.0], [0.5, 1.0]), square([0.4, 0.4], [0.2, 0.2]), square([0.9, 0.9], [0.3, 0.2])];
    let whole = Polygon::new(parts.iter().map(|part| part.rings().to_vec()).collect()).unwrap();
    let regions: Vec<MeshRegion> =
        (0..).zip(parts).map(|(k, polygon): (usize, Polygon)| MeshRegion { name: format!("part {k}"), polygon }).collect();
    let mesh = meshed(&whole, &MeshParams { regions, ..MeshParams::new(0.05) });
    prove(&whole, &mesh).unwrap();
    let mut areas = [0.0; 4];
    for (t, &region) in mesh.triangles.iter().zip(&mesh.regions) {
        let [a, b, c] = t.map(|v| mesh.vertices[v]);
        areas[region as usize] += 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
    }
    for (area, expected) in areas.into_iter().zip([0.5, 0.5, 0.0, 0.05]) {
        assert!((area - expected).abs() < 1e-9, "{areas:?}");
    }
    // Between the first two, and around what the last adds within the second.
    let between = mesh.edges.iter().filter(|edge| edge.kind == EdgeKind::Between).map(|edge| edge.ends.map(|v| mesh.vertices[v]));
    let length: f64 = between.map(|[a, b]| distance(a, b)).sum();
    assert!((length - 1.2).abs() < 1e-9, "{length}");
}
