//! Anchors: vertices that are put where the surface stands out farther from the mesh than is allowed, and stay there.

use glam::DVec3;
use rayon::prelude::*;

use super::cells::Territory;
use super::ground::SurfaceBuffer;
use super::live::LiveSurface;
use crate::surface::Facets;
use crate::sweep::Ground;

/// Anchors are so many spacings away from each other, and from what stays otherwise.
const APART: f64 = 1.3;
/// One that lands so near, in spacings, has arrived.
const ARRIVED: f64 = 1e-6;

impl LiveSurface<'_> {
    /// Puts the nearest vertex to each place of the surface that is farther than `tolerance` spacings from the mesh, the farthest first; where the spacing is wider than the
    /// mean, the mean counts. Returns how many it has put.
    pub fn anchor(&mut self, tolerance: f64) -> usize {
        let corners: Vec<[u32; 3]> = self.half_edges().triangles().collect();
        let facets = Facets::new(corners.iter().map(|t| t.map(|v| self.at(v))).collect());
        // How far each vertex of the surface is, in spacings, and the triangle that is nearest.
        let far = |&p: &DVec3| {
            let (t, distance) = facets.nearest(p)?;
            let spacing = self.local_spacing(corners[t][0]).min(self.spacing());
            (distance > tolerance * spacing).then_some((distance / spacing, t, p))
        };
        let mut places: Vec<(f64, usize, DVec3)> = self.surface_points().par_iter().filter_map(far).collect();
        places.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        // An anchor near which the surface stands out may stand at a better place.
        let is_near = |&v: &u32| places.iter().any(|(.., p)| self.at(v).distance(*p) < APART * self.local_spacing(v));
        let misplaced: Vec<u32> = self.anchors.iter().copied().filter(is_near).collect();
        misplaced.into_iter().for_each(|v| self.loosen(v));
        let fixed = (0..self.n_points() as u32).filter(|&v| self.is_fixed(v));
        let mut kept: Vec<DVec3> = fixed.map(|v| self.at(v)).collect();
        let n_fixed = kept.len();
        let mut buffer = SurfaceBuffer::default();
        for (_, t, p) in places {
            let mut free: Vec<u32> = corners[t].into_iter().filter(|&v| !self.is_fixed(v)).collect();
            free.sort_by(|&a, &b| self.at(a).distance(p).total_cmp(&self.at(b).distance(p)));
            let is_clear = |v: u32| kept.iter().all(|other| other.distance(p) >= APART * self.local_spacing(v));
            let put = free.into_iter().filter(|&v| is_clear(v)).find(|&v| self.put(v, p, &mut buffer));
            if let Some(v) = put {
                self.fix(v);
                self.anchors.push(v);
                kept.push(p);
            }
        }
        kept.len() - n_fixed
    }

    /// Puts a vertex at a place of the surface, or leaves it where it is.
    fn put(&self, v: u32, p: DVec3, buffer: &mut SurfaceBuffer) -> bool {
        let from = self.vertex(v);
        let way = p - from.at;
        if self.land(&from, p).at.distance(p) > ARRIVED * self.local_spacing(v) {
            return false;
        }
        let SurfaceBuffer { moving, n_flips, .. } = buffer;
        self.walk_alone(v, moving);
        if self.step(v, way, moving) {
            return true;
        }
        // What is in the way may only be that the edges around are not Delaunay.
        let _ = self.restore(v, Territory::EVERYTHING, moving, n_flips);
        self.step(v, way, moving)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::remesh::start::{Wanted, start};
    use crate::surface::{Features, Surface, TriangleMesh};

    /// A thin star of eight points, which a coarse mesh cannot follow.
    fn star() -> Surface {
        let n = 16;
        let rim = (0..n).map(|k| {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(k) / f64::from(n));
            let radius = if k % 2 == 0 { 1.0 } else { 0.4 };
            [radius * cos, radius * sin, 0.0]
        });
        let vertices = [[0.0, 0.0, 0.1], [0.0, 0.0, -0.1]].into_iter().chain(rim).collect();
        let at = |k: usize| 2 + k % n as usize;
        let triangles = (0..n as usize).flat_map(|k| [[0, at(k), at(k + 1)], [1, at(k + 1), at(k)]]).collect();
        Surface::new(&TriangleMesh { vertices, triangles, attributes: Vec::new() }).unwrap()
    }

    #[test]
    fn a_place_that_cannot_be_reached_leaves_the_mesh_as_it_was() {
        let surface = star();
        let (features, sizes) = (Features::boundaries(&surface), vec![1.0; surface.n_vertices()]);
        for (n, seed) in (40..80).zip(0..) {
            let start =
                start(Wanted { surface: &surface, features: &features, sizes: &sizes, n_points: n, has_rows: false, given: &[], seed })
                    .unwrap()
                    .unwrap();
            let mut live = LiveSurface::new(&surface, &features, &sizes, start);
            live.legalize();
            let places = |live: &LiveSurface| (0..n as u32).map(|v| live.at(v)).collect::<Vec<_>>();
            let before = places(&live);
            let n_put = live.anchor(0.05);
            let n_moved = places(&live).iter().zip(&before).filter(|(a, b)| a != b).count();
            assert_eq!(n_moved, n_put, "{n}");
        }
    }
}
