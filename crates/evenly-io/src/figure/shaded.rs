//! A mesh in space, drawn: its triangles in light and shade, and what is wrong with them.

mod relief;
mod view;

use std::fmt::Write as _;

use evenly::{OBTUSE_DEG, TriangleMesh};

use self::relief::Relief;
use self::view::View;
use super::svg::{Anchor, Short, drawing, inset, text};

/// The longer side of a drawing, and of each of several beside each other.
const SIDE: f64 = 1200.0;
const SIDE_OF_SEVERAL: f64 = 700.0;
/// The paper around, the room between drawings, and that for a caption.
const MARGIN: f64 = 12.0;
const GAP: f64 = 24.0;
const CAPTION: f64 = 40.0;
/// Obtuse angles are marked, and those below this.
const THIN_DEG: f64 = 30.0;
/// The colours of good, obtuse and thin triangles in full light.
const COLOURS: [[f64; 3]; 3] = [[219.0, 230.0, 240.0], [246.0, 190.0, 170.0], [215.0, 48.0, 31.0]];
/// The light that is everywhere, and how much duller the inside is.
const AMBIENT: f64 = 0.5;
const DULL: f64 = 0.72;

/// Draws a mesh in space, seen obliquely from above: obtuse triangles light red, thin ones red.
pub(crate) fn shaded_figure(mesh: &TriangleMesh, recipe: &str) -> String {
    let view = View::of(&[mesh], SIDE);
    let size = view.size(mesh).map(|side| side + 2.0 * MARGIN);
    drawing(size, recipe, &body(mesh, &view, [MARGIN; 2]))
}

/// Draws meshes side by side at the same scale, each under its caption.
pub fn compared_svg(meshes: &[(&str, &TriangleMesh)]) -> String {
    let all: Vec<&TriangleMesh> = meshes.iter().map(|&(_, mesh)| mesh).collect();
    let view = View::of(&all, SIDE_OF_SEVERAL);
    let height = all.iter().map(|mesh| view.size(mesh)[1]).fold(0.0, f64::max);
    let mut svg = String::new();
    let mut x = GAP;
    for &(caption, mesh) in meshes {
        let [width, own] = view.size(mesh);
        text(&mut svg, [x + 0.5 * width, CAPTION - 14.0], 20.0, Anchor::Middle, caption);
        let size = [width + 2.0 * MARGIN, own + 2.0 * MARGIN];
        let place = [x - MARGIN, CAPTION + 0.5 * (height - own)];
        svg.push_str(&inset(place, size, size, &body(mesh, &view, [MARGIN; 2])));
        x += width + GAP;
    }
    drawing([x, CAPTION + height + 2.0 * MARGIN], "", &svg)
}

/// All triangles that are seen, the farthest first.
fn body(mesh: &TriangleMesh, view: &View, [left, top]: [f64; 2]) -> String {
    let relief = Relief::of(mesh, view);
    let ([low_x, high_y], scale) = (relief.corner, view.scale);
    let mut svg = format!("<g stroke=\"#30404f\" stroke-width=\"{}\" stroke-linejoin=\"round\">\n", Short(relief.line_width));
    for facet in &relief.facets {
        let [a, b, c] = facet.corners.map(|[x, y]| [left + scale * (x - low_x), top + scale * (high_y - y)]);
        let mark = if facet.angles_deg.iter().any(|&angle| angle < THIN_DEG) {
            2
        } else {
            usize::from(facet.angles_deg.iter().any(|&angle| angle > OBTUSE_DEG))
        };
        let light = (AMBIENT + (1.0 - AMBIENT) * facet.light) * if facet.is_inside { DULL } else { 1.0 };
        let [red, green, blue] = COLOURS[mark].map(|full| (full * light).round() as u8);
        let _ = writeln!(
            svg,
            "<path d=\"M{} {}L{} {}L{} {}Z\" fill=\"#{red:02x}{green:02x}{blue:02x}\"/>",
            Short(a[0]),
            Short(a[1]),
            Short(b[0]),
            Short(b[1]),
            Short(c[0]),
            Short(c[1])
        );
    }
    svg.push_str("</g>\n");
    svg
}
