//! Corners that lie near to each other become one, and boundaries that nearly touch are found.

use std::collections::HashMap;

use glam::DVec3;

use super::Surface;
use super::triangle_mesh::TriangleMesh;
use crate::triangulation::BOUNDARY;

/// Boundaries nearer to each other than this, in mean lengths of their edges, were meant to be one.
const NEAR: f64 = 1e-3;

/// Places by cells of a grid, so that near ones are found.
struct Grid {
    side: f64,
    cells: HashMap<[i64; 3], Vec<usize>>,
}

impl Grid {
    fn new(side: f64) -> Self {
        Self { side, cells: HashMap::new() }
    }

    fn cell(&self, p: DVec3) -> [i64; 3] {
        (p / self.side).floor().to_array().map(|x| x as i64)
    }

    fn add(&mut self, k: usize, p: DVec3) {
        let cell = self.cell(p);
        self.cells.entry(cell).or_default().push(k);
    }

    /// All that were added within a side of a place, and some more.
    fn near(&self, p: DVec3) -> impl Iterator<Item = usize> {
        let [x, y, z] = self.cell(p);
        let offsets = (-1..=1).flat_map(|i| (-1..=1).flat_map(move |j| (-1..=1).map(move |k| [i, j, k])));
        offsets.filter_map(move |[i, j, k]| self.cells.get(&[x + i, y + j, z + k])).flatten().copied()
    }
}

impl TriangleMesh {
    /// The mesh with each vertex at the place of the first that lies within `tolerance` of it, in the mesh'
    /// units, and how many vertices have moved so. [`Surface::new`] makes one vertex of those in one place.
    pub fn welded(&self, tolerance: f64) -> (Self, usize) {
        let mut welded = self.clone();
        let mut n_moved = 0;
        let mut grid = Grid::new(tolerance.max(f64::MIN_POSITIVE));
        for (v, position) in welded.vertices.iter_mut().enumerate() {
            let p = DVec3::from(*position);
            if !p.is_finite() {
                continue;
            }
            let first = grid.near(p).filter(|&other| DVec3::from(self.vertices[other]).distance(p) <= tolerance).min();
            match first {
                Some(first) => {
                    n_moved += usize::from(self.vertices[first] != *position);
                    *position = self.vertices[first];
                }
                None => grid.add(v, p),
            }
        }
        (welded, n_moved)
    }
}

impl Surface {
    /// How many vertices of boundaries lie so near to another one, which is no neighbour, that both were meant to be one, and how far at most, in input
    /// units; `None` where there are none. [`TriangleMesh::welded`] joins them.
    pub fn near_boundaries(&self) -> Option<(usize, f64)> {
        near_boundaries(self).map(|(n, distance)| (n, self.frame.length_outward(distance)))
    }
}

/// The same in the surface's own units.
fn near_boundaries(surface: &Surface) -> Option<(usize, f64)> {
    let mesh = &surface.half_edges;
    let boundary: Vec<u32> = (0..mesh.origin.len() as u32).filter(|&h| mesh.twin[h as usize] == BOUNDARY).collect();
    let ends = |&h: &u32| [mesh.origin[h as usize], mesh.target(h)].map(|v| v as usize);
    let lengths = boundary.iter().map(|h| {
        let [a, b] = ends(h);
        surface.points[a].distance(surface.points[b])
    });
    let near = NEAR * lengths.sum::<f64>() / boundary.len() as f64;
    if boundary.is_empty() || near <= 0.0 {
        return None;
    }
    let mut grid = Grid::new(near);
    boundary.iter().for_each(|&h| grid.add(mesh.origin[h as usize] as usize, surface.points[mesh.origin[h as usize] as usize]));
    let (mut n, mut largest) = (0, 0.0f64);
    for h in &boundary {
        let [v, after] = ends(h);
        let p = surface.points[v];
        let others = grid.near(p).filter(|&other| other != v && other != after).map(|other| surface.points[other].distance(p));
        let nearest = others.filter(|&distance| distance > 0.0 && distance <= near).fold(f64::INFINITY, f64::min);
        if nearest.is_finite() {
            n += 1;
            largest = largest.max(nearest);
        }
    }
    (n > 0).then_some((n, largest))
}
