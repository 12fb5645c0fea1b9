//! Moves of a vertex along the surface: it lands on the nearest place that a walk finds, and its triangles stay upright and fit the surface.

use glam::DVec3;

use super::cells::Territory;
use super::ground::SurfaceBuffer;
use super::live::LiveSurface;
use super::shape::Guard;
use crate::points::Random;
use crate::sweep::Ground;
use crate::triangulation::{BOUNDARY, Outside, Spoke};

/// A move turns no triangle by more than this: the cosine.
const LEAST_TURN: f64 = 0.3;
/// And leaves each at least this part of an equilateral one's area.
const ROOM: f64 = 0.02;
/// Where the whole way is blocked these parts of it are tried.
const PARTS: [f64; 3] = [1.0, 0.5, 0.25];

impl LiveSurface<'_> {
    /// Pushes what is dirty by up to so many spacings to any side; all of that, or what has been blocked. Of a vertex that stays, what stands around it.
    pub fn kick(&mut self, by: f64, is_all: bool, random: &mut Random) {
        let mut buffer = SurfaceBuffer::default();
        let mut pushed: Vec<u32> = (0..self.n_points() as u32).filter(|&v| self.is_dirty(v) && (is_all || self.n_blocked(v) > 0)).collect();
        for v in pushed.clone().into_iter().filter(|&v| self.is_fixed(v)) {
            self.walk_alone(v, &mut buffer.moving);
            pushed.extend(buffer.moving.iter().map(|spoke| spoke.vertex));
        }
        pushed.sort_unstable();
        pushed.dedup();
        for v in pushed {
            let way = DVec3::new(random.signed(), random.signed(), random.signed());
            // Nothing lies outside.
            let _ = self.go(v, by * self.local_spacing(v) * way, Territory::EVERYTHING, &mut buffer);
        }
    }

    /// Moves a vertex by a vector of space, or as far as it gets, and soils what stands around.
    pub(super) fn go(&self, v: u32, by: DVec3, territory: Territory, buffer: &mut SurfaceBuffer) -> Result<(), Outside> {
        if self.is_fixed(v) {
            return Ok(());
        }
        let ring = &mut buffer.moving;
        self.walk(v, territory, ring)?;
        if self.step(v, by, ring) {
            return Ok(());
        }
        // What is in the way may only be that the edges around are not Delaunay.
        let mut n_flips = 0;
        let restored = self.restore(v, territory, ring, &mut n_flips);
        buffer.n_flips += n_flips;
        restored?;
        let ring = &buffer.moving;
        let is_done = PARTS.iter().skip(usize::from(n_flips == 0)).any(|&part| self.step(v, part * by, ring));
        if !is_done {
            self.count_blocked(v);
        }
        Ok(())
    }

    /// Makes a move if its triangles allow it.
    pub(super) fn step(&self, v: u32, by: DVec3, ring: &[Spoke<DVec3>]) -> bool {
        let from = self.vertex(v);
        let to = self.land(&from, from.at + by);
        let way = to.at - from.at;
        let size = self.spacing() * to.size;
        // Twice the area.
        let room = ROOM * 0.5 * 3f64.sqrt() * size * size;
        let guard = Guard::after(self.n_blocked(v));
        let is_allowed = |(k, spoke): (usize, &Spoke<DVec3>)| {
            if spoke.half_edge == BOUNDARY {
                return true;
            }
            let after = ring.get(k + 1).unwrap_or(&ring[0]);
            let old = spoke.way.cross(after.way);
            let new = (spoke.way - way).cross(after.way - way);
            let (dot, squared) = (new.dot(old), new.length_squared());
            if !(squared > room * room && dot > 0.0 && dot * dot > LEAST_TURN * LEAST_TURN * squared * old.length_squared()) {
                return false;
            }
            let [b, c] = [spoke, after].map(|spoke| (!self.is_fixed(spoke.vertex)).then(|| self.normal(spoke.vertex)));
            let corners = [Some(to.normal), b, c];
            guard.holds(new, corners) || guard.allows(Guard::fit(old, [Some(from.normal), b, c]), Guard::fit(new, corners))
        };
        if !ring.iter().enumerate().all(is_allowed) {
            return false;
        }
        self.mesh.set_place(v, to.numbers());
        self.soil(v);
        ring.iter().for_each(|spoke| self.soil(spoke.vertex));
        true
    }
}
