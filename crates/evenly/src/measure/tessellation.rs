//! The triangulation and the Voronoi cells in the caller's terms, for pictures.

use glam::DVec2;

use super::distinct::Distinct;
use super::sight::look;
use super::voronoi::CellReader;
use crate::error::Error;
use crate::points::PointSet;
use crate::triangulation::{clipped, triangles_seen};

/// A point set's Delaunay triangulation and Voronoi diagram, in input units and in the caller's order of points.
#[derive(Debug, Clone, PartialEq)]
pub struct Tessellation {
    /// Delaunay triangles as triples of point indices, counter-clockwise; in a rectangle and in a polygon the dual of the clipped Voronoi diagram.
    pub triangles: Vec<[usize; 3]>,
    /// Corners of each triangle. On a torus the second and third are the images nearest to the first, perhaps outside the domain.
    pub corners: Vec<[[f64; 2]; 3]>,
    /// The Voronoi cell of each point, counter-clockwise; on a torus around the point, perhaps outside the domain.
    /// Of coincident points all but one have none.
    pub cells: Vec<Vec<[f64; 2]>>,
    /// The number of Delaunay neighbours of each point; `None` where a cell reaches the boundary, or a point shares its place.
    pub valence: Vec<Option<usize>>,
}

/// Triangulates a set of at least three points, not all on one line.
///
/// # Errors
/// [`Error::Degenerate`] for fewer points, or where a rectangle's points all lie on one line.
pub fn tessellate(points: &PointSet) -> Result<Tessellation, Error> {
    let distinct = Distinct::triangulate(points)?;
    let triangulation = &distinct.triangulation;
    let mut live = triangulation.domain.boundary.as_ref().map(|_| distinct.live(None)).transpose()?;
    let n_base = triangulation.n_base();
    let index = |v: u32| triangulation.order[v as usize % n_base] as usize;
    let outward = |p: DVec2| {
        let origin = points.space().origin();
        [origin[0] + triangulation.domain.restore_length(p.x), origin[1] + triangulation.domain.restore_length(p.y)]
    };
    let mut tessellation = Tessellation {
        triangles: Vec::new(),
        corners: Vec::new(),
        cells: vec![Vec::new(); points.n_points()],
        valence: vec![None; points.n_points()],
    };
    let clipped = live.as_mut().map_or_else(|| clipped(triangulation), triangles_seen)?;
    for corners in clipped.triangles() {
        // Of a triangle's copies on a cover, that one counts whose first vertex, in the order of base vertices, is no copy.
        let turned = |k: usize| [corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]];
        let Some(corners) = (0..3).map(turned).min_by_key(|t| t.map(|v| v as usize % n_base)) else { continue };
        if corners[0] as usize >= n_base {
            continue;
        }
        let (u, v) = triangulation.spokes(corners);
        let first = triangulation.positions[corners[0] as usize];
        tessellation.triangles.push(corners.map(index));
        tessellation.corners.push([outward(first), outward(first + u), outward(first + v)]);
    }
    if let Some(live) = &mut live {
        let seen = look(live, f64::INFINITY, |seen| (seen.cell.to_vec(), seen.is_inner.then_some(seen.spokes.len())))?;
        for (vertex, (cell, valence)) in seen.into_iter().enumerate() {
            let (site, point) = (triangulation.positions[vertex], index(vertex as u32));
            tessellation.cells[point] = cell.into_iter().map(|c| outward(site + c)).collect();
            tessellation.valence[point] = valence;
        }
        return Ok(tessellation);
    }
    let outgoing = triangulation.half_edges.outgoing(triangulation.positions.len());
    let mut reader = CellReader::new(triangulation, &outgoing);
    for vertex in 0..n_base {
        let is_clear = reader.read(vertex);
        let site = triangulation.positions[vertex];
        let point = index(vertex as u32);
        tessellation.cells[point] = reader.cell.iter().map(|&c| outward(site + c)).collect();
        tessellation.valence[point] = is_clear.then_some(reader.spokes.len());
    }
    Ok(tessellation)
}
