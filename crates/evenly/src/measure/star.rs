//! One vertex and its neighbours: distances, Voronoi cell, bond order.

use glam::DVec2;

use super::voronoi::CellReader;
use crate::triangulation::Triangulation;

/// What one vertex adds to the measures; lengths in normalised units.
pub(super) struct StarMeasures {
    /// Distance to the nearest neighbour.
    pub nearest: f64,
    /// Distance to the farthest corner of its Voronoi cell.
    pub reach: f64,
    /// Area of its Voronoi cell.
    pub capacity: f64,
    /// The squared distance from the vertex, integrated over its Voronoi cell.
    pub second_moment: f64,
    /// Whether its Voronoi cell stays clear of the boundary.
    pub is_inner: bool,
    pub valence: usize,
    /// Mean over its neighbours of exp(6 i theta).
    pub bond: DVec2,
    /// Sum over the edges between consecutive neighbours of exp(6 i theta).
    pub bond_edges: DVec2,
}

/// Reads stars into buffers of its own.
pub(super) struct StarReader<'a> {
    cells: CellReader<'a>,
}

impl<'a> StarReader<'a> {
    pub fn new(triangulation: &'a Triangulation, outgoing: &'a [u32]) -> Self {
        Self { cells: CellReader::new(triangulation, outgoing) }
    }

    pub fn read(&mut self, vertex: usize) -> StarMeasures {
        let is_inner = self.cells.read(vertex);
        StarMeasures::of(&self.cells.spokes, &self.cells.cell, is_inner)
    }
}

impl StarMeasures {
    /// Of the ways to the neighbours and the corners of the cell, both counter-clockwise.
    pub fn of(spokes: &[DVec2], cell: &[DVec2], is_inner: bool) -> Self {
        let shortest = spokes.iter().map(|s| s.length_squared()).fold(f64::INFINITY, f64::min);
        let farthest = cell.iter().map(|c| c.length_squared()).fold(0.0, f64::max);
        let bond: DVec2 = spokes.iter().map(|&s| sixfold(s)).sum();
        Self {
            nearest: shortest.sqrt(),
            reach: farthest.sqrt(),
            capacity: 0.5 * cyclic_pairs(cell).map(|(a, b)| a.perp_dot(b)).sum::<f64>(),
            second_moment: cyclic_pairs(cell)
                .map(|(a, b)| a.perp_dot(b) * (a.length_squared() + a.dot(b) + b.length_squared()) / 12.0)
                .sum(),
            is_inner,
            valence: spokes.len(),
            bond: bond / spokes.len() as f64,
            bond_edges: cyclic_pairs(spokes).map(|(a, b)| sixfold(b - a)).sum(),
        }
    }
}

/// exp(6 i theta) for a vector of angle theta, without trigonometry.
fn sixfold(v: DVec2) -> DVec2 {
    let z = v.normalize_or_zero();
    let cube = z.rotate(z).rotate(z);
    cube.rotate(cube)
}

fn cyclic_pairs(items: &[DVec2]) -> impl Iterator<Item = (DVec2, DVec2)> {
    items.iter().copied().zip(items.iter().copied().cycle().skip(1))
}
