//! Anchors: vertices that are put where the surface stands out farther from the mesh than is allowed, and stay there.

use glam::DVec3;
use rayon::prelude::*;

use super::live::{LiveSurface, SurfaceBuffer};
use crate::surface::Facets;
use crate::sweep::Ground;

/// Anchors are so many spacings away from each other, and from what stays otherwise.
const APART: f64 = 3.0;
/// One that lands so near, in spacings, has arrived.
const ARRIVED: f64 = 1e-6;

impl LiveSurface<'_> {
    /// Puts the nearest vertex to each place of the surface that is farther than `tolerance` spacings from the mesh, the farthest first. Returns how many it has put.
    pub fn anchor(&mut self, tolerance: f64) -> usize {
        let corners: Vec<[u32; 3]> = self.half_edges().triangles().collect();
        let facets = Facets::new(corners.iter().map(|t| t.map(|v| self.at(v))).collect());
        // How far each vertex of the surface is, in the spacings there, and the triangle that is nearest.
        let far = |&p: &DVec3| {
            let (t, distance) = facets.nearest(p)?;
            let spacing = self.local_spacing(corners[t][0]);
            (distance > tolerance * spacing).then_some((distance / spacing, t, p))
        };
        let mut places: Vec<(f64, usize, DVec3)> = self.surface_points().par_iter().filter_map(far).collect();
        places.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let fixed = (0..self.n_points() as u32).filter(|&v| self.is_fixed(v));
        let mut kept: Vec<DVec3> = fixed.map(|v| self.at(v)).collect();
        let n_fixed = kept.len();
        let mut buffer = SurfaceBuffer::default();
        for (_, t, p) in places {
            let mut free: Vec<u32> = corners[t].into_iter().filter(|&v| !self.is_fixed(v)).collect();
            free.sort_by(|&a, &b| self.at(a).distance(p).total_cmp(&self.at(b).distance(p)));
            let is_clear = |v: u32| kept.iter().all(|other| other.distance(p) >= APART * self.local_spacing(v));
            let put = free.into_iter().filter(|&v| is_clear(v)).find(|&v| {
                self.go(v, p - self.at(v), &mut buffer);
                self.at(v).distance(p) < ARRIVED * self.local_spacing(v)
            });
            if let Some(v) = put {
                self.fix(v);
                kept.push(p);
            }
        }
        kept.len() - n_fixed
    }
}
