//! The last bad triangles: their vertices go where the angles around are best, and edges are flipped where that makes angles better.

use glam::DVec3;

use super::forced::RIGHT_DEG;
use super::ground::SurfaceBuffer;
use super::live::{LiveSurface, Vertex};
use crate::geometry::triangle::Shape;
use crate::points::Random;
use crate::sweep::Ground;
use crate::triangulation::{BOUNDARY, Spoke};

/// An obtuse angle counts so many times as much as one that only misses its target; and so does what is half a degree below.
const OBTUSE: f64 = 100.0;
const OBTUSE_DEG: f64 = 89.5;
/// Rounds over all that is bad, and over what is around it.
const ROUNDS: usize = 30;
/// The first step, in spacings, how often it is halved, and the directions that are tried each time.
const STEP: f64 = 0.2;
const HALVINGS: usize = 5;
const DIRECTIONS: usize = 6;

/// A crease is straight whose sine is below this, and an angle right but for a little whose cosine is.
const STRAIGHT: f64 = 1e-9;
const LITTLE_OFF: f64 = 0.02;

/// Angles that are off by less than this, in degrees, are within their bounds.
const ROUNDING_DEG: f64 = 1e-6;

/// Between which bounds angles are to be, in degrees.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds {
    smallest: f64,
    largest: f64,
}

impl Bounds {
    /// What the ratio of the largest radius to the shortest edge implies.
    pub fn of_beta(beta: f64) -> Self {
        let smallest = libm::asin((0.5 / beta).min(0.5 * 3f64.sqrt())).to_degrees();
        Self { smallest, largest: 180.0 - 2.0 * smallest }
    }

    pub fn new([smallest, largest]: [f64; 2]) -> Self {
        Self { smallest, largest }
    }

    /// The smallest and the largest angle, in degrees.
    pub fn degrees(self) -> [f64; 2] {
        [self.smallest, self.largest]
    }

    /// Whether a triangle's smallest and largest angle are within the bounds, to rounding.
    pub fn hold(self, [least, most]: [f64; 2]) -> bool {
        least >= self.smallest - ROUNDING_DEG && most <= self.largest + ROUNDING_DEG
    }

    /// How bad a triangle is: 0 if it is not.
    fn badness(self, a: DVec3, b: DVec3, c: DVec3) -> f64 {
        let angle = |at: DVec3, u: DVec3, v: DVec3| libm::atan2((u - at).cross(v - at).length(), (u - at).dot(v - at)).to_degrees();
        let square = |excess: f64| excess.max(0.0) * excess.max(0.0);
        let obtuse = if self.largest < OBTUSE_DEG { OBTUSE } else { 0.0 };
        let of = |angle: f64| square(angle - self.largest) + square(self.smallest - angle) + obtuse * square(angle - OBTUSE_DEG);
        of(angle(a, b, c)) + of(angle(b, c, a)) + of(angle(c, a, b))
    }
}

impl LiveSurface<'_> {
    /// Makes bad triangles better as long as that goes; no other comes to be worse than it makes up for.
    pub(super) fn polish(&mut self, bounds: Bounds, seed: u64) {
        let mut random = Random::new(seed, 1 << 40);
        let mut buffer = SurfaceBuffer::default();
        for _ in 0..ROUNDS {
            let bad: Vec<u32> = (0..self.mesh.n_half_edges() as u32 / 3).filter(|&t| self.badness_of(t, bounds) > 0.0).collect();
            if bad.is_empty() {
                return;
            }
            let mut vertices = Vec::new();
            for t in bad {
                for h in 3 * t..3 * t + 3 {
                    self.flip_if_better(h, bounds);
                    self.walk_alone(self.mesh.origin(h), &mut buffer.moving);
                    vertices.push(self.mesh.origin(h));
                    vertices.extend(buffer.moving.iter().map(|spoke| spoke.vertex));
                }
            }
            vertices.sort_unstable();
            vertices.dedup();
            let mut has_moved = false;
            for v in vertices.into_iter().filter(|&v| !self.is_fixed(v)).collect::<Vec<_>>() {
                has_moved |= self.find_better(v, bounds, &mut random, &mut buffer);
            }
            if !has_moved {
                return;
            }
        }
    }

    fn badness_of(&self, t: u32, bounds: Bounds) -> f64 {
        let [a, b, c] = [0, 1, 2].map(|k| self.at(self.mesh.origin(3 * t + k)));
        bounds.badness(a, b, c)
    }

    /// How bad the triangles around a vertex are, if it is at a place.
    fn badness_around(&self, bounds: Bounds, at: DVec3, ring: &[Spoke<DVec3>]) -> f64 {
        let corner = |spoke: &Spoke<DVec3>| self.at(spoke.vertex);
        let all = ring.iter().enumerate().filter(|(_, spoke)| spoke.half_edge != BOUNDARY);
        all.map(|(k, spoke)| bounds.badness(at, corner(spoke), corner(ring.get(k + 1).unwrap_or(&ring[0])))).sum()
    }

    /// Looks for a better place in steps that become smaller. Whether there was one.
    fn find_better(&self, v: u32, bounds: Bounds, random: &mut Random, buffer: &mut SurfaceBuffer) -> bool {
        let mut has_moved = false;
        let mut step = STEP * self.local_spacing(v);
        for _ in 0..HALVINGS {
            for _ in 0..DIRECTIONS {
                let ring = &mut buffer.moving;
                self.walk_alone(v, ring);
                let from: Vertex = self.vertex(v);
                let before = self.badness_around(bounds, from.at, ring);
                if before == 0.0 {
                    return has_moved;
                }
                let by = step * DVec3::new(random.signed(), random.signed(), random.signed());
                let to = self.land(&from, from.at + by);
                if self.badness_around(bounds, to.at, ring) < before && self.step(v, by, ring) {
                    has_moved = true;
                }
            }
            step *= 0.5;
        }
        has_moved
    }

    /// Makes both angles right where two triangles share a half turn, and one of them is obtuse by a little: there is nothing better.
    pub(super) fn square_up(&self) {
        let (mut ring, mut moving) = (Vec::new(), Vec::new());
        for v in (0..self.n_points() as u32).filter(|&v| self.is_bound(v)) {
            self.walk_alone(v, &mut ring);
            for sector in self.sectors(v, &ring) {
                let [before, middle, after] = sector[..] else { continue };
                let along = (after.way - before.way).normalize_or_zero();
                let off = middle.way.dot(along);
                let is_straight = before.way.cross(after.way).length() < STRAIGHT * before.way.length() * after.way.length();
                if !is_straight || self.is_fixed(middle.vertex) || off.abs() > LITTLE_OFF * middle.way.length() {
                    continue;
                }
                let w = middle.vertex;
                self.walk_alone(w, &mut moving);
                let (from, n_before) = (self.vertex(w), self.n_obtuse_around(w, &moving));
                if n_before > 0 && self.step(w, -off * along, &moving) && self.n_obtuse_around(w, &moving) >= n_before {
                    self.mesh.set_place(w, from.numbers());
                }
            }
        }
    }

    fn n_obtuse_around(&self, v: u32, ring: &[Spoke<DVec3>]) -> usize {
        let after = |k: usize| &ring[if k + 1 == ring.len() { 0 } else { k + 1 }];
        let corners = |k: usize| [v, ring[k].vertex, after(k).vertex].map(|v| self.at(v));
        let is_obtuse = |&k: &usize| Shape::of_space(corners(k)).extreme_angles_deg()[1] > RIGHT_DEG;
        (0..ring.len()).filter(|&k| ring[k].half_edge != BOUNDARY).filter(is_obtuse).count()
    }

    fn flip_if_better(&self, h: u32, bounds: Bounds) {
        let t = self.mesh.twin(h);
        if t == BOUNDARY {
            return;
        }
        let corners = self.mesh.quadrilateral(h);
        let [p, q, r, s] = corners.map(|v| self.at(v));
        let badness = |a, b, c| bounds.badness(a, b, c);
        let is_better = badness(s, q, r) + badness(r, p, s) < badness(p, q, r) + badness(q, p, s);
        if is_better && self.can_flip(corners) {
            self.flip(h);
        }
    }
}
