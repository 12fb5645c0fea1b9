//! Meshes of polygons: how good they are, and what they cost.

use std::collections::HashSet;
use std::time::Instant;

use evenly::{EdgeKind, Mesh, MeshParams, Polygon, RunContext, expected_triangles, mesh, mesh_quality};

use super::shapes::{Ring, coast, holed_square, l_shape};
use super::{MEMORY, pool};

/// Hexagonal spacings of maximal Poisson-disk sets with a distance of .0314 and .0157, as the paper has them: n r^2 = 0.697 A.
const SPACINGS: [f64; 2] = [0.0404, 0.0202];
const SEEDS: u64 = 8;

pub fn of_meshes(is_quick: bool) {
    plain();
    non_obtuse();
    detailed();
    let sizes = if is_quick { &[10_000.0, 100_000.0][..] } else { &[10_000.0, 100_000.0, 1_000_000.0] };
    sizes.iter().for_each(|&n| cost(n));
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

/// The smallest angle but for those between two edges of the border.
fn least_angle(mesh: &Mesh) -> f64 {
    let border: HashSet<[usize; 2]> =
        mesh.edges.iter().filter(|edge| matches!(edge.kind, EdgeKind::Border { .. })).map(|edge| edge.ends).collect();
    let angles = mesh.triangles.iter().enumerate().flat_map(|(t, &[a, b, c])| {
        let corners = [[c, a, b], [a, b, c], [b, c, a]];
        let border = &border;
        mesh.angles_deg(t)
            .into_iter()
            .zip(corners)
            .filter(move |(_, [from, at, to])| !(border.contains(&[*from, *at]) && border.contains(&[*at, *to])))
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
