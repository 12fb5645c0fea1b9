//! Meshes of polygons, and points in them: how good they are, and what they cost.

use std::collections::HashSet;
use std::time::Instant;

use evenly::{
    DistMeshParams, EdgeKind, LloydParams, LocalMethod, Mesh, MeshParams, OptBetaParams, PointSet, Polygon, PushPullParams, RunContext,
    Space, Targets, WellSpacedParams, expected_triangles, jittered, measure, mesh, mesh_quality, opt_beta, poisson_disk_of, push_pull,
    well_spaced,
};

use super::shapes::{Ring, coast, holed_square, l_shape};
use super::{MEMORY, pool};

/// Hexagonal spacings of maximal Poisson-disk sets with a distance of .0314 and .0157, as the paper has them: n r^2 = 0.697 A.
const SPACINGS: [f64; 2] = [0.0404, 0.0202];
const SEEDS: u64 = 8;

pub fn of_meshes(is_quick: bool) {
    plain();
    methods();
    non_obtuse();
    detailed();
    let sizes = if is_quick { &[10_000.0, 100_000.0][..] } else { &[10_000.0, 100_000.0, 1_000_000.0] };
    sizes.iter().for_each(|&n| cost(n));
    ratios();
    sizes.iter().for_each(|&n| sampled(n as usize));
}

fn meshed(rings: Vec<Ring>, params: &MeshParams) -> Mesh {
    mesh(&Polygon::from_rings(rings).unwrap(), params, &mut RunContext::default()).unwrap().0
}

fn plain() {
    for (name, rings) in [("L-shape", l_shape()), ("square with a hole", holed_square())] {
        for spacing in SPACINGS {
            let (mut beta, mut least, mut most) = (0f64, 180f64, 0f64);
            for seed in 0..SEEDS {
                let quality = mesh_quality(&meshed(rings.clone(), &MeshParams { seed, ..MeshParams::new(spacing) }));
                (beta, least, most) = (beta.max(quality.beta), least.min(quality.min_angle_deg), most.max(quality.max_angle_deg));
            }
            println!(
                "| mesh of a {name}, spacing {spacing}, {SEEDS} seeds | beta <= .757, angles 41 to 97 | beta <= {beta:.3}, angles {least:.1} to {most:.1} |"
            );
        }
    }
}

fn methods() {
    let all: [(&str, LocalMethod); 3] = [
        ("Opt-beta", OptBetaParams { beta: Some(0.75), iterations: 200, ..OptBetaParams::default() }.into()),
        ("Lloyd", LloydParams::default().into()),
        ("DistMesh", DistMeshParams::default().into()),
    ];
    for (name, rings) in [("L-shape", l_shape()), ("square with a hole", holed_square())] {
        for spacing in SPACINGS {
            for (method_name, method) in &all {
                let (mut beta, mut least, mut most) = (0f64, 180f64, 0f64);
                let start = Instant::now();
                for seed in 0..SEEDS {
                    let quality = mesh_quality(&meshed(
                        rings.clone(),
                        &MeshParams { seed, method: Some(method.clone()), ..MeshParams::new(spacing) },
                    ));
                    (beta, least, most) = (beta.max(quality.beta), least.min(quality.min_angle_deg), most.max(quality.max_angle_deg));
                }
                let seconds = start.elapsed().as_secs_f64() / SEEDS as f64;
                println!(
                    "| mesh of a {name} by {method_name}, spacing {spacing}, {SEEDS} seeds | - | beta <= {beta:.3}, angles {least:.1} to {most:.1}, {seconds:.2} s each |"
                );
            }
        }
    }
}

fn non_obtuse() {
    for (name, rings) in [("L-shape", l_shape()), ("square with a hole", holed_square())] {
        for spacing in SPACINGS {
            let start = Instant::now();
            let n_obtuse = (0..SEEDS).map(|seed| {
                let params = MeshParams { seed, is_non_obtuse: true, ..MeshParams::new(spacing) };
                mesh_quality(&meshed(rings.clone(), &params)).obtuse_triangles
            });
            let n_obtuse: Vec<usize> = n_obtuse.collect();
            let seconds = start.elapsed().as_secs_f64() / SEEDS as f64;
            println!(
                "| non-obtuse mesh of a {name}, spacing {spacing}, {SEEDS} seeds | 0 obtuse triangles | {n_obtuse:?}, {seconds:.2} s each |"
            );
        }
    }
}

/// The smallest angle but for those between two edges of the boundary.
fn least_angle(mesh: &Mesh) -> f64 {
    let boundary: HashSet<[usize; 2]> =
        mesh.edges.iter().filter(|edge| matches!(edge.kind, EdgeKind::Boundary { .. })).map(|edge| edge.ends).collect();
    let angles = mesh.triangles.iter().enumerate().flat_map(|(t, &[a, b, c])| {
        let corners = [[c, a, b], [a, b, c], [b, c, a]];
        let boundary = &boundary;
        mesh.angles_deg(t)
            .into_iter()
            .zip(corners)
            .filter(move |(_, [from, at, to])| !(boundary.contains(&[*from, *at]) && boundary.contains(&[*at, *to])))
            .map(|(angle, _)| angle)
    });
    angles.fold(180.0, f64::min)
}

fn detailed() {
    let rings = coast(6000);
    let polygon = Polygon::from_rings(rings).unwrap();
    let mut spacing = (4.0 * polygon.area() / (3f64.sqrt() * 1e5)).sqrt();
    for _ in 0..4 {
        spacing *= (expected_triangles(&polygon, &MeshParams::new(spacing)).unwrap() / 1e5).sqrt();
    }
    let start = Instant::now();
    let (mesh, _) = pool(1).install(|| mesh(&polygon, &MeshParams::new(spacing), &mut RunContext::default()).unwrap());
    let seconds = start.elapsed().as_secs_f64();
    println!(
        "| mesh of a coast of {} corners, {} triangles, one thread | >= 25 degrees but at sharper corners, < 60 s | >= {:.1} degrees, {seconds:.1} s |",
        polygon.rings()[0].len(),
        mesh.triangles.len(),
        least_angle(&mesh)
    );
}

fn cost(n_triangles: f64) {
    let polygon = Polygon::from_rings(holed_square()).unwrap();
    let spacing = (4.0 * polygon.area() / (3f64.sqrt() * n_triangles)).sqrt();
    let params = MeshParams::new(spacing);
    MEMORY.reset_peak_usage();
    let before = MEMORY.current_usage();
    let start = Instant::now();
    let (mesh, report) = pool(1).install(|| mesh(&polygon, &params, &mut RunContext::default()).unwrap());
    let seconds = start.elapsed().as_secs_f64();
    let n_vertices = mesh.vertices.len() as f64;
    let bytes = (MEMORY.peak_usage() - before) as f64 / n_vertices;
    println!(
        "| mesh of a square with a hole, {} triangles, one thread | time linear from 10k, <= 1 KiB a vertex at 1M | {seconds:.2} s, {:.1} us and {bytes:.0} bytes a vertex, {:.1} visits |",
        mesh.triangles.len(),
        1e6 * seconds / n_vertices,
        report.visits as f64 / n_vertices
    );
}

/// As many points as the paper's shapes have.
const POINTS: [usize; 2] = [600, 2300];

fn ratios() {
    type Method = fn(&mut PointSet, u64);
    let methods: [(&str, Method); 2] = [
        ("Opt-beta to 0.75, 200 sweeps", |points, _| {
            let params = OptBetaParams { beta: Some(0.75), iterations: 200, ..OptBetaParams::default() };
            opt_beta(points, &params, &mut RunContext::default()).unwrap();
        }),
        ("well-spaced, beta 0.75", |points, seed| {
            well_spaced(points, &WellSpacedParams { seed, ..WellSpacedParams::default() }, &mut RunContext::default()).unwrap();
        }),
    ];
    for (name, rings) in [("L-shape", l_shape()), ("square with a hole", holed_square())] {
        let space = Space::from(&Polygon::from_rings(rings).unwrap());
        for n in POINTS {
            for (method, run) in &methods {
                let betas = (0..SEEDS).map(|seed| {
                    let mut points = poisson_disk_of(&space, n, seed).unwrap();
                    run(&mut points, seed);
                    measure(&points).unwrap().beta
                });
                let mut betas: Vec<f64> = betas.collect();
                betas.sort_by(f64::total_cmp);
                let [least, middle, most] = [0, betas.len() / 2, betas.len() - 1].map(|k| betas[k]);
                println!(
                    "| {method}, {n} points in a {name}, {SEEDS} seeds | - | beta {least:.3}, {middle:.3}, {most:.3} (least, median, most) |"
                );
            }
        }
    }
}

fn sampled(n: usize) {
    let polygon = Polygon::from_rings(coast(6000)).unwrap();
    let mut points = jittered(Space::from(&polygon), n, 1).unwrap();
    let params = PushPullParams::default();
    let start = Instant::now();
    let report = pool(1).install(|| push_pull(&mut points, &params, &mut RunContext::default()).unwrap());
    let seconds = start.elapsed().as_secs_f64();
    let visits = report.visits as f64 / n as f64;
    let is_reached = params.unmet(&measure(&points).unwrap()).is_empty();
    println!(
        "| Push-Pull {{0.85, 0.67}} in a coast of {} corners, one thread, n = {n} | - | {seconds:.2} s, {visits:.1} visits a point, {:.0} ns a visit, {} |",
        polygon.rings()[0].len(),
        1e9 * seconds / report.visits as f64,
        if is_reached { "reached" } else { "not reached" }
    );
}
