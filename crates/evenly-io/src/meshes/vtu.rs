//! VTK's unstructured grid, as text.

use std::fmt::Write as _;

use super::cells::Cells;
use super::plain::{push_position, push_row};
use crate::text::Shortest;

/// Triangles, and after them the edges of the boundary and of lines; the cell array `tag` tells which, and `region` in which region triangles lie, -1 for none.
pub(super) fn vtu(cells: &Cells, recipe: &str) -> String {
    let (n, n_triangles, n_edges) = (cells.vertices.len(), cells.triangles.len(), cells.edges.len());
    let comment = recipe.replace("--", "- -");
    let mut text = format!(
        "<?xml version=\"1.0\"?>\n<!-- {comment} -->\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"{n}\" NumberOfCells=\"{}\">\n\
         <Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n",
        n_triangles + n_edges
    );
    for &position in &*cells.vertices {
        push_position(&mut text, "", position);
    }
    text.push_str("</DataArray>\n</Points>\n<Cells>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n");
    for &corners in cells.triangles {
        push_row(&mut text, "", corners);
    }
    for &(_, ends) in &cells.edges {
        push_row(&mut text, "", ends);
    }
    text.push_str("</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n");
    let ends = (1..=n_triangles).map(|k| 3 * k).chain((1..=n_edges).map(|k| 3 * n_triangles + 2 * k));
    ends.for_each(|end| push_row(&mut text, "", [end]));
    text.push_str("</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n");
    text.push_str(&"5\n".repeat(n_triangles));
    text.push_str(&"3\n".repeat(n_edges));
    text.push_str("</DataArray>\n</Cells>\n");
    if !cells.attributes.is_empty() {
        text.push_str("<PointData>\n");
        for (name, values) in &cells.attributes {
            let _ = writeln!(text, "<DataArray type=\"Float64\" Name=\"{name}\" format=\"ascii\">");
            for &value in *values {
                let _ = writeln!(text, "{}", Shortest(value));
            }
            text.push_str("</DataArray>\n");
        }
        text.push_str("</PointData>\n");
    }
    if n_edges > 0 {
        text.push_str("<CellData Scalars=\"tag\">\n<DataArray type=\"Int64\" Name=\"tag\" format=\"ascii\">\n");
        text.push_str(&"0\n".repeat(n_triangles));
        cells.edges.iter().for_each(|&(tag, _)| push_row(&mut text, "", [tag]));
        text.push_str("</DataArray>\n");
        if !cells.regions.is_empty() {
            text.push_str("<DataArray type=\"Int64\" Name=\"region\" format=\"ascii\">\n");
            for &region in cells.regions {
                let _ = writeln!(text, "{}", region as i32);
            }
            text.push_str(&"-1\n".repeat(n_edges));
            text.push_str("</DataArray>\n");
        }
        text.push_str("</CellData>\n");
    }
    text.push_str("</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    text
}
