//! Surfaces: distances to every triangle, ways along a finer mesh, and the platonic solids.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};

use evenly::{Surface, TriangleMesh, measure_on_surface, surface_distance, surface_quality};
use glam::DVec3;

use super::{Random, assert_near, hex_spacing};
use crate::solids::{cube, patch, sphere, torus};

fn corners(mesh: &TriangleMesh) -> Vec<[DVec3; 3]> {
    mesh.triangles.iter().map(|t| t.map(|v| DVec3::from(mesh.vertices[v]))).collect()
}

fn area(&[a, b, c]: &[DVec3; 3]) -> f64 {
    0.5 * (b - a).cross(c - a).length()
}

/// The distance of a place to a triangle: to its plane if the foot lies inside, or to the nearest of its sides.
fn distance_to(p: DVec3, &[a, b, c]: &[DVec3; 3]) -> f64 {
    let normal = (b - a).cross(c - a).normalize();
    let is_inside = [[a, b], [b, c], [c, a]].iter().all(|&[from, to]| normal.cross(to - from).dot(p - from) >= 0.0);
    let to_side = |from: DVec3, to: DVec3| {
        let along = to - from;
        p.distance(from + along * ((p - from).dot(along) / along.length_squared()).clamp(0.0, 1.0))
    };
    if is_inside { normal.dot(p - a).abs() } else { to_side(a, b).min(to_side(b, c)).min(to_side(c, a)) }
}

/// The root mean square and the largest distance of places on one mesh, a triangular grid on each of its triangles, from the other; and how far these places lie apart.
fn one_way(from: &TriangleMesh, to: &TriangleMesh, n: usize) -> [f64; 3] {
    let (triangles, mut sum, mut total, mut most, mut apart) = (corners(to), 0.0, 0.0, 0.0f64, 0.0f64);
    let distance = |p: DVec3| triangles.iter().map(|t| distance_to(p, t)).fold(f64::INFINITY, f64::min);
    for corners in corners(from) {
        let [a, b, c] = corners;
        let at = |i: f64, j: f64| a + (b - a) * (i / n as f64) + (c - a) * (j / n as f64);
        // The middles of the small triangles, upright ones and others, stand for their areas.
        let upright = (0..n).flat_map(|i| (0..n - i).map(move |j| (i as f64 + 1.0 / 3.0, j as f64 + 1.0 / 3.0)));
        let others = (0..n).flat_map(|i| (0..(n - i).saturating_sub(1)).map(move |j| (i as f64 + 2.0 / 3.0, j as f64 + 2.0 / 3.0)));
        let squares: f64 = upright.chain(others).map(|(i, j)| distance(at(i, j)).powi(2)).sum();
        sum += squares / (n * n) as f64 * area(&corners);
        total += area(&corners);
        let nodes = (0..=n).flat_map(|i| (0..=n - i).map(move |j| (i as f64, j as f64)));
        most = nodes.map(|(i, j)| distance(at(i, j))).fold(most, f64::max);
        apart = apart.max(a.distance(b).max(b.distance(c)).max(c.distance(a)) / n as f64);
    }
    [(sum / total).sqrt(), most, apart]
}

/// Turned, scaled, moved, and shaken.
fn shaken(mesh: &TriangleMesh, scale: f64, by: f64, seed: u64) -> TriangleMesh {
    let mut random = Random(seed);
    let mut place = |&p: &[f64; 3]| {
        let shake = DVec3::new(random.unit(), random.unit(), random.unit()) - 0.5;
        (DVec3::from(p).rotate_z(0.3 * by) * scale + by * shake).to_array()
    };
    TriangleMesh { vertices: mesh.vertices.iter().map(&mut place).collect(), triangles: mesh.triangles.clone(), attributes: Vec::new() }
}

#[test]
fn surfaces_are_as_far_apart_as_places_on_one_are_from_all_triangles_of_the_other() {
    let pairs = [
        ("spheres", shaken(&sphere(6), 1.0, 0.1, 1), sphere(9)),
        ("cubes", shaken(&cube(2), 1.2, 0.05, 2), cube(3)),
        ("a patch and a torus", shaken(&patch(6), 0.8, 0.02, 3), torus(12, 8)),
        ("a cube beside a cube", shaken(&cube(1), 0.5, 0.0, 4), cube(1)),
    ];
    for (case, mesh, reference) in pairs {
        let [surface, other] = [&mesh, &reference].map(|mesh| Surface::new(mesh).unwrap());
        let found = surface_distance(&surface, &other);
        let places = |mesh: &TriangleMesh| (20_000.0 / mesh.triangles.len() as f64).sqrt().ceil() as usize;
        let there = one_way(&mesh, &reference, places(&mesh));
        let back = one_way(&reference, &mesh, places(&reference));
        for ([rms, most, apart], found) in
            [(there, [found.rms_to_reference, found.max_to_reference]), (back, [found.rms_from_reference, found.max_from_reference])]
        {
            assert_near(found[0], rms, 0.01 * rms + 1e-9, case);
            // Both look at places alone: no other is farther by more than what lies between them.
            assert_near(found[1], most, apart, case);
        }
        let low = reference.vertices.iter().map(|&p| DVec3::from(p)).fold(DVec3::INFINITY, DVec3::min);
        let high = reference.vertices.iter().map(|&p| DVec3::from(p)).fold(DVec3::NEG_INFINITY, DVec3::max);
        let diagonal = low.distance(high);
        assert_near(found.rms, found.rms_to_reference.max(found.rms_from_reference) / diagonal, 1e-12, case);
        assert_near(found.hausdorff, found.max_to_reference.max(found.max_from_reference) / diagonal, 1e-12, case);
        let triangles = corners(&mesh);
        let farthest = triangles.iter().map(|t| distance_to(found.farthest_place.into(), t)).fold(f64::INFINITY, f64::min);
        assert_near(farthest, found.max_from_reference, 1e-9, case);
        // A triangle is turned if it faces the other way than that which is nearest to its middle; where several are, one of them.
        let normal = |[a, b, c]: &[DVec3; 3]| (b - a).cross(c - a);
        let others = corners(&reference);
        let is_turned = |t: &[DVec3; 3]| {
            let middle = (t[0] + t[1] + t[2]) / 3.0;
            let distances: Vec<f64> = others.iter().map(|other| distance_to(middle, other)).collect();
            let least = distances.iter().copied().fold(f64::INFINITY, f64::min);
            let nearest = others.iter().zip(distances).filter(|(_, distance)| *distance < least + 1e-9);
            nearest.map(|(other, _)| normal(other).dot(normal(t)) < 0.0).collect::<Vec<bool>>()
        };
        let turned: Vec<Vec<bool>> = triangles.iter().map(is_turned).collect();
        let [least, most] =
            [turned.iter().filter(|all| !all.contains(&false)).count(), turned.iter().filter(|all| all.contains(&true)).count()];
        assert!((least..=most).contains(&found.flipped_triangles), "{case}: {} of {least} to {most}", found.flipped_triangles);
    }
}

#[test]
fn parallel_squares_are_as_far_apart_as_they_are_high() {
    let square = |side: f64, z: f64| TriangleMesh {
        vertices: [[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]].map(|[x, y]| [x, y, z]).to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        attributes: Vec::new(),
    };
    let [small, large] = [square(1.0, 0.5), square(2.0, 0.0)].map(|mesh| Surface::new(&mesh).unwrap());
    let found = surface_distance(&small, &large);
    assert_near(found.rms_to_reference, 0.5, 1e-12, "up");
    assert_near(found.max_to_reference, 0.5, 1e-12, "up");
    assert_near(found.max_from_reference, 2.25f64.sqrt(), 1e-12, "down");
    // A fourth of it has the height alone, two fourths are x off to a side, and one is x and y: 1/4 + (0 + 1/3 + 1/3 + 2/3) / 4.
    assert_near(found.rms_from_reference, (0.25 + 1.0 / 3.0f64).sqrt(), 2e-3, "down");
}

/// Random places on a mesh, as many in each area.
fn places_on(mesh: &TriangleMesh, n: usize, seed: u64) -> Vec<DVec3> {
    let (triangles, mut random) = (corners(mesh), Random(seed));
    let total: f64 = triangles.iter().map(area).sum();
    let mut place = || {
        let mut left = total * random.unit();
        let t = triangles.iter().find(|t| {
            left -= area(t);
            left < 0.0
        });
        let [a, b, c] = t.copied().unwrap_or(triangles[0]);
        let (u, v) = (random.unit(), random.unit());
        let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
        a + u * (b - a) + v * (c - a)
    };
    (0..n).map(|_| place()).collect()
}

/// The mean and the smallest of the distances to the nearest other, by a distance of two points.
fn nearest(n: usize, distance: impl Fn(usize, usize) -> f64) -> [f64; 2] {
    let nearest = |k: usize| (0..n).filter(|&other| other != k).map(|other| distance(k, other)).fold(f64::INFINITY, f64::min);
    let all: Vec<f64> = (0..n).map(nearest).collect();
    [all.iter().sum::<f64>() / n as f64, all.into_iter().fold(f64::INFINITY, f64::min)]
}

fn compare(mesh: &TriangleMesh, points: &[DVec3], [mean, least]: [f64; 2], tolerance: f64, case: &str) {
    let given: Vec<[f64; 3]> = points.iter().map(|p| p.to_array()).collect();
    let found = measure_on_surface(&Surface::new(mesh).unwrap(), &given).unwrap();
    let total: f64 = corners(mesh).iter().map(area).sum();
    assert_near(found.area, total, 1e-9 * total, case);
    assert_near(found.spacing, hex_spacing(total, points.len()), 1e-9 * found.spacing, case);
    assert_near(found.mean_distance * found.spacing, mean, tolerance * mean, case);
    assert_near(found.min_distance * found.spacing, least, tolerance * least, case);
    assert!(found.off_surface < 1e-9, "{case}: {}", found.off_surface);
}

#[test]
fn distances_on_a_plane_are_straight_and_on_a_sphere_round() {
    for seed in 0..3 {
        // A square askew in space, far from the origin.
        let mut plane = patch(9);
        let askew = |[x, y, _]: [f64; 3]| (DVec3::new(x, y, 0.0).rotate_x(0.7).rotate_z(0.4) * 30.0 + 1e3).to_array();
        plane.vertices.iter_mut().for_each(|p| *p = askew(*p));
        let points = places_on(&plane, 200, seed);
        compare(&plane, &points, nearest(200, |a, b| points[a].distance(points[b])), 1e-8, "plane");
        let ball = sphere(60);
        let points = places_on(&ball, 100, seed);
        compare(&ball, &points, nearest(100, |a, b| points[a].angle_between(points[b])), 5e-3, "sphere");
    }
}

/// The mean and the smallest of the shortest ways from some vertices of a mesh to the nearest other of them, along its edges and across pairs of triangles: where triangles are nearly square
/// halves, there are ways in a dozen directions, and the shortest is longer than that along the surface by up to a twentieth.
fn ways(mesh: &TriangleMesh, marked: &[usize]) -> [f64; 2] {
    let place = |v: usize| DVec3::from(mesh.vertices[v]);
    // Besides the edges, ways across two triangles that share one.
    let mut beside: HashMap<[usize; 2], Vec<usize>> = HashMap::new();
    let mut edges: Vec<Vec<(usize, f64)>> = vec![Vec::new(); mesh.vertices.len()];
    for t in &mesh.triangles {
        for k in 0..3 {
            let (a, b, c) = (t[k], t[(k + 1) % 3], t[(k + 2) % 3]);
            edges[a].push((b, place(a).distance(place(b))));
            edges[b].push((a, place(a).distance(place(b))));
            beside.entry([a.min(b), a.max(b)]).or_default().push(c);
        }
    }
    for ([a, b], apexes) in beside {
        let [p, q] = apexes[..] else { continue };
        // Both triangles laid out in one plane.
        let along = (place(b) - place(a)).normalize();
        let flat = |v: usize| {
            let by = place(v) - place(a);
            (by.dot(along), by.reject_from(along).length())
        };
        let ((x, y), (u, v)) = (flat(p), flat(q));
        let crossing = x + (u - x) * y / (y + v);
        if crossing > 0.0 && crossing < place(a).distance(place(b)) {
            let length = (x - u).hypot(y + v);
            edges[p].push((q, length));
            edges[q].push((p, length));
        }
    }
    let from = |start: usize| {
        let mut least = vec![f64::INFINITY; mesh.vertices.len()];
        let mut heap = BinaryHeap::from([(Reverse(0u64), start)]);
        while let Some((Reverse(bits), v)) = heap.pop() {
            let length = f64::from_bits(bits);
            if v != start && marked.contains(&v) {
                return length;
            }
            for &(to, by) in &edges[v] {
                if length + by < least[to] {
                    least[to] = length + by;
                    heap.push((Reverse((length + by).to_bits()), to));
                }
            }
        }
        f64::INFINITY
    };
    let all: Vec<f64> = marked.iter().map(|&v| from(v)).collect();
    [all.iter().sum::<f64>() / all.len() as f64, all.into_iter().fold(f64::INFINITY, f64::min)]
}

/// Each edge halved.
fn halved(mesh: &TriangleMesh) -> TriangleMesh {
    let (mut vertices, mut middles) = (mesh.vertices.clone(), HashMap::new());
    let mut middle = |a: usize, b: usize| {
        *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
            vertices.push((0.5 * (DVec3::from(mesh.vertices[a]) + DVec3::from(mesh.vertices[b]))).to_array());
            vertices.len() - 1
        })
    };
    let mut quarters = |&[a, b, c]: &[usize; 3]| {
        let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
        [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
    };
    let triangles = mesh.triangles.iter().flat_map(&mut quarters).collect();
    TriangleMesh { vertices, triangles, attributes: Vec::new() }
}

#[test]
fn distances_on_curved_surfaces_are_about_those_along_a_finer_mesh() {
    for (case, mesh) in [("torus", torus(40, 20)), ("patch", patch(24))] {
        let fine = halved(&halved(&mesh));
        for seed in 0..2 {
            let mut random = Random(seed);
            let mut marked: Vec<usize> = (0..40).map(|_| (random.unit() * fine.vertices.len() as f64) as usize).collect();
            marked.sort_unstable();
            marked.dedup();
            let given: Vec<[f64; 3]> = marked.iter().map(|&v| fine.vertices[v]).collect();
            let found = measure_on_surface(&Surface::new(&fine).unwrap(), &given).unwrap();
            let [mean, least] = ways(&fine, &marked);
            let ratios = [found.mean_distance * found.spacing / mean, found.min_distance * found.spacing / least];
            assert!(ratios.iter().all(|ratio| (0.94..1.01).contains(ratio)), "{case}, {seed}: {ratios:?}");
        }
    }
}

/// The regular tetrahedron and icosahedron with edges of length a: angles of 60 degrees, circumradii a / sqrt(3), areas sqrt(3) / 4 a^2.
#[test]
fn platonic_solids_have_the_quality_that_is_known() {
    let golden = 0.5 * (1.0 + 5f64.sqrt());
    let cyclic = [0, 1, 2].into_iter().flat_map(|k| {
        let corners = [[-1.0, -golden], [1.0, -golden], [-1.0, golden], [1.0, golden]].map(|[x, y]| [0.0, x, y]);
        corners.map(|p| [p[k], p[(k + 1) % 3], p[(k + 2) % 3]])
    });
    let tetrahedron = vec![[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    for (vertices, edge, n_triangles) in [(tetrahedron, 8f64.sqrt(), 4), (cyclic.collect(), 2.0, 20)] {
        // Faces are what three vertices an edge apart make; counter-clockwise from outside.
        let place = |v: usize| DVec3::from(vertices[v]);
        let n = vertices.len();
        let all = (0..n).flat_map(|a| (a + 1..n).flat_map(move |b| (b + 1..n).map(move |c| [a, b, c])));
        let is_face = |t: &[usize; 3]| (0..3).all(|k| (place(t[k]).distance(place(t[(k + 1) % 3])) - edge).abs() < 1e-9);
        let outward = |[a, b, c]: [usize; 3]| {
            let volume = place(a).dot(place(b).cross(place(c)));
            if volume > 0.0 { [a, b, c] } else { [a, c, b] }
        };
        let triangles: Vec<[usize; 3]> = all.filter(is_face).map(outward).collect();
        let q = surface_quality(&Surface::new(&TriangleMesh { vertices: vertices.clone(), triangles, attributes: Vec::new() }).unwrap());
        let case = format!("{n} vertices");
        assert_eq!(
            (q.n_vertices, q.n_triangles, q.n_components, q.n_boundary_edges, q.euler_characteristic),
            (n, n_triangles, 1, 0, 2),
            "{case}"
        );
        let valence_567 = if n == 12 { 1.0 } else { 0.0 };
        let counts = (q.obtuse_triangles, q.obtuse_fraction, q.thin_fraction, q.valence_567_fraction, q.valence_6_fraction);
        assert_eq!(counts, (0, 0.0, 0.0, valence_567, 0.0), "{case}");
        for angle in [q.min_angle_deg, q.max_angle_deg, q.mean_min_angle_deg] {
            assert_near(angle, 60.0, 1e-9, &case);
        }
        assert_near(q.angle_rms_deg, 0.0, 1e-9, &case);
        assert_near(q.area, n_triangles as f64 * 3f64.sqrt() / 4.0 * edge * edge, 1e-9, &case);
        let ratios = [q.min_quality, q.mean_quality, q.min_edge / edge, q.max_edge / edge, q.spacing / edge, q.min_distance];
        for (number, ratio) in ratios.into_iter().enumerate() {
            assert_near(ratio, 1.0, 1e-9, &format!("{case}, ratio {number}"));
        }
        for ratio in [q.max_circumradius / edge, q.beta, q.coverage_radius] {
            assert_near(ratio, 1.0 / 3f64.sqrt(), 1e-9, &case);
        }
    }
}
