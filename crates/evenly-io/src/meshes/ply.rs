//! Stanford's PLY, as text and binary. Colours are bytes; all other numbers are doubles.

use std::fmt::Write as _;

use super::cells::Cells;
use super::plain::push_row;
use crate::text::Shortest;

/// Attributes that are colours, from 0 to 255.
pub(crate) const COLOURS: [&str; 4] = ["red", "green", "blue", "alpha"];

/// Whether an attribute is a colour that bytes can hold.
fn is_colour((name, values): &(String, &[f64])) -> bool {
    COLOURS.contains(&name.as_str()) && values.iter().all(|value| (-0.5..255.5).contains(value))
}

fn header(cells: &Cells, encoding: &str, recipe: &str) -> String {
    let mut text = format!(
        "ply\nformat {encoding} 1.0\ncomment {recipe}\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n",
        cells.vertices.len()
    );
    for attribute in &cells.attributes {
        let kind = if is_colour(attribute) { "uchar" } else { "double" };
        let _ = writeln!(text, "property {kind} {}", attribute.0);
    }
    let _ = writeln!(text, "element face {}\nproperty list uchar int vertex_indices\nend_header", cells.triangles.len());
    text
}

pub(super) fn text(cells: &Cells, recipe: &str) -> String {
    let mut text = header(cells, "ascii", recipe);
    let is_colour: Vec<bool> = cells.attributes.iter().map(is_colour).collect();
    for (v, [x, y, z]) in cells.vertices.iter().enumerate() {
        let _ = write!(text, "{} {} {}", Shortest(*x), Shortest(*y), Shortest(*z));
        for ((_, values), &is_colour) in cells.attributes.iter().zip(&is_colour) {
            let value = if is_colour { values[v].round() } else { values[v] };
            let _ = write!(text, " {}", Shortest(value));
        }
        text.push('\n');
    }
    for &corners in cells.triangles {
        push_row(&mut text, "3 ", corners);
    }
    text
}

pub(super) fn binary(cells: &Cells, recipe: &str) -> Vec<u8> {
    let mut bytes = header(cells, "binary_little_endian", recipe).into_bytes();
    let is_colour: Vec<bool> = cells.attributes.iter().map(is_colour).collect();
    for (v, position) in cells.vertices.iter().enumerate() {
        position.iter().for_each(|x| bytes.extend(x.to_le_bytes()));
        for ((_, values), &is_colour) in cells.attributes.iter().zip(&is_colour) {
            if is_colour { bytes.push(values[v].round() as u8) } else { bytes.extend(values[v].to_le_bytes()) }
        }
    }
    for corners in cells.triangles {
        bytes.push(3);
        corners.iter().for_each(|&v| bytes.extend((v as i32).to_le_bytes()));
    }
    bytes
}
