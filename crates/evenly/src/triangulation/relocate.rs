//! Moving a vertex, lazily: its triangles must stay upright, that they are Delaunay is seen to where they are next read.
//!
//! Where a triangle would get thin or turn over, the vertex goes in stages, each nine tenths of the way to the first triangle that
//! loses its area, and the edges around it are made Delaunay in between. It stops where that flips nothing: another vertex is in its way.

use std::sync::atomic::Ordering::Relaxed;

use glam::DVec2;

use super::half_edges::{BOUNDARY, next};
use super::live::{LiveMesh, Outside};
use super::shared::Territory;
use super::stars::StarBuffer;

/// A quick move leaves every triangle this share of the mean area.
const ROOM: f64 = 0.02;
/// The part of the way to the first triangle without area that a stage goes.
const STAGE: f64 = 0.9;
/// Points on a rail come no nearer to each other than this, in normalised units.
const LEAST_GAP: f64 = 1e-10;
/// More stages than ever needed: a vertex that is not there by then stays where it is.
const MAX_STAGES: usize = 40;

impl LiveMesh {
    /// Moves a point, and all of its copies, by the vector `by`, and soils what stands around; or as far as it gets.
    ///
    /// Where that reaches out of the territory, some of the way may have been made.
    pub fn relocate(&self, point: u32, by: DVec2, territory: Territory, buffer: &mut StarBuffer) -> Result<(), Outside> {
        self.relocated::<false>(point, by, territory, buffer)
    }

    /// The same, in a [plain](Self::is_plain) mesh if `PLAIN`: then nothing but that is looked at.
    pub fn relocated<const PLAIN: bool>(
        &self,
        point: u32,
        by: DVec2,
        territory: Territory,
        buffer: &mut StarBuffer,
    ) -> Result<(), Outside> {
        debug_assert!(self.is_free(point, territory));
        if PLAIN {
            let by = by.clamp(-0.5 * self.domain.size, 0.5 * self.domain.size);
            return self.go::<true>(point, self.domain.land(self.mesh.position(point) + by), territory, buffer);
        }
        if self.is_fixed(point) {
            return Ok(());
        }
        let from = self.mesh.position(point);
        // Where next to no density is wanted, a spacing may be longer than the domain.
        let by = by.clamp(-0.5 * self.domain.size, 0.5 * self.domain.size);
        let target = self.land(point, from, from + by);
        let target = if self.is_on_rail(point) { self.keep_order(point, target, territory, buffer)? } else { target };
        self.go::<false>(point, target, territory, buffer)?;
        if self.is_cover() {
            // On the grid, so that copies move alike to the bit.
            let (by, went) = (self.domain.spoke(from, target), self.domain.spoke(from, self.mesh.position(point)));
            for copy in (point..self.n_live).step_by(self.n_points()).skip(1) {
                let from = self.mesh.position(copy);
                self.go::<false>(copy, self.domain.land(from + by), territory, buffer)?;
                if self.domain.spoke(from, self.mesh.position(copy)) != went {
                    self.is_torn.store(true, Relaxed);
                }
            }
        }
        Ok(())
    }

    fn is_on_rail(&self, point: u32) -> bool {
        self.held.as_ref().is_some_and(|held| held.is_on_rail(point))
    }

    /// Where a vertex on a rail may go so that it stays between its neighbours there, whatever rounding makes of triangles that are nearly flat.
    fn keep_order(&self, v: u32, target: DVec2, territory: Territory, buffer: &mut StarBuffer) -> Result<DVec2, Outside> {
        let ring = &mut buffer.moving;
        self.walk(v, territory, ring)?;
        let from = self.mesh.position(v);
        let way = target - from;
        let mut share = 1f64;
        for (k, spoke) in ring.iter().enumerate() {
            let is_on_boundary = ring[ring.len() - 1].half_edge == BOUNDARY && (k == 0 || k + 1 == ring.len());
            if is_on_boundary || self.held.as_ref().is_some_and(|held| held.is_line(v, spoke.vertex)) {
                let nearer = way.dot(spoke.way) / spoke.squared;
                let most = if spoke.squared > LEAST_GAP * LEAST_GAP { STAGE } else { 0.0 };
                if nearer > most {
                    share = share.min(most / nearer);
                }
            }
        }
        Ok(if share < 1.0 { self.land(v, from, from + share * way) } else { target })
    }

    /// The place nearest to `q` where a point that is at `from` may stand.
    fn land(&self, point: u32, from: DVec2, q: DVec2) -> DVec2 {
        if let Some(held) = &self.held {
            return self.domain.land(held.land(point, from, q));
        }
        let place = self.domain.walk(from, q);
        self.field.as_ref().map_or(place, |field| self.domain.walk(place, field.settle(place)))
    }

    /// Moves a vertex to its target, or as far as it gets.
    fn go<const PLAIN: bool>(&self, v: u32, target: DVec2, territory: Territory, buffer: &mut StarBuffer) -> Result<(), Outside> {
        if !self.step::<PLAIN>(v, target, territory)? {
            self.go_in_stages(v, target, territory, buffer)?;
        }
        if let Some(held) = self.held.as_ref().filter(|_| !PLAIN) {
            held.arrive(v, self.mesh.position(v));
        }
        Ok(())
    }

    /// Moves a vertex at once, if all triangles around keep some area.
    fn step<const PLAIN: bool>(&self, v: u32, target: DVec2, territory: Territory) -> Result<bool, Outside> {
        let area = self.spacing * self.spacing;
        let room = ROOM
            * match (&self.field, &self.held) {
                _ if PLAIN => area,
                (Some(field), _) => area / field.at(target).max(1.0),
                (None, Some(held)) => held.size(v) * held.size(v),
                (None, None) => area,
            };
        let first = self.mesh.outgoing(v);
        let mut half_edge = first;
        let start = self.mesh.origin(next(first));
        let mut before = self.spoke(target, start);
        loop {
            let (vertex, turned) = self.mesh.turn(half_edge);
            if !self.is_free(vertex, territory) {
                return Err(Outside);
            }
            self.soil_in::<PLAIN>(vertex);
            let way = self.spoke(target, vertex);
            if !(before.perp_dot(way) > room && self.domain.is_spoke(way - before)) {
                return Ok(false);
            }
            (half_edge, before) = (turned, way);
            if half_edge == first {
                break;
            }
            if !PLAIN && half_edge == BOUNDARY {
                if !self.is_free(start, territory) {
                    return Err(Outside);
                }
                self.soil(start);
                break;
            }
        }
        self.mesh.set_position(v, target);
        self.soil_in::<PLAIN>(v);
        Ok(true)
    }

    fn go_in_stages(&self, v: u32, target: DVec2, territory: Territory, buffer: &mut StarBuffer) -> Result<(), Outside> {
        for stage in 0..MAX_STAGES {
            let n_flips = buffer.n_flips;
            self.restore(v, territory, &mut buffer.moving, &mut buffer.n_flips)?;
            self.soil(v);
            buffer.moving.iter().for_each(|spoke| self.soil(spoke.vertex));
            let from = self.mesh.position(v);
            let way = self.domain.spoke(from, target);
            let is_blocked = stage > 0 && buffer.n_flips == n_flips;
            if way == DVec2::ZERO || is_blocked {
                return Ok(());
            }
            // Twice a triangle's area falls by t way x rim on the part t of the way.
            let ring = &buffer.moving;
            let all = ring.iter().enumerate().filter(|(_, spoke)| spoke.half_edge != BOUNDARY);
            let rims = all.map(|(k, spoke)| (spoke, ring.get(k + 1).unwrap_or(&ring[0])));
            let losses = rims.clone().map(|(spoke, after)| (spoke.cross, way.perp_dot(after.way - spoke.way)));
            let clear = losses.filter(|&(_, loss)| loss > 0.0).map(|(area, loss)| area / loss).fold(f64::INFINITY, f64::min);
            let to = if clear > 1.0 { target } else { self.land(v, from, from + STAGE * clear * way) };
            let ways = rims.map(|(spoke, after)| (self.spoke(to, spoke.vertex), self.spoke(to, after.vertex)));
            if to == from || !{ ways }.all(|(u, v)| self.domain.is_upright(u, v)) {
                return Ok(());
            }
            self.mesh.set_position(v, to);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::points::{Random, separate};
    use crate::{Rectangle, Space, Torus, white};

    fn mesh(space: Space, n: usize, seed: u64) -> LiveMesh {
        let (domain, mut positions) = white(space, n, seed).unwrap().normalized();
        let spacing = domain.hex_spacing(n);
        let order = separate(&domain, &mut positions, 0, spacing).order;
        let sorted = order.iter().map(|&index| positions[index as usize]).collect();
        LiveMesh::new(&domain, None, sorted, order, spacing).unwrap()
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(200) })]
        #[test]
        fn the_mesh_stays_one_wherever_points_go(
            n in 3..80usize, seed in 0..1000u64, length in -3.0..1.5f64, aspect in -3.0..3.0f64, is_periodic: bool, is_lazy: bool,
        ) {
            let size = [1.0, aspect.exp()];
            let space: Space =
                if is_periodic { Torus::new([0.0, 0.0], size).unwrap().into() } else { Rectangle::new([0.0, 0.0], size).unwrap().into() };
            let mut mesh = mesh(space, n, seed);
            let mut buffer = StarBuffer::default();
            let mut random = Random::new(seed, 9);
            let reach = 10f64.powf(length) * mesh.spacing();
            for _ in 0..60 {
                let v = (random.unit() * n as f64) as u32;
                let by = reach * DVec2::new(random.signed(), random.signed());
                mesh.relocate(v, by, Territory::EVERYTHING, &mut buffer).unwrap();
                if mesh.mend().unwrap() {
                    continue;
                }
                prop_assert_eq!(mesh.triangulation().check(), Ok(()));
                if !is_lazy {
                    mesh.legalize();
                }
            }
            mesh.legalize();
            if !mesh.mend().unwrap() {
                prop_assert_eq!(mesh.triangulation().check_delaunay(), Ok(()));
            }
        }
    }

    #[test]
    fn what_lies_outside_the_territory_is_left_alone() {
        let mut mesh = mesh(Torus::new([0.0, 0.0], [1.0, 1.0]).unwrap().into(), 500, 1);
        // The upper half of the plane is another block.
        for v in 0..500 {
            let is_upper = mesh.position(v).y > 0.5;
            mesh.set_block(v, if is_upper { 8 << 16 } else { 0 });
        }
        let lower = Territory { first: 0, outside: 8 << 16 };
        let before: Vec<DVec2> = (0..500).map(|v| mesh.position(v)).collect();
        let (mut buffer, mut n_outside) = (StarBuffer::default(), 0);
        for v in (0..500).filter(|&v| before[v as usize].y <= 0.5) {
            let is_outside = mesh.relocate(v, DVec2::splat(0.01), lower, &mut buffer).is_err();
            n_outside += usize::from(is_outside);
        }
        assert!((10..150).contains(&n_outside), "{n_outside}");
        assert!((0..500).all(|v| before[v as usize].y <= 0.5 || mesh.position(v) == before[v as usize]));
        assert_eq!(mesh.triangulation().check(), Ok(()));
    }
}
