//! A mesh, drawn: its triangles, its boundary, and what is wrong with it.

use std::fmt::Write as _;

use evenly::{Mesh, OBTUSE_DEG};

use super::svg::{Short, drawing};

/// The longer side of the drawing, and the paper around, in pixels.
const SIDE: f64 = 1200.0;
const MARGIN: f64 = 12.0;
/// Obtuse angles are marked, and those below this.
const THIN_DEG: f64 = 25.0;

/// Draws a mesh: obtuse triangles light red, thin ones red.
pub(crate) fn mesh_figure(mesh: &Mesh, recipe: &str) -> String {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for p in &mesh.vertices {
        for axis in 0..2 {
            (low[axis], high[axis]) = (low[axis].min(p[axis]), high[axis].max(p[axis]));
        }
    }
    let extent = [high[0] - low[0], high[1] - low[1]];
    let scale = SIDE / extent[0].max(extent[1]);
    let size = extent.map(|side| side * scale + 2.0 * MARGIN);
    let place = |v: usize| {
        let [x, y] = mesh.vertices[v];
        format!("{} {}", Short(MARGIN + scale * (x - low[0])), Short(MARGIN + scale * (high[1] - y)))
    };
    // Lines become thinner where triangles are small.
    let typical = scale * (extent[0] * extent[1] / mesh.triangles.len().max(1) as f64).sqrt();
    let width = (0.05 * typical).clamp(0.1, 1.0);
    let mut paths = [String::new(), String::new(), String::new()];
    for (t, corners) in mesh.triangles.iter().enumerate() {
        let angles = mesh.angles_deg(t);
        let kind =
            if angles.iter().any(|&angle| angle < THIN_DEG) { 2 } else { usize::from(angles.iter().any(|&angle| angle > OBTUSE_DEG)) };
        let _ = write!(paths[kind], "M{}L{}L{}Z", place(corners[0]), place(corners[1]), place(corners[2]));
    }
    let mut body = String::new();
    for (path, fill) in paths.iter().zip(["#dbe6f0", "#f6cfc4", "#d7301f"]).filter(|(path, _)| !path.is_empty()) {
        let _ = writeln!(
            body,
            "<path d=\"{path}\" fill=\"{fill}\" stroke=\"#30404f\" stroke-width=\"{}\" stroke-linejoin=\"round\"/>",
            Short(width)
        );
    }
    let mut boundary = String::new();
    for edge in &mesh.edges {
        let _ = write!(boundary, "M{}L{}", place(edge.ends[0]), place(edge.ends[1]));
    }
    let _ = writeln!(
        body,
        "<path d=\"{boundary}\" fill=\"none\" stroke=\"#000000\" stroke-width=\"{}\" stroke-linecap=\"round\"/>",
        Short(3.0 * width)
    );
    drawing(size, recipe, &body)
}
