//! Surfaces of triangles between places on a grid, repaired and remeshed.
#![no_main]

mod shapes;

use evenly::{RemeshParams, RunContext, Surface, TriangleMesh, remesh};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let Some(([n_points, n_vertices], rest)) = shapes::split(data) else { return };
    let n_vertices = usize::from(n_vertices % 24) + 3;
    let Some((vertices, corners)) = rest.split_at_checked(3 * n_vertices) else { return };
    let triangles = corners[..corners.len().min(120)].as_chunks::<3>().0.iter().map(|t| t.map(|v| usize::from(v) % n_vertices)).collect();
    let mesh = TriangleMesh { vertices: shapes::places(vertices), triangles, attributes: Vec::new() };
    let Ok(surface) = Surface::repaired(&mesh).or_else(|_| Surface::new(&mesh)) else { return };
    let params = RemeshParams { n_vertices: usize::from(n_points) + 4, ..RemeshParams::default() };
    if let Ok((remeshed, _)) = remesh(&surface, &params, &mut RunContext::default()) {
        Surface::new(&remeshed.mesh).expect("what is written can be read");
    }
});
