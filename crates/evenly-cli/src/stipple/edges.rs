//! The edges between dots, each once.

use std::collections::HashSet;

use evenly::Tessellation;

use crate::stipple_args::Edges;

/// The edges of a tessellation, as pairs of ends.
pub fn edges_of(tessellation: &Tessellation, edges: Edges) -> Vec<[[f64; 2]; 2]> {
    let polygons: Vec<&[[f64; 2]]> = match edges {
        Edges::Voronoi => tessellation.cells.iter().map(Vec::as_slice).collect(),
        Edges::Delaunay => tessellation.corners.iter().map(|corners| corners.as_slice()).collect(),
    };
    // The two sides of an edge find its ends by different ways, and so not quite the same.
    let key = |p: [f64; 2]| p.map(|x| (x * 1e6).round() as i64);
    let mut seen = HashSet::new();
    let mut lines = Vec::new();
    for polygon in polygons {
        for (k, &from) in polygon.iter().enumerate() {
            let to = polygon[(k + 1) % polygon.len()];
            let [a, b] = [key(from), key(to)];
            if a != b && seen.insert(if a < b { [a, b] } else { [b, a] }) {
                lines.push([from, to]);
            }
        }
    }
    lines
}
