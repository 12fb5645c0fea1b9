//! Flips: edges become the other diagonals where the angles across exceed pi, by true lengths.

use glam::DVec3;
use rayon::prelude::*;

use super::cells::Territory;
use super::live::LiveSurface;
use super::shape::{Guard, is_delaunay};
use crate::triangulation::{BOUNDARY, Outside, Spoke, next, prev};

impl LiveSurface<'_> {
    /// Goes around `v`, and flips its spokes until none is to be.
    pub(super) fn restore(&self, v: u32, territory: Territory, ring: &mut Vec<Spoke<DVec3>>, n_flips: &mut usize) -> Result<(), Outside> {
        loop {
            self.walk(v, territory, ring)?;
            measure(ring);
            let Some(h) = self.find_illegal(ring) else { return Ok(()) };
            self.flip(h);
            *n_flips += 1;
        }
    }

    /// A spoke that is to be flipped.
    fn find_illegal(&self, ring: &[Spoke<DVec3>]) -> Option<u32> {
        let mut before = &ring[ring.len() - 1];
        for (k, spoke) in ring.iter().enumerate() {
            let after = ring.get(k + 1).unwrap_or(&ring[0]);
            // The sine of the sum of both angles across, up to a factor.
            let sine = (after.squared - spoke.dot) * before.cross + (before.squared - before.dot) * spoke.cross;
            if sine < 0.0 && spoke.half_edge != BOUNDARY && before.half_edge != BOUNDARY && self.should_flip(spoke.half_edge) {
                return Some(spoke.half_edge);
            }
            before = spoke;
        }
        None
    }

    /// Whether the edge of `h` is not Delaunay, and the other diagonal can be.
    fn should_flip(&self, h: u32) -> bool {
        if self.mesh.twin(h) == BOUNDARY {
            return false;
        }
        let [p, q, r, s] = self.mesh.quadrilateral(h);
        let [a, b, c, d] = [p, q, r, s].map(|v| self.at(v));
        !is_delaunay([a, b, c, d]) && self.can_flip([p, q, r, s])
    }

    /// Whether the edge between the first two corners may become that between the last two.
    pub(super) fn can_flip(&self, corners: [u32; 4]) -> bool {
        if !self.can_join(corners) {
            return false;
        }
        let n_blocked = corners.map(|v| self.n_blocked(v)).into_iter().max();
        let normals = corners.map(|v| (!self.is_fixed(v)).then(|| self.normal(v)));
        Guard::after(n_blocked.unwrap_or(0)).allows_flip(corners.map(|v| self.at(v)), normals)
    }

    /// The same, whatever comes of the triangles.
    pub(super) fn can_join(&self, [p, q, r, s]: [u32; 4]) -> bool {
        r != s && !self.is_bond(p, q) && !self.are_neighbours(r, s)
    }

    fn are_neighbours(&self, a: u32, b: u32) -> bool {
        let first = self.mesh.outgoing(a);
        let mut h = first;
        loop {
            let (after, turned) = self.mesh.turn(h);
            if self.mesh.origin(next(h)) == b || after == b {
                return true;
            }
            if turned == first || turned == BOUNDARY {
                return false;
            }
            h = turned;
        }
    }

    pub(super) fn flip(&self, h: u32) {
        self.mesh.quadrilateral(h).into_iter().for_each(|v| self.soil(v));
        self.mesh.flip(h);
    }

    /// Flips until all edges are Delaunay that can be. Returns how often.
    pub fn legalize(&mut self) -> usize {
        let mut n_flips = 0;
        loop {
            let all = 0..self.mesh.n_half_edges() as u32;
            let mut suspects: Vec<u32> = all.into_par_iter().filter(|&h| self.should_flip(h)).collect();
            if suspects.is_empty() {
                return n_flips;
            }
            while let Some(h) = suspects.pop() {
                if self.should_flip(h) {
                    let t = self.mesh.twin(h);
                    self.flip(h);
                    suspects.extend([h, t, next(h), next(t), prev(h), prev(t)]);
                    n_flips += 1;
                }
            }
        }
    }
}

/// Finds the lengths of spokes, and the angles between them.
fn measure(ring: &mut [Spoke<DVec3>]) {
    let first = ring[0].way;
    for k in 0..ring.len() {
        let after = ring.get(k + 1).map_or(first, |spoke| spoke.way);
        let spoke = &mut ring[k];
        spoke.squared = spoke.way.length_squared();
        if spoke.half_edge != BOUNDARY {
            (spoke.dot, spoke.cross) = (spoke.way.dot(after), spoke.way.cross(after).length());
        }
    }
}
