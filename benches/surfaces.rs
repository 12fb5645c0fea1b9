//! Surfaces: how good their meshes are, and what they cost.

use evenly::{
    RemeshParams, RunContext, Surface, SurfaceSizing, TriangleMesh, remesh, self_intersections, surface_distance, surface_quality,
    surface_sizes, white,
};

use super::solids::{cone, cube, genus_3, torus};
use super::{best, delaunator, pool, torus as flat};

const SEEDS: u64 = 3;

pub fn of_surfaces(is_quick: bool) {
    for (name, mesh, n, is_by_curvature) in [
        ("torus", torus(60, 24), 8500, false),
        ("torus by curvature", torus(60, 24), 8500, true),
        ("solid of genus 3, creases", genus_3(), 8500, false),
        ("cube, creases", cube(3), 8500, false),
        ("cone", cone(40), 8500, false),
    ] {
        quality(name, &mesh, n, is_by_curvature);
    }
    let sizes = if is_quick { &[8500][..] } else { &[8500, 100_000] };
    sizes.iter().for_each(|&n| cost(n));
}

fn params(surface: &Surface, n_points: usize, is_by_curvature: bool, seed: u64) -> RemeshParams {
    let sizing = SurfaceSizing::Curvature { error: None };
    let sizes = if is_by_curvature { surface_sizes(surface, &sizing, Some(n_points)).unwrap() } else { Vec::new() };
    RemeshParams { n_vertices: n_points, sizes, seed, ..RemeshParams::default() }
}

fn quality(name: &str, mesh: &TriangleMesh, n: usize, is_by_curvature: bool) {
    let surface = Surface::new(mesh).unwrap();
    let (mut least, mut most, mut n_obtuse, mut n_crossings, mut farthest, mut passes) = (180f64, 0f64, 0, 0, 0f64, 0);
    for seed in 0..SEEDS {
        let (made, report) = remesh(&surface, &params(&surface, n, is_by_curvature, seed), &mut RunContext::default()).unwrap();
        let made = Surface::new(&made.mesh).unwrap();
        let quality = surface_quality(&made);
        (least, most) = (least.min(quality.min_angle_deg), most.max(quality.max_angle_deg));
        (n_obtuse, passes) = (n_obtuse.max(quality.obtuse_triangles), passes.max(report.iterations));
        n_crossings += self_intersections(&made).len();
        farthest = farthest.max(surface_distance(&made, &surface).hausdorff);
    }
    println!(
        "| mesh of a {name}, {n} vertices, {SEEDS} seeds | angles 45.5 to 88.9, 0 obtuse, 0 crossings | angles {least:.2} to {most:.2}, <= {n_obtuse} obtuse, \
         {n_crossings} crossings, Hausdorff {farthest:.1e}, <= {passes} passes |"
    );
}

fn cost(n: usize) {
    let surface = Surface::new(&torus(120, 48)).unwrap();
    let params = params(&surface, n, false, 0);
    let unit = delaunator(&white(flat(), n, 1).unwrap()).as_secs_f64();
    let time = pool(1).install(|| best(3, || remesh(&surface, &params, &mut RunContext::default()).unwrap())).as_secs_f64();
    println!("| mesh of a torus, {n} vertices, one thread | - | {:.0} delaunator runs, {time:.2} s |", time / unit);
    let on_two = pool(2).install(|| best(3, || remesh(&surface, &params, &mut RunContext::default()).unwrap())).as_secs_f64();
    println!("| two threads against one, {n} vertices | >= 1.6 at 100,000, the same bits | {:.2} |", time / on_two);
}
