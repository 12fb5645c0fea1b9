//! Remeshes four surfaces made by code, and draws each before and after, obtuse triangles marked:
//! `cargo run --release --package evenly-io --example 05_surfaces folder`.

use std::path::PathBuf;

use evenly::{RemeshParams, RunContext, Surface, SurfaceSizing, TriangleMesh, remesh, surface_sizes};
use evenly_io::{compared_svg, make_folder, rendered};

#[path = "../tests/shared/solids.rs"]
mod solids;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or("surfaces".into()));
    make_folder(&folder)?;
    let by_curvature = Some(SurfaceSizing::Curvature { error: None });
    let models: [(&str, TriangleMesh, usize, Option<SurfaceSizing>); 4] = [
        ("sphere", solids::sphere(14), 1200, None),
        ("slab", solids::genus_3(), 2400, None),
        ("cone", solids::cone(24), 900, None),
        ("patch", solids::patch(24), 1200, by_curvature),
    ];
    for (name, mesh, n_points, sizing) in models {
        let surface = Surface::new(&mesh)?;
        let sizes = sizing.map(|sizing| surface_sizes(&surface, &sizing, Some(n_points))).transpose()?.unwrap_or_default();
        let (made, report) =
            remesh(&surface, &RemeshParams { n_vertices: n_points, sizes, ..RemeshParams::default() }, &mut RunContext::default())?;
        println!("{name}: {:?} after {} passes", report.outcome, report.iterations);
        let after = format!("{n_points} vertices");
        let svg = compared_svg(&[("before", &mesh), (&after, &made.mesh)]);
        std::fs::write(folder.join(format!("{name}.png")), rendered(&svg)?)?;
    }
    Ok(())
}
