//! Voronoi cells, clipped to the domain; and the triangulation in the caller's terms, for pictures.

use glam::DVec2;

use super::Distinct;
use crate::triangulation::{BORDER, Triangulation, circumcentre, prev};
use crate::{Error, PointSet};

/// Reads the Voronoi cell of a vertex into buffers of its own; everything relative to the vertex.
pub(super) struct CellReader<'a> {
    triangulation: &'a Triangulation,
    outgoing: &'a [u32],
    /// The ways to the neighbours, counter-clockwise.
    pub spokes: Vec<DVec2>,
    /// The corners of the cell, counter-clockwise.
    pub cell: Vec<DVec2>,
    clipped: Vec<DVec2>,
}

impl<'a> CellReader<'a> {
    pub fn new(triangulation: &'a Triangulation, outgoing: &'a [u32]) -> Self {
        Self { triangulation, outgoing, spokes: Vec::new(), cell: Vec::new(), clipped: Vec::new() }
    }

    /// Reads the cell of `vertex`; true if it stays clear of a border.
    pub fn read(&mut self, vertex: usize) -> bool {
        let Triangulation { half_edges, positions, domain, .. } = self.triangulation;
        let site = positions[vertex];
        let spoke = |v: u32| domain.spoke(site, positions[v as usize]);
        self.spokes.clear();
        self.cell.clear();
        let mut is_clear = true;
        for h in half_edges.around(self.outgoing[vertex]) {
            let (u, v) = (spoke(half_edges.target(h)), spoke(half_edges.origin[prev(h) as usize]));
            let centre = circumcentre(u, v);
            self.spokes.push(u);
            self.cell.push(centre);
            is_clear &= domain.is_periodic || domain.contains(site + centre);
            if half_edges.twin[prev(h) as usize] == BORDER {
                self.spokes.push(v);
                is_clear = false;
            }
        }
        if !is_clear {
            self.clip(site);
        }
        is_clear
    }

    /// Cuts the cell out of the whole domain, by the bisector with each neighbour.
    fn clip(&mut self, site: DVec2) {
        let (low, high) = (-site, self.triangulation.domain.size - site);
        self.cell.clear();
        self.cell.extend([low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)]);
        for &spoke in &self.spokes {
            // Inside is where x . s <= s . s / 2.
            let excess = |x: DVec2| x.dot(spoke) - 0.5 * spoke.length_squared();
            self.clipped.clear();
            for (i, &a) in self.cell.iter().enumerate() {
                let b = self.cell[(i + 1) % self.cell.len()];
                let (at_a, at_b) = (excess(a), excess(b));
                if at_a <= 0.0 {
                    self.clipped.push(a);
                }
                if (at_a < 0.0 && at_b > 0.0) || (at_a > 0.0 && at_b < 0.0) {
                    self.clipped.push(a + (b - a) * (at_a / (at_a - at_b)));
                }
            }
            std::mem::swap(&mut self.cell, &mut self.clipped);
        }
    }
}

/// A point set's Delaunay triangulation and Voronoi diagram, in input units and in the caller's order of points.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// Delaunay triangles as triples of point indices, counter-clockwise; in a rectangle the dual of the clipped Voronoi diagram.
    pub triangles: Vec<[usize; 3]>,
    /// Corners of each triangle. On a torus the second and third are the images nearest to the first, perhaps outside the domain.
    pub corners: Vec<[[f64; 2]; 3]>,
    /// The Voronoi cell of each point, counter-clockwise; on a torus around the point, perhaps outside the domain.
    /// Of coincident points all but one have none.
    pub cells: Vec<Vec<[f64; 2]>>,
    /// The number of Delaunay neighbours of each point; `None` where a cell reaches the border, or a point shares its place.
    pub valence: Vec<Option<usize>>,
}

/// Triangulates a set of at least three points, not all on one line.
///
/// # Errors
/// [`Error::Degenerate`] for fewer points, or where a rectangle's points all lie on one line.
pub fn mesh(points: &PointSet) -> Result<Mesh, Error> {
    let Distinct { triangulation, .. } = Distinct::triangulate(points)?;
    let n_base = triangulation.n_base();
    let index = |v: u32| triangulation.order[v as usize % n_base] as usize;
    let outward = |p: DVec2| {
        let origin = points.space().origin();
        [origin[0] + triangulation.domain.restore_length(p.x), origin[1] + triangulation.domain.restore_length(p.y)]
    };
    let mut mesh = Mesh {
        triangles: Vec::new(),
        corners: Vec::new(),
        cells: vec![Vec::new(); points.n_points()],
        valence: vec![None; points.n_points()],
    };
    for corners in triangulation.clipped().triangles() {
        // Of a triangle's copies on a cover, that one counts whose first vertex, in the order of base vertices, is no copy.
        let turned = |k: usize| [corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]];
        let Some(corners) = (0..3).map(turned).min_by_key(|t| t.map(|v| v as usize % n_base)) else { continue };
        if corners[0] as usize >= n_base {
            continue;
        }
        let (u, v) = triangulation.spokes(corners);
        let first = triangulation.positions[corners[0] as usize];
        mesh.triangles.push(corners.map(index));
        mesh.corners.push([outward(first), outward(first + u), outward(first + v)]);
    }
    let outgoing = triangulation.half_edges.outgoing(triangulation.positions.len());
    let mut reader = CellReader::new(&triangulation, &outgoing);
    for vertex in 0..n_base {
        let is_clear = reader.read(vertex);
        let site = triangulation.positions[vertex];
        let point = index(vertex as u32);
        mesh.cells[point] = reader.cell.iter().map(|&c| outward(site + c)).collect();
        mesh.valence[point] = is_clear.then_some(reader.spokes.len());
    }
    Ok(mesh)
}
