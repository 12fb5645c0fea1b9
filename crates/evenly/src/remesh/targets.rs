//! The spacing that a mesh on a surface has, and whether it is what is wanted.

use std::collections::HashSet;

use super::live::LiveSurface;
use crate::geometry::spacing::triangle_side;
use crate::methods::PushPullParams;

/// Lengths that are off by less than this, in spacings, are as wanted.
const ROUNDING: f64 = 1e-9;

impl LiveSurface<'_> {
    /// Takes the spacing from the triangles as they are.
    pub fn renew_spacing(&mut self) {
        let n = self.mesh.n_half_edges() / 3;
        let of_triangle = |t: usize| {
            let corners = [0, 1, 2].map(|k| self.vertex(self.mesh.origin(3 * t as u32 + k)));
            let [a, b, c] = corners.map(|corner| corner.at);
            let scale = corners.iter().map(|corner| 1.0 / corner.size).sum::<f64>() / 3.0;
            0.5 * (b - a).cross(c - a).length() * scale * scale
        };
        let area: f64 = (0..n).map(of_triangle).sum();
        self.spacing = triangle_side(area, n as f64);
    }

    /// Whether each edge of each triangle is at least as long as is wanted there, and each circumradius at most as large.
    pub fn meets(&mut self, targets: &PushPullParams) -> bool {
        self.legalize();
        self.half_edges().triangles().all(|corners| self.is_met(corners, targets))
    }

    fn is_met(&self, corners: [u32; 3], targets: &PushPullParams) -> bool {
        let corners = corners.map(|v| self.vertex(v));
        let [a, b, c] = corners.map(|corner| corner.at);
        let scale = corners.iter().map(|corner| 1.0 / corner.size).sum::<f64>() / (3.0 * self.spacing);
        let edges = [a.distance(b), b.distance(c), c.distance(a)];
        let radius = edges.iter().product::<f64>() / (2.0 * (b - a).cross(c - a).length());
        let shortest = edges.into_iter().fold(f64::INFINITY, f64::min);
        targets.min_distance.is_none_or(|wanted| shortest * scale >= wanted - ROUNDING)
            && targets.coverage_radius.is_none_or(|wanted| radius * scale <= wanted + ROUNDING)
    }

    /// Lets go what stays off the creases, and is a corner of a triangle that does not meet the targets. Returns how many.
    pub fn release_missed(&mut self, targets: &PushPullParams) -> usize {
        let missing: Vec<[u32; 3]> = self.half_edges().triangles().filter(|&corners| !self.is_met(corners, targets)).collect();
        let on_creases: HashSet<u32> = self.bonds.iter().flatten().copied().collect();
        let held: HashSet<u32> = missing.into_iter().flatten().filter(|&v| self.is_fixed(v) && !on_creases.contains(&v)).collect();
        held.iter().for_each(|&v| self.release(v));
        held.len()
    }

    /// Lets go the anchors that find no rest.
    pub fn release_restless(&mut self) {
        let restless: Vec<u32> = self.anchors.iter().copied().filter(|&v| self.mesh.is_dirty(v)).collect();
        restless.into_iter().for_each(|v| self.release(v));
    }

    /// The largest circumradius over the shortest edge, once all edges are Delaunay; where sizes vary, of what is around one vertex.
    pub fn beta(&mut self) -> f64 {
        self.legalize();
        // The shortest edge at each vertex, or of all, and the largest circumradius there.
        let mut at = vec![(f64::INFINITY, 0f64); if self.is_uniform { 1 } else { self.mesh.n_vertices() }];
        for corners in self.half_edges().triangles() {
            let [a, b, c] = corners.map(|v| self.at(v));
            let [ab, bc, ca] = [a.distance(b), b.distance(c), c.distance(a)];
            let radius = ab * bc * ca / (2.0 * (b - a).cross(c - a).length());
            for (v, edge) in corners.into_iter().zip([ab.min(ca), ab.min(bc), bc.min(ca)]) {
                let (shortest, largest) = &mut at[if self.is_uniform { 0 } else { v as usize }];
                (*shortest, *largest) = (shortest.min(edge), largest.max(radius));
            }
        }
        at.into_iter().map(|(shortest, largest)| largest / shortest).fold(0.0, f64::max)
    }
}
