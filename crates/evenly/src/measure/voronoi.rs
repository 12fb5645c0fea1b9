//! Voronoi cells, clipped to the domain.

use glam::DVec2;

use crate::triangulation::{BOUNDARY, Triangulation, circumcentre, prev};

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

    /// Reads the cell of `vertex`; true if it stays clear of a boundary.
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
            if half_edges.twin[prev(h) as usize] == BOUNDARY {
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
