//! Meshes of polygons whose rings have their corners on a grid.
#![no_main]

mod shapes;

use evenly::{MeshParams, Polygon, RunContext, mesh, mesh_quality};
use libfuzzer_sys::fuzz_target;

/// No polygon is longer than so many spacings.
const LONGEST: f64 = 1000.0;

fuzz_target!(|data: &[u8]| {
    let Some(([spacing, n_corners], rest)) = shapes::split(data) else { return };
    let corners: Vec<[f64; 2]> = shapes::places(&rest[..rest.len().min(40)]);
    let rings = corners.chunks(usize::from(n_corners % 16) + 3).map(<[_]>::to_vec).collect();
    // As all faces do: what nearly touches would ask for triangles as small.
    let Ok(polygon) = Polygon::from_rings(rings).and_then(|polygon| polygon.welded(1e-6 * polygon.area().sqrt())) else { return };
    let reach = corners.iter().flatten().fold(0f64, |reach, x| reach.max(*x));
    let params = MeshParams::new(polygon.area().sqrt() * (0.1 + f64::from(spacing) / 64.0));
    // Long needles have a rung a spacing, and `spade` checks its whole hull at each in builds with assertions.
    if reach > LONGEST * params.spacing {
        return;
    }
    if let Ok((mesh, _)) = mesh(&polygon, &params, &mut RunContext::default()) {
        let area = mesh_quality(&mesh).area;
        assert!((area - polygon.area()).abs() <= 1e-9 * polygon.area(), "{area} {}", polygon.area());
    }
});
