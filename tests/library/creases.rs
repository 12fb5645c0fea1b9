//! Creases, boundaries and corners of surfaces: what is kept, and how good triangles are beside them.

use evenly::{
    Outcome, RemeshParams, Remeshed, Report, RunContext, Surface, SurfaceSizing, TriangleMesh, certificate, remesh, surface_quality,
    surface_sizes,
};

use crate::solids::{cone, cube, cylinder, l_shape, slice};

fn remeshed(surface: &Surface, n_vertices: usize, seed: u64) -> (Remeshed, Report) {
    remesh(surface, &RemeshParams { n_vertices, seed, ..RemeshParams::default() }, &mut RunContext::default()).unwrap()
}

fn square() -> TriangleMesh {
    let vertices = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    TriangleMesh { vertices, triangles: vec![[0, 1, 2], [0, 2, 3]], attributes: Vec::new() }
}

#[test]
fn sharp_corners_leave_no_very_obtuse_triangle_beside_them() {
    for (angle, seed) in [(15.0, 1), (20.0, 2), (25.0, 3), (32.0, 4)] {
        let surface = Surface::new(&slice(angle)).unwrap();
        let (made, _) = remeshed(&surface, 1500, seed);
        let quality = surface_quality(&Surface::new(&made.mesh).unwrap());
        assert!(quality.max_angle_deg < 100.0 && quality.min_angle_deg > angle - 5.0, "{angle}: {quality:?}");
    }
}

#[test]
fn the_tip_of_a_cone_of_many_thin_facets_is_kept_and_not_crowded() {
    let surface = Surface::new(&cone(40)).unwrap();
    for (n, seed) in [(637, 1), (2000, 1), (2000, 2)] {
        let (made, _) = remeshed(&surface, n, seed);
        assert!(made.mesh.vertices.contains(&[0.0, 0.0, 2.0]));
        let quality = surface_quality(&Surface::new(&made.mesh).unwrap());
        assert!(quality.min_angle_deg > 30.0 && quality.max_angle_deg < 92.0, "{quality:?}");
    }
}

#[test]
fn creases_are_kept_where_sizes_vary_whatever_their_units() {
    let surface = Surface::new(&cube(3)).unwrap();
    let sizes = surface_sizes(&surface, &SurfaceSizing::Linear { axis: 2, ratio: 2.0 }, Some(900)).unwrap();
    let area = |unit: f64| {
        let sizes = sizes.iter().map(|size| unit * size).collect();
        let params = RemeshParams { n_vertices: 900, sizes, ..RemeshParams::default() };
        let (made, _) = remesh(&surface, &params, &mut RunContext::default()).unwrap();
        surface_quality(&Surface::new(&made.mesh).unwrap()).area
    };
    for unit in [1.0, 1e-3, 1e300] {
        assert!((area(unit) - 6.0).abs() < 1e-9, "{unit}");
    }
}

/// Three triangles fill the half turn at each point of a straight crease, and only the cube's own right angles miss the bounds: 45 degrees are the best that a half of them has.
#[test]
fn meshes_settle_along_creases_and_at_right_angled_corners() {
    for seed in 0..3 {
        let params = RemeshParams { n_vertices: 2000, seed, ..RemeshParams::default() };
        let made = |mesh: &TriangleMesh| {
            let (remeshed, report) = remesh(&Surface::new(mesh).unwrap(), &params, &mut RunContext::default()).unwrap();
            let quality = surface_quality(&Surface::new(&remeshed.mesh).unwrap());
            (remeshed, report, quality)
        };
        let (remeshed, report, quality) = made(&cube(1));
        assert!(matches!(report.outcome, Outcome::Forced | Outcome::IterationLimit) && quality.obtuse_triangles == 0, "{seed}");
        // Two halves of each right angle; a pair of points with two and four triangles may be left on an edge.
        assert!(quality.min_angle_deg > 44.5 && remeshed.forced.len() == 48, "{seed}: {}", remeshed.forced.len());
        let breaches = certificate(&Surface::new(&remeshed.mesh).unwrap(), 0.7);
        let n_others = breaches.iter().filter(|breach| !remeshed.forced.contains(&breach.triangle)).count();
        assert!(n_others <= 8 && (n_others == 0) == (report.outcome == Outcome::Forced), "{seed}: {n_others}");
        // Nothing is forced where there is no corner.
        let (remeshed, report, quality) = made(&cylinder(48));
        assert_eq!((report.outcome, quality.obtuse_triangles, remeshed.forced.len()), (Outcome::Converged, 0, 0), "{seed}");
        assert!(quality.min_angle_deg > 45.5, "{seed}: {}", quality.min_angle_deg);
    }
}

/// Beside points of a crease with two triangles, or four, vertices are missing, or too many: moves alone leave right angles there.
#[test]
fn vertices_come_to_where_creases_have_too_few() {
    let mut plate = cube(1);
    plate.vertices.iter_mut().for_each(|[x, y, z]| (*x, *y, *z) = (3.0 * *x, 2.0 * *y, 0.3 * *z));
    for (mesh, least) in [(plate, 39.0), (square(), 44.5), (l_shape(), 44.5), (cone(96), 41.0)] {
        let surface = Surface::new(&mesh).unwrap();
        for seed in 0..3 {
            let (made, report) = remeshed(&surface, 2000, seed);
            let made = Surface::new(&made.mesh).unwrap();
            let quality = surface_quality(&made);
            assert_eq!((quality.obtuse_triangles, made.euler_characteristic()), (0, surface.euler_characteristic()), "{seed}");
            assert!(quality.min_angle_deg > least, "{seed}: {}, {:?}", quality.min_angle_deg, report.outcome);
        }
    }
}

/// A tetrahedron's vertices have three neighbours each, and none to spare.
#[test]
fn small_parts_keep_their_vertices() {
    let mut mesh = square();
    mesh.vertices.extend([[2.0, 0.0, 0.0], [2.02, 0.0, 0.0], [2.0, 0.02, 0.0], [2.0, 0.0, 0.02]]);
    mesh.triangles.extend([[4, 6, 5], [4, 5, 7], [5, 6, 7], [6, 4, 7]]);
    let surface = Surface::new(&mesh).unwrap();
    for seed in 0..8 {
        let params = RemeshParams { n_vertices: 300, features_deg: None, seed, ..RemeshParams::default() };
        let (made, _) = remesh(&surface, &params, &mut RunContext::default()).unwrap();
        assert_eq!(made.mesh.vertices.iter().filter(|p| p[0] > 1.5).count(), 4, "{seed}");
        assert_eq!(Surface::new(&made.mesh).unwrap().euler_characteristic(), surface.euler_characteristic(), "{seed}");
    }
}

/// A vertex beside a boundary that is one too many has an edge of the boundary around it.
#[test]
fn vertices_beside_a_boundary_are_spared_too() {
    let vertices = vec![
        [0.78125, 0.03125, 0.28125],
        [0.25, 0.0, 0.3125],
        [0.0, 0.46875, 0.59375],
        [0.71875, 0.96875, 0.9375],
        [0.937500001, 0.28125, 0.3125],
    ];
    let triangles = vec![
        [2, 3, 1],
        [0, 4, 1],
        [4, 3, 2],
        [1, 3, 2],
        [0, 2, 1],
        [0, 1, 3],
        [4, 0, 2],
        [1, 2, 0],
        [1, 3, 2],
        [0, 1, 4],
        [2, 4, 3],
        [3, 0, 1],
    ];
    let surface = Surface::repaired(&TriangleMesh { vertices, triangles, attributes: Vec::new() }).unwrap();
    for n_vertices in [100, 145, 170] {
        let (made, _) = remeshed(&surface, n_vertices, 0);
        let made = Surface::new(&made.mesh).unwrap();
        assert_eq!(made.euler_characteristic(), surface.euler_characteristic(), "{n_vertices}");
    }
}
