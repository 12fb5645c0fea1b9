//! The formats of modellers: Wavefront and Geomview's, as text, and stereolithography.

use std::fmt::Write as _;

use super::cells::Cells;
use crate::text::Shortest;

/// Adds a line with a position, after the word that begins it.
pub(super) fn push_position(text: &mut String, word: &str, [x, y, z]: [f64; 3]) {
    let _ = writeln!(text, "{word}{} {} {}", Shortest(x), Shortest(y), Shortest(z));
}

/// Adds a line of whole numbers, after the word that begins it.
pub(super) fn push_row<const N: usize>(text: &mut String, word: &str, numbers: [usize; N]) {
    text.push_str(word);
    for (k, number) in numbers.into_iter().enumerate() {
        let _ = write!(text, "{}{number}", if k > 0 { " " } else { "" });
    }
    text.push('\n');
}

pub(super) fn obj(cells: &Cells, recipe: &str) -> String {
    let mut text = format!("# {recipe}\n");
    for &position in &*cells.vertices {
        push_position(&mut text, "v ", position);
    }
    for corners in cells.triangles {
        push_row(&mut text, "f ", corners.map(|v| v + 1));
    }
    text
}

pub(super) fn off(cells: &Cells, recipe: &str) -> String {
    let mut text = format!("OFF\n# {recipe}\n{} {} 0\n", cells.vertices.len(), cells.triangles.len());
    for &position in &*cells.vertices {
        push_position(&mut text, "", position);
    }
    for &corners in cells.triangles {
        push_row(&mut text, "3 ", corners);
    }
    text
}

/// Single precision is all that the format has.
pub(super) fn stl(cells: &Cells) -> Vec<u8> {
    let mut bytes = vec![0u8; 80];
    bytes[..6].copy_from_slice(b"evenly");
    bytes.extend((cells.triangles.len() as u32).to_le_bytes());
    for t in cells.triangles {
        let corners = t.map(|v| cells.vertices[v]);
        for x in [normal(corners)].into_iter().chain(corners).flatten() {
            bytes.extend((x as f32).to_le_bytes());
        }
        bytes.extend([0, 0]);
    }
    bytes
}

/// Of length one; nothing for a triangle that has none.
fn normal([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let side = |p: [f64; 3]| [p[0] - a[0], p[1] - a[1], p[2] - a[2]];
    let ([ux, uy, uz], [vx, vy, vz]) = (side(b), side(c));
    let n = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    let length = n.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length > 0.0 && length.is_finite() { n.map(|x| x / length) } else { [0.0; 3] }
}
