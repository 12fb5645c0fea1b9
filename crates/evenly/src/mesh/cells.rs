//! The dual of a mesh: the Voronoi cell of each vertex, clipped at the boundary.

use std::collections::HashMap;

use glam::DVec2;

use super::Mesh;
use crate::triangulation::circumcentre;

/// The Voronoi cell of each vertex as a polygon, counter-clockwise, in input units. Where a triangle at the boundary is obtuse there, its circumcentre lies outside, and the cells end at the boundary
/// instead; so they cover the domain, as long as no circumcentre lies farther out than that, as in thin triangles.
///
/// Where parts of the domain touch in a vertex, it has the cell of one of them.
pub fn mesh_cells(mesh: &Mesh) -> Vec<Vec<[f64; 2]>> {
    let Mesh { vertices, triangles, .. } = mesh;
    let at = |v: usize| DVec2::from(vertices[v]);
    // For each side of a triangle the triangle, and its place there.
    let mut sides: HashMap<[usize; 2], usize> = HashMap::with_capacity(3 * triangles.len());
    for (t, corners) in triangles.iter().enumerate() {
        for k in 0..3 {
            sides.insert([corners[k], corners[(k + 1) % 3]], t);
        }
    }
    let mut first = vec![None; vertices.len()];
    for corners in triangles {
        for k in 0..3 {
            let (v, to) = (corners[k], corners[(k + 1) % 3]);
            let is_boundary = !sides.contains_key(&[to, v]);
            if first[v].is_none() || is_boundary {
                first[v] = Some(to);
            }
        }
    }
    let cell_of = |(v, first): (usize, Option<usize>)| {
        let mut cell = Vec::new();
        let Some(first) = first else { return cell };
        let is_at_boundary = !sides.contains_key(&[first, v]);
        let mut to = first;
        // Counter-clockwise from triangle to triangle.
        while let Some(&t) = sides.get(&[v, to]) {
            let corners = triangles[t];
            let k = corners.iter().position(|&corner| corner == v).unwrap_or(0);
            let last = corners[(k + 2) % 3];
            if cell.is_empty() && is_at_boundary {
                cell.push(at(v));
            }
            let is_boundary = |a: usize, b: usize| !sides.contains_key(&[b, a]);
            add_corners(&mut cell, [at(v), at(to), at(last)], [is_boundary(v, to), is_boundary(to, last), is_boundary(last, v)]);
            to = last;
            if to == first {
                break;
            }
        }
        cell
    };
    first.into_iter().enumerate().map(cell_of).map(|cell: Vec<DVec2>| cell.into_iter().map(Into::into).collect()).collect()
}

/// Adds what triangle (v, b, c) adds to the cell of v: its circumcentre, and the middles of sides on the boundary; where the circumcentre lies behind one, the places where the bisectors end there.
fn add_corners(cell: &mut Vec<DVec2>, [v, b, c]: [DVec2; 3], [vb, bc, cv]: [bool; 3]) {
    // Relative to v, which may be far from 0.
    let (at, v, b, c) = (v, DVec2::ZERO, b - v, c - v);
    let centre = circumcentre(b, c);
    let is_behind = |from: DVec2, to: DVec2| (to - from).perp_dot(centre - from) < 0.0;
    // Where the bisector of p and q meets the side from `from` to `to`.
    let end = |p: DVec2, q: DVec2, from: DVec2, to: DVec2| {
        let (way, excess) = (q - p, 0.5 * (q.length_squared() - p.length_squared()));
        from + (to - from) * ((excess - way.dot(from)) / way.dot(to - from))
    };
    if vb && is_behind(v, b) {
        cell.push(at + end(v, c, v, b));
    } else if cv && is_behind(c, v) {
        cell.push(at + end(v, b, c, v));
        return;
    } else if bc && is_behind(b, c) {
        cell.extend([at + end(v, b, b, c), at + end(v, c, b, c)]);
    } else {
        if vb {
            cell.push(at + 0.5 * b);
        }
        cell.push(at + centre);
    }
    if cv {
        cell.push(at + 0.5 * c);
    }
}
