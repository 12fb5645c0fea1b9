//! Laws of surfaces: what is kept, what is certified, what is refused.

use crate::solids;

use std::collections::HashSet;

use evenly::{
    DistMeshParams, Error, LloydParams, LocalMethod, Method, OptBetaParams, Outcome, RemeshParams, Remeshed, Report, RunContext,
    SampleParams, Settings, Surface, SurfacePoint, SurfaceSampling, SurfaceSizing, TriangleMesh, WellSpacedParams, certificate, remesh,
    sample_surface, self_intersections, surface_distance, surface_quality, surface_sizes,
};
use proptest::prelude::*;

use solids::{cone, cube, genus_3, l_shape, moebius, needle, patch, sheet, sphere, torus, touching_spheres};

fn remeshed(surface: &Surface, n_points: usize, seed: u64) -> (Remeshed, Report) {
    remesh(surface, &RemeshParams { n_vertices: n_points, seed, ..RemeshParams::default() }, &mut RunContext::default()).unwrap()
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
}

/// All shapes, with a name and a number of vertices that suits them.
fn all() -> Vec<(&'static str, TriangleMesh, usize)> {
    vec![
        ("sphere", sphere(24), 1000),
        ("torus", torus(40, 20), 1200),
        ("genus 3", genus_3(), 2500),
        ("cube", cube(1), 700),
        ("L", l_shape(), 900),
        ("needle", needle(), 400),
        ("sheet", sheet(), 1500),
        ("cone", cone(24), 600),
        ("two spheres", touching_spheres(), 1400),
        ("patch", patch(20), 500),
    ]
}

#[test]
fn a_new_mesh_has_exactly_n_vertices_and_the_surfaces_topology() {
    for (name, mesh, n) in all() {
        let surface = Surface::new(&mesh).unwrap();
        for (n, seed) in [(n, 1), (n + 37, 2)] {
            let (made, report) = remeshed(&surface, n, seed);
            let made = Surface::new(&made.mesh).unwrap();
            assert_eq!(made.n_vertices(), n, "{name}");
            assert_eq!(made.euler_characteristic(), surface.euler_characteristic(), "{name}");
            assert_eq!(made.n_components(), surface.n_components(), "{name}");
            assert_eq!(made.is_closed(), surface.is_closed(), "{name}");
            // Converged is a promise about the triangles as they are.
            if report.outcome == Outcome::Converged {
                assert_eq!(certificate(&made, 0.63 / 0.90), [], "{name}, {n}");
                assert_eq!(surface_quality(&made).obtuse_triangles, 0, "{name}, {n}");
            }
            let farthest = surface_distance(&made, &surface).hausdorff;
            let spacing = surface_quality(&made).spacing / surface.diagonal();
            assert!(farthest < 0.8 * spacing, "{name}, {n}: {farthest} of {spacing}");
        }
    }
}

#[test]
fn smooth_closed_shapes_converge_to_what_the_paper_has() {
    for (name, mesh, n) in [("sphere", sphere(24), 2000), ("torus", torus(60, 24), 2000)] {
        let surface = Surface::new(&mesh).unwrap();
        for seed in 0..3 {
            let (made, report) = remeshed(&surface, n, seed);
            assert_eq!(report.outcome, Outcome::Converged, "{name}, {seed}");
            let quality = surface_quality(&Surface::new(&made.mesh).unwrap());
            assert!(quality.min_angle_deg > 45.5 && quality.max_angle_deg < 88.9, "{name}: {quality:?}");
            assert!(quality.min_quality > 0.72 && quality.valence_567_fraction > 0.999, "{name}: {quality:?}");
            assert_eq!(self_intersections(&Surface::new(&made.mesh).unwrap()), [] as [[usize; 2]; 0]);
        }
    }
}

#[test]
fn creases_corners_and_boundaries_are_kept() {
    // Of a cube each edge has vertices, and the corners are among them.
    let surface = Surface::new(&cube(3)).unwrap();
    let (made, _) = remeshed(&surface, 900, 5);
    let n_on = |p: &[f64; 3]| p.iter().filter(|&&x| x.abs() < 1e-9 || (x - 1.0).abs() < 1e-9).count();
    let counts = [1, 2, 3].map(|k| made.mesh.vertices.iter().filter(|p| n_on(p) >= k).count());
    assert_eq!(counts[0], 900, "all vertices lie on the sides");
    assert!(counts[1] >= 8 + 12 * 8, "{counts:?}");
    assert_eq!(counts[2], 8);
    let quality = surface_quality(&Surface::new(&made.mesh).unwrap());
    assert!((quality.area - 6.0).abs() < 1e-9, "{}", quality.area);

    // Of a patch the boundary.
    let mesh = patch(20);
    let surface = Surface::new(&mesh).unwrap();
    let (made, _) = remeshed(&surface, 500, 5);
    let is_on_boundary = |p: &[f64; 3]| p[..2].iter().any(|&x| x.abs() < 1e-9 || (x - 1.0).abs() < 1e-9);
    let n_boundary = made.mesh.vertices.iter().filter(|p| is_on_boundary(p)).count();
    assert_eq!(n_boundary, Surface::new(&made.mesh).unwrap().n_boundary_edges());
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let surface = Surface::new(&torus(30, 12)).unwrap();
    let run = |n_threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().unwrap();
        pool.install(|| remeshed(&surface, 5000, 3).0)
    };
    let one = run(1);
    assert!([2, 3].into_iter().all(|n_threads| run(n_threads) == one));
}

#[test]
fn every_method_runs_and_keeps_the_number() {
    let surface = Surface::new(&sphere(16)).unwrap();
    let quality = |method: LocalMethod| {
        let params = RemeshParams { n_vertices: 500, method, ..RemeshParams::default() };
        let (made, _) = remesh(&surface, &params, &mut RunContext::default()).unwrap();
        assert_eq!(made.mesh.vertices.len(), 500);
        surface_quality(&Surface::new(&made.mesh).unwrap())
    };
    assert!(quality(WellSpacedParams::default().into()).beta <= 0.75 + 1e-9);
    assert!(quality(LloydParams::default().into()).mean_quality > 0.9);
    assert!(quality(OptBetaParams { beta: Some(0.8), iterations: 200, ..OptBetaParams::default() }.into()).beta < 0.9);
    assert!(quality(DistMeshParams::default().into()).mean_quality > 0.85);
}

/// A sphere with edges 21 times as long at one end as at the other: they stay so, whatever the method.
#[test]
fn every_method_keeps_the_wanted_lengths() {
    let surface = Surface::new(&sphere(48)).unwrap();
    let sizes = surface_sizes(&surface, &SurfaceSizing::Linear { axis: 2, ratio: 21.0 }, Some(1000)).unwrap();
    let finest = sizes.iter().copied().fold(f64::INFINITY, f64::min);
    for method in [
        RemeshParams::default().method,
        WellSpacedParams::default().into(),
        OptBetaParams { beta: Some(0.6), iterations: 300, ..OptBetaParams::default() }.into(),
        LloydParams { iterations: 300, ..LloydParams::default() }.into(),
        DistMeshParams::default().into(),
    ] {
        let params = RemeshParams { n_vertices: 1000, method: method.clone(), sizes: sizes.clone(), ..RemeshParams::default() };
        let (made, _) = remesh(&surface, &params, &mut RunContext::default()).unwrap();
        let mut by_size = [(0.0, 0.0); 6];
        for t in &made.mesh.triangles {
            for ends in [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]] {
                let [p, q] = ends.map(|v| made.mesh.vertices[v]);
                let size = finest * (1.0 + 5.0 * (p[2] + q[2] + 2.0));
                let ratio = (0..3).map(|k| (p[k] - q[k]).powi(2)).sum::<f64>().sqrt() / size;
                assert!((0.5..2.0).contains(&ratio), "{method:?}: {ratio} at {p:?}");
                let (sum, n) = &mut by_size[((size / finest).ln() / 21f64.ln() * 5.99) as usize];
                (*sum, *n) = (*sum + ratio, *n + 1.0);
            }
        }
        assert!(by_size.iter().all(|(sum, n)| (0.9..1.1).contains(&(sum / n))), "{method:?}: {by_size:?}");
        let errors = surface_quality(&Surface::new(&made.mesh).unwrap()).size_errors.unwrap();
        assert!((errors.size_ratio_mean - 1.0).abs() < 0.1 && errors.size_ratio_max < 2.0, "{method:?}: {errors:?}");
    }
}

/// Vertices stay where they begin.
fn staying() -> LocalMethod {
    Method::named("eliminate").unwrap().on_meshes(&Settings::default(), 0).unwrap()
}

fn sampled(sampling: SurfaceSampling, seed: u64) -> SampleParams {
    SampleParams { sampling, sizes: Vec::new(), seed }
}

fn positions(surface: &Surface, sampling: SurfaceSampling, seed: u64) -> Vec<[f64; 3]> {
    let (points, _) = sample_surface(surface, &sampled(sampling, seed), &mut RunContext::default()).unwrap();
    points.into_iter().map(|point| point.position).collect()
}

#[test]
fn a_mesh_of_given_points_has_these_vertices() {
    for (name, mesh, n) in all() {
        let surface = Surface::new(&mesh).unwrap();
        for (n, seed) in [(n, 1), (2 * n, 2)] {
            let points = positions(&surface, SurfaceSampling::White(n), seed);
            let method = staying();
            let params = RemeshParams { n_vertices: n, method, points, seed, features_deg: None, ..RemeshParams::default() };
            let (made, _) = remesh(&surface, &params, &mut RunContext::default()).unwrap();
            let bits = |p: &[f64; 3]| p.map(f64::to_bits);
            let given: HashSet<[u64; 3]> = params.points.iter().map(bits).collect();
            let n_own = made.mesh.vertices.iter().filter(|p| params.points.iter().all(|q| distance(**p, *q) > 1e-12)).count();
            let made = Surface::new(&made.mesh).unwrap();
            assert_eq!((made.n_vertices(), given.len()), (n, n), "{name}");
            assert_eq!(made.euler_characteristic(), surface.euler_characteristic(), "{name}");
            assert_eq!(made.n_components(), surface.n_components(), "{name}");
            // A boundary has its own, and some are in the way where the points are too sparse for the shape.
            let most = if made.is_closed() { n / 20 } else { n / 4 };
            assert!(n_own <= most, "{name}: {n_own} of {n}");
        }
    }
}

#[test]
fn given_points_are_a_start_as_good_as_another() {
    let surface = Surface::new(&torus(40, 20)).unwrap();
    let start = positions(&surface, SurfaceSampling::White(1500), 4);
    for n_points in [1200, 1500] {
        let params = RemeshParams { n_vertices: n_points, points: start.clone(), ..RemeshParams::default() };
        let (made, report) = remesh(&surface, &params, &mut RunContext::default()).unwrap();
        assert_eq!((report.outcome, made.mesh.vertices.len()), (Outcome::Converged, n_points));
        assert_eq!(surface_quality(&Surface::new(&made.mesh).unwrap()).obtuse_triangles, 0);
    }
    // On a boundary the given points stay, whatever their gaps.
    let square = Surface::new(&patch(1)).unwrap();
    let grid: Vec<[f64; 3]> = (0..121).map(|k| [f64::from(k / 11) / 10.0, f64::from(k % 11) / 10.0, 0.0]).collect();
    let params = RemeshParams { n_vertices: 121, method: staying(), points: grid, ..RemeshParams::default() };
    let (made, _) = remesh(&square, &params, &mut RunContext::default()).unwrap();
    assert!(made.mesh.vertices.iter().all(|p| params.points.iter().any(|q| distance(*p, *q) < 1e-12)));
    assert!((surface_quality(&Surface::new(&made.mesh).unwrap()).min_angle_deg - 45.0).abs() < 1e-6);
    // A mesh's own vertices make it again, also with creases.
    for mesh in [torus(40, 20), cube(2)] {
        let surface = Surface::new(&mesh).unwrap();
        let (first, _) = remeshed(&surface, 900, 3);
        let params = RemeshParams { n_vertices: 900, method: staying(), points: first.mesh.vertices.clone(), ..RemeshParams::default() };
        let (again, _) = remesh(&surface, &params, &mut RunContext::default()).unwrap();
        for p in &again.mesh.vertices {
            assert!(first.mesh.vertices.iter().any(|q| distance(*p, *q) < 1e-9), "{p:?}");
        }
    }
    let refused = |start: Vec<[f64; 3]>| {
        let params = RemeshParams { n_vertices: start.len().max(10), points: start, ..RemeshParams::default() };
        remesh(&surface, &params, &mut RunContext::default()).unwrap_err().to_string()
    };
    assert!(refused(vec![[1.0, 0.0, 0.0]; 9]).contains("at least as many"));
    assert!(refused([vec![[f64::NAN; 3]], start.clone()].concat()).contains("finite"));
    assert!(refused([vec![start[7]], start.clone()].concat()).contains("points 0 and 8"));
}

#[test]
fn sizes_vary_and_angles_stay_certified() {
    let surface = Surface::new(&torus(60, 24)).unwrap();
    for sizing in [SurfaceSizing::Curvature { error: None }, SurfaceSizing::FeatureSize, SurfaceSizing::Linear { axis: 0, ratio: 3.0 }] {
        let sizes = surface_sizes(&surface, &sizing, Some(1500)).unwrap();
        let params = RemeshParams { n_vertices: 1500, sizes, ..RemeshParams::default() };
        let (made, report) = remesh(&surface, &params, &mut RunContext::default()).unwrap();
        let made = Surface::new(&made.mesh).unwrap();
        assert_eq!(made.n_vertices(), 1500);
        let quality = surface_quality(&made);
        assert!(quality.min_angle_deg > 40.0 && quality.max_angle_deg < 95.0, "{sizing:?}: {quality:?}");
        if report.outcome == Outcome::Converged {
            assert_eq!(certificate(&made, 0.63 / 0.90), [], "{sizing:?}");
        }
        // Of a torus the largest curvature and the feature size are the same all around.
        let is_alike = !matches!(sizing, SurfaceSizing::Linear { .. });
        assert!(is_alike || quality.max_edge / quality.min_edge > 2.0, "{sizing:?}");
    }
    let error = surface_sizes(&surface, &SurfaceSizing::Attribute("size".into()), Some(10)).unwrap_err();
    assert!(error.to_string().contains("there are none"), "{error}");
}

#[test]
fn offsets_and_units_cost_no_digits() {
    let base = torus(30, 12);
    let moved = |scale: f64, offset: f64| {
        let vertices = base.vertices.iter().map(|p| p.map(|x| x * scale + offset)).collect();
        TriangleMesh { vertices, ..base.clone() }
    };
    for (scale, offset) in [(1e-9, 0.0), (1e9, 0.0), (1.0, 1e6), (1e-3, 1e3), (1e150, 0.0)] {
        let surface = Surface::new(&moved(scale, offset)).unwrap();
        let (made, report) = remeshed(&surface, 600, 1);
        assert_eq!(report.outcome, Outcome::Converged, "{scale}, {offset}");
        let quality = surface_quality(&Surface::new(&made.mesh).unwrap());
        assert!(quality.min_angle_deg > 45.0 && quality.max_angle_deg < 89.0, "{scale}, {offset}: {quality:?}");
    }
}

#[test]
fn places_lie_on_the_facets_that_they_name() {
    let mesh = torus(20, 10);
    let surface = Surface::new(&mesh).unwrap();
    let samplings = [
        SurfaceSampling::White(300),
        SurfaceSampling::PoissonDisk(0.2),
        SurfaceSampling::Vertices(300, staying()),
        SurfaceSampling::Vertices(300, RemeshParams::default().method),
    ];
    for sampling in samplings {
        let (points, _) = sample_surface(&surface, &sampled(sampling.clone(), 3), &mut RunContext::default()).unwrap();
        assert!(points.len() >= 250, "{sampling:?}: {}", points.len());
        for point in points {
            let corners = mesh.triangles[point.facet].map(|v| mesh.vertices[v]);
            let at = [0, 1, 2].map(|axis| (0..3).map(|k| point.barycentric[k] * corners[k][axis]).sum::<f64>());
            assert!(distance(at, point.position) < 1e-12, "{sampling:?}");
            assert!(point.barycentric.iter().all(|weight| (0.0..=1.0 + 1e-12).contains(weight)), "{sampling:?}");
            assert!((point.normal.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-9);
        }
    }
}

/// Where sizes vary, two points are as far apart as the smaller of theirs, and there is no room for another; independent points are as many as sizes want.
#[test]
fn sizes_say_how_far_apart_points_are() {
    let mut mesh = patch(12);
    mesh.vertices.iter_mut().for_each(|p| p[2] = 0.0);
    let surface = Surface::new(&mesh).unwrap();
    let sizes = surface_sizes(&surface, &SurfaceSizing::Linear { axis: 0, ratio: 3.0 }, Some(500)).unwrap();
    let made = |sampling| {
        let params = SampleParams { sampling, sizes: sizes.clone(), seed: 2 };
        sample_surface(&surface, &params, &mut RunContext::default()).unwrap().0
    };
    // As many points as spacings of 1 everywhere would leave: the mean of the inverse squares is 1 / 3.
    let (spacing, scale) = (0.05, 3f64.sqrt());
    let own = |point: &SurfacePoint| spacing * (1.0 + 2.0 * point.position[0]) / scale;
    let points = made(SurfaceSampling::PoissonDisk(spacing));
    for (k, a) in points.iter().enumerate() {
        assert!(points[..k].iter().all(|b| distance(a.position, b.position) >= 0.99 * own(a).min(own(b))));
    }
    let tries = made(SurfaceSampling::White(3000));
    let has_room = |p: &SurfacePoint| points.iter().all(|q| distance(p.position, q.position) > 1.02 * own(p).min(own(q)));
    assert_eq!(tries.iter().filter(|p| has_room(p)).count(), 0);
    // Of the area up to x, the share of the points is the integral of 1 / (1 + 2 x)^2: three quarters by the middle.
    let below = tries.iter().filter(|p| p.position[0] < 0.5).count() as f64 / 3000.0;
    assert!((below - 0.75).abs() < 0.03, "{below}");
}

#[test]
fn poisson_disks_are_maximal_and_do_not_reach_through_a_sheet() {
    let surface = Surface::new(&sheet()).unwrap();
    let spacing = 0.15;
    let (points, _) = sample_surface(&surface, &sampled(SurfaceSampling::PoissonDisk(spacing), 1), &mut RunContext::default()).unwrap();
    // Both sides are nearer to each other than the spacing, and still full: along each side no two points are too near.
    let sides = [0.0, 0.05].map(|z| points.iter().filter(|p| (p.position[2] - z).abs() < 1e-9).map(|p| p.position).collect::<Vec<_>>());
    for side in &sides {
        assert!(side.len() > 20, "{}", side.len());
        for (k, &a) in side.iter().enumerate() {
            assert!(side[..k].iter().all(|&b| distance(a, b) >= spacing));
        }
    }
    // No place of a side has room for another.
    let (tries, _) = sample_surface(&surface, &sampled(SurfaceSampling::White(4000), 9), &mut RunContext::default()).unwrap();
    for p in tries {
        assert!(points.iter().any(|q| distance(p.position, q.position) < spacing * 1.01), "{:?}", p.position);
    }
}

#[test]
fn what_is_no_manifold_is_refused_by_name_and_repaired() {
    // Two tetrahedra that share an edge.
    let mesh = solids::two_at_an_edge();
    let error = Surface::new(&mesh).unwrap_err();
    assert!(matches!(&error, Error::InvalidMesh(text) if text.contains("edge 0-1")), "{error}");
    let repaired = Surface::repaired(&mesh).unwrap();
    assert!(repaired.is_closed() && repaired.n_components() == 2, "{:?}", repaired.notes());
    assert_eq!(repaired.euler_characteristic(), 4);

    // A triangle that runs the wrong way.
    let mut mesh = cube(1);
    mesh.triangles[3].swap(0, 1);
    let error = Surface::new(&mesh).unwrap_err();
    assert!(error.to_string().contains("agree"), "{error}");
    assert!(Surface::repaired(&mesh).unwrap().is_closed());

    // A band with one side: a clear error, and with repair one cut.
    let band = moebius(40);
    assert!(Surface::new(&band).is_err());
    let cut = Surface::repaired(&band).unwrap();
    assert_eq!(cut.euler_characteristic(), 1, "{:?}", cut.notes());
    let (made, _) = remeshed(&cut, 400, 1);
    assert_eq!(made.mesh.vertices.len(), 400);

    // Spheres that touch in a point are two.
    let spheres = Surface::new(&touching_spheres()).unwrap();
    assert_eq!((spheres.n_components(), spheres.euler_characteristic()), (2, 4));
}

fn volume(surface: &Surface) -> f64 {
    let TriangleMesh { vertices, triangles, .. } = surface.to_mesh();
    let of = |t: &[usize; 3]| {
        let [a, b, c] = t.map(|v| vertices[v]);
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    triangles.iter().map(of).sum::<f64>() / 6.0
}

#[test]
fn a_closed_part_with_turned_triangles_ends_with_positive_volume() {
    let whole = volume(&Surface::new(&cube(1)).unwrap());
    for n_turned in 1..cube(1).triangles.len() {
        let mut mesh = cube(1);
        mesh.triangles.iter_mut().take(n_turned).for_each(|t| t.swap(0, 1));
        let surface = Surface::repaired(&mesh).unwrap();
        assert!((volume(&surface) - whole).abs() < 1e-9 * whole, "{n_turned}");
    }
}

/// Vertices on all sides of a triangle that those across have not, two on one.
#[test]
fn cracks_at_vertices_on_edges_are_closed() {
    let mut mesh = cube(1);
    let [a, b, c] = mesh.triangles[0];
    let middle = |p: [f64; 3], q: [f64; 3]| [0, 1, 2].map(|k| 0.5 * (p[k] + q[k]));
    let sides = [[a, b], [b, c], [c, a]].map(|[p, q]| middle(mesh.vertices[p], mesh.vertices[q]));
    let n = mesh.vertices.len();
    mesh.vertices.extend(sides);
    mesh.vertices.push(middle(mesh.vertices[a], sides[0]));
    mesh.triangles[0] = [n, n + 1, n + 2];
    mesh.triangles.extend([[a, n + 3, n + 2], [n + 3, n, n + 2], [n, b, n + 1], [n + 2, n + 1, c]]);
    assert!(!Surface::new(&mesh).unwrap().is_closed());
    let surface = Surface::repaired(&mesh).unwrap();
    assert!(surface.is_closed() && surface.euler_characteristic() == 2);
    let area = Surface::new(&cube(1)).unwrap().area();
    assert!((surface.area() - area).abs() < 1e-12 * area);
}

#[test]
fn near_corners_are_told_and_welded() {
    // Triangles that share nothing, whose corners are a little off.
    let whole = sphere(16);
    let off = |k: usize| 1e-7 * (k as f64).sin();
    let mut soup = TriangleMesh::default();
    for corner in whole.triangles.iter().flatten() {
        let k = soup.vertices.len();
        soup.vertices.push(whole.vertices[*corner].map(|x| x + off(k)));
    }
    soup.triangles = (0..whole.triangles.len()).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    let open = Surface::new(&soup).unwrap();
    assert_eq!(open.n_components(), whole.triangles.len());
    let (n, distance) = open.near_boundaries().unwrap();
    assert!(n == soup.vertices.len() && distance < 4e-7, "{n} {distance}");
    let (welded, _) = soup.welded(1e-6);
    let surface = Surface::new(&welded).unwrap();
    assert!(surface.is_closed() && surface.n_vertices() == whole.vertices.len());
    assert_eq!(surface.near_boundaries(), None);
    assert_eq!(Surface::new(&patch(20)).unwrap().near_boundaries(), None);
    // Points need no mesh that hangs together, nor one of the surface's genus.
    let handles = Surface::new(&genus_3()).unwrap();
    for (surface, n) in [&open, &handles].into_iter().flat_map(|surface| [1, 2, 10, 300].map(|n| (surface, n))) {
        for sampling in [SurfaceSampling::Vertices(n, RemeshParams::default().method), SurfaceSampling::Vertices(n, staying())] {
            let places: HashSet<_> = positions(surface, sampling, 5).into_iter().map(|p| p.map(f64::to_bits)).collect();
            assert_eq!(places.len(), n);
        }
    }
}

#[test]
fn any_number_of_vertices_is_possible_from_the_least_on() {
    let triangle =
        TriangleMesh { vertices: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], triangles: vec![[0, 1, 2]], attributes: Vec::new() };
    for (name, mesh, least) in [("triangle", triangle, 4), ("cube", cube(1), 10), ("sphere", sphere(12), 10), ("patch", patch(3), 4)] {
        let surface = Surface::new(&mesh).unwrap();
        for (n, seed) in (least..least + 20).flat_map(|n| [(n, 1), (n, 7)]) {
            let made = remesh(&surface, &RemeshParams { n_vertices: n, seed, ..RemeshParams::default() }, &mut RunContext::default());
            assert_eq!(made.map(|(made, _)| made.mesh.vertices.len()), Ok(n), "{name}, {n}, {seed}");
        }
    }
}

/// What is written is read as it was meant.
#[test]
fn no_two_vertices_are_in_one_place() {
    for mesh in [touching_spheres(), solids::two_at_an_edge()] {
        let surface = Surface::repaired(&mesh).unwrap();
        let (made, _) = remeshed(&surface, 800, 3);
        let places: HashSet<_> = made.mesh.vertices.iter().map(|p| p.map(f64::to_bits)).collect();
        assert_eq!(places.len(), 800);
        assert_eq!(Surface::new(&made.mesh).unwrap().n_vertices(), 800);
    }
}

#[test]
fn bad_input_is_one_clear_error() {
    let params = |n_points: usize| RemeshParams { n_vertices: n_points, ..RemeshParams::default() };
    let surface = Surface::new(&cube(1)).unwrap();
    for n in [0, 3] {
        assert!(remesh(&surface, &params(n), &mut RunContext::default()).is_err());
    }
    let uneven = RemeshParams { sizes: [vec![1e-300], vec![1.0; surface.n_vertices() - 1]].concat(), ..params(100) };
    assert!(remesh(&surface, &uneven, &mut RunContext::default()).unwrap_err().to_string().contains("a million times"));
    let too_few = remesh(&Surface::new(&genus_3()).unwrap(), &params(5), &mut RunContext::default()).unwrap_err();
    assert!(too_few.to_string().contains("no fewer than"), "{too_few}");
    let bad = |change: &dyn Fn(&mut TriangleMesh)| {
        let mut mesh = cube(1);
        change(&mut mesh);
        Surface::new(&mesh).unwrap_err().to_string()
    };
    assert!(bad(&|mesh| mesh.vertices[3][1] = f64::NAN).contains("vertex 3"));
    assert!(bad(&|mesh| mesh.triangles[2] = [0, 1, 99]).contains("triangle 2"));
    assert!(bad(&|mesh| mesh.triangles.clear()).contains("no triangle"));
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(40) })]
    #[test]
    fn no_soup_of_triangles_makes_it_panic(
        vertices in prop::collection::vec(prop::array::uniform3(prop_oneof![-1.0..1.0f64, Just(0.0), Just(1.0), Just(1e-300), Just(1e300)]), 3..12),
        corners in prop::collection::vec(prop::array::uniform3(0..12usize), 1..20),
        n_points in 4..60usize,
        points in prop_oneof![Just(Vec::new()), prop::collection::vec(prop::array::uniform3(-1.0..1.0f64), 60)],
    ) {
        let n = vertices.len();
        let mesh = TriangleMesh { vertices, triangles: corners.into_iter().map(|t| t.map(|v| v % n)).collect(), attributes: Vec::new() };
        let _ = Surface::new(&mesh);
        if let Ok(surface) = Surface::repaired(&mesh) {
            let params = RemeshParams {
                n_vertices: n_points,
                points,
                method: evenly::PushPullParams { max_passes: Some(20), ..evenly::PushPullParams::default() }.into(),
                ..RemeshParams::default()
            };
            if let Ok((made, _)) = remesh(&surface, &params, &mut RunContext::default()) {
                prop_assert_eq!(made.mesh.vertices.len(), n_points);
                prop_assert!(made.mesh.vertices.iter().flatten().all(|x| x.is_finite()));
            }
        }
    }
}

#[test]
fn as_few_vertices_as_corners_do() {
    let corner_counts = [
        (cube(3), 8),
        (
            TriangleMesh {
                vertices: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
                triangles: vec![[0, 1, 2]],
                ..TriangleMesh::default()
            },
            3,
        ),
    ];
    for (mesh, n_corners) in corner_counts {
        let surface = Surface::new(&mesh).unwrap();
        for n_points in n_corners..n_corners + 12 {
            let (remeshed, _) =
                remesh(&surface, &RemeshParams { n_vertices: n_points, ..RemeshParams::default() }, &mut RunContext::default()).unwrap();
            assert_eq!(remeshed.mesh.vertices.len(), n_points);
            assert!(Surface::new(&remeshed.mesh).unwrap().euler_characteristic() == surface.euler_characteristic());
        }
    }
}

/// A triangle and the same from behind, on a third: edges of the start would join the same two vertices.
#[test]
fn a_flap_that_lies_on_itself_is_remeshed() {
    let vertices = vec![[0.4, 0.4, 1.0], [0.4, 0.4, 0.9], [0.65, 0.35, 0.7], [0.4, 0.4, 0.4], [0.3, 0.65, 0.1]];
    let mesh = TriangleMesh { vertices, triangles: vec![[0, 1, 2], [2, 3, 0], [2, 3, 4]], attributes: Vec::new() };
    let surface = Surface::repaired(&mesh).unwrap();
    for n in [20, 60, 137] {
        let params = RemeshParams { n_vertices: n, ..RemeshParams::default() };
        let (made, _) = remesh(&surface, &params, &mut RunContext::default()).unwrap();
        assert_eq!(Surface::new(&made.mesh).unwrap().euler_characteristic(), surface.euler_characteristic(), "{n}");
    }
}
