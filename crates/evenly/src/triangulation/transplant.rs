//! Taking a point out of the mesh, and putting it in somewhere else.
//!
//! A vertex is flipped free until it has three neighbours, and its triangles become one; where it comes in again, one triangle becomes three. The
//! mesh is Delaunay before and after. For one thread.

use std::sync::atomic::Ordering::Relaxed;

use glam::DVec2;

use super::half_edges::{next, prev};
use super::live::LiveMesh;
use super::mesh::circumcentre;
use crate::predicates::is_left_turn;

/// Triangles that are no part of the mesh while points are out of it, and those that have changed.
#[derive(Default)]
pub(crate) struct Transplant {
    free: Vec<u32>,
    /// Triangles that have changed, or are free; some more than once.
    pub changed: Vec<u32>,
    suspects: Vec<u32>,
}

impl Transplant {
    /// Whether a triangle is no part of the mesh.
    pub fn is_free(&self, triangle: u32) -> bool {
        self.free.contains(&triangle)
    }
}

/// A walk that has taken so many steps more than there are triangles has lost its way.
const SPARE_STEPS: usize = 100;
/// The part of the way to a triangle's middle, or the domain's, by which a place is moved that lies on its boundary.
const NUDGE: f64 = 1e-6;

impl LiveMesh {
    pub fn n_triangles(&self) -> usize {
        self.mesh.n_half_edges() / 3
    }

    /// A triangle at `v`.
    pub fn triangle_at(&self, v: u32) -> u32 {
        self.mesh.outgoing(v) / 3
    }

    /// The vertices of a triangle.
    pub fn corners(&self, triangle: u32) -> [u32; 3] {
        [0, 1, 2].map(|k| self.mesh.origin(3 * triangle + k))
    }

    /// The centre of a triangle's circumcircle, and its squared radius.
    pub fn circumcircle(&self, triangle: u32) -> (DVec2, f64) {
        let [a, b, c] = self.corners(triangle);
        let from = self.mesh.position(a);
        let centre = circumcentre(self.spoke(from, b), self.spoke(from, c));
        (from + centre, centre.length_squared())
    }

    /// Takes a point and its copies out of the mesh. Where edges become too long for a cover the mesh is torn.
    pub fn take_out(&self, point: u32, work: &mut Transplant) {
        for copy in (point..self.n_live).step_by(self.n_points()) {
            if !self.free_to_three(copy, work) {
                self.is_torn.store(true, Relaxed);
            }
            if self.is_torn() {
                return;
            }
            self.unite(copy, work);
            self.legalize_suspects(work);
        }
    }

    /// Puts a point and its copies in at a place; `triangle` is one near there.
    pub fn put_in(&self, point: u32, place: DVec2, triangle: u32, work: &mut Transplant) {
        let from = self.mesh.position(point);
        let mut near = self.split(point, self.domain.land(place), triangle, work);
        self.legalize_suspects(work);
        let place = self.mesh.position(point);
        for copy in (point..self.n_live).step_by(self.n_points()).skip(1) {
            let there = self.domain.land(place + (self.mesh.position(copy) - from));
            near = self.split(copy, there, near, work);
            self.legalize_suspects(work);
            if self.mesh.position(copy) != there {
                self.is_torn.store(true, Relaxed);
            }
        }
    }

    /// Flips spokes of `v` until three are left. Whether that can be done.
    fn free_to_three(&self, v: u32, work: &mut Transplant) -> bool {
        let at = self.mesh.position(v);
        let first = self.mesh.outgoing(v);
        let spokes = std::iter::successors(Some(first), |&h| Some(self.mesh.turn(h).1).filter(|&h| h != first));
        let mut n_spokes = spokes.count();
        let (mut h, mut n_kept) = (first, 0);
        while n_spokes > 3 && n_kept < n_spokes {
            let turned = self.mesh.turn(h).1;
            let [_, q, r, s] = self.mesh.quadrilateral(h);
            let [q, r, s] = [self.spoke(at, q), self.spoke(at, r), self.spoke(at, s)];
            // The triangle that is cut off must be one; the other may have no area, as it goes with the vertex.
            if is_left_turn(q - s, r - s) && !is_left_turn(r, s) && self.domain.is_spoke(r - s) {
                work.changed.extend([h / 3, self.mesh.twin(h) / 3]);
                self.mesh.flip(h);
                // Of the edges around, only the new one can be illegal: what lies behind the others has an empty circle.
                work.suspects.push(prev(h));
                (n_spokes, n_kept) = (n_spokes - 1, 0);
            } else {
                n_kept += 1;
            }
            h = turned;
        }
        n_spokes == 3
    }

    /// Makes one triangle of the three around `v`.
    fn unite(&self, v: u32, work: &mut Transplant) {
        let triangles = self.mesh.unite(v);
        work.changed.extend(triangles);
        work.free.extend(&triangles[1..]);
    }

    /// Puts `v` into the triangle at a place, and returns one of the three that come of it.
    fn split(&self, v: u32, place: DVec2, near: u32, work: &mut Transplant) -> u32 {
        let Some((triangle, place)) = self.locate(place, near, work) else {
            self.mesh.set_position(v, place);
            self.is_torn.store(true, Relaxed);
            return near;
        };
        self.mesh.set_position(v, place);
        // Taken out before, so there are two.
        let (second, third) = (work.free.pop().unwrap_or(triangle), work.free.pop().unwrap_or(triangle));
        let slots = [triangle, second, third];
        self.mesh.divide(v, slots);
        work.changed.extend(slots);
        work.suspects.extend(slots.map(|slot| 3 * slot));
        triangle
    }

    /// Walks to the triangle that holds a place; where that lies on an edge, the place is nudged. `None` if it is not found.
    fn locate(&self, mut place: DVec2, near: u32, work: &Transplant) -> Option<(u32, DVec2)> {
        let mut triangle = near;
        while work.is_free(triangle) {
            triangle = (triangle + 1) % self.n_triangles() as u32;
        }
        // The way to a corner is the shortest at first; from there on the walk goes the same way round the torus.
        let (mut corner, mut way) = (0, self.spoke(place, self.corners(triangle)[0]));
        for step in 0..self.n_triangles() + SPARE_STEPS {
            let vertices = self.corners(triangle);
            let from = self.mesh.position(vertices[corner]);
            let ways = vertices.map(|vertex| way + self.spoke(from, vertex));
            // Each time another edge is looked at first: a walk cannot go round in circles.
            let edges = [0, 1, 2].map(|k| (k + step) % 3);
            let Some(k) = edges.into_iter().find(|&k| !is_left_turn(ways[k], ways[(k + 1) % 3])) else { return Some((triangle, place)) };
            if is_left_turn(ways[(k + 1) % 3], ways[k]) {
                let twin = self.mesh.twin(3 * triangle + k as u32);
                (triangle, corner, way) = (twin / 3, twin as usize % 3, ways[(k + 1) % 3]);
            } else {
                // In a rectangle the triangle may lie outside; in a polygon the middle may as well.
                let inwards = match (&self.domain.boundary, self.domain.is_periodic) {
                    (Some(_), _) => self.spacing * DVec2::from_angle(step as f64),
                    (None, true) => (ways[0] + ways[1] + ways[2]) / 3.0,
                    (None, false) => 0.5 * self.domain.size - place,
                };
                let inwards = inwards.clamp_length_max(self.spacing);
                let nudged = self.domain.walk(place, place + NUDGE * (1.0 + step as f64) * inwards);
                (corner, way) = (0, ways[0] - self.domain.spoke(place, nudged));
                place = nudged;
            }
        }
        debug_assert!(false, "a walk has lost its way");
        None
    }

    fn legalize_suspects(&self, work: &mut Transplant) {
        while let Some(h) = work.suspects.pop() {
            if !work.is_free(h / 3) && self.is_illegal(h) {
                let t = self.mesh.twin(h);
                self.mesh.flip(h);
                work.changed.extend([h / 3, t / 3]);
                work.suspects.extend([h, t, next(h), next(t)]);
            }
        }
    }

    /// Whether the mesh must be retriangulated: see [`LiveMesh::mend`].
    pub fn is_torn(&self) -> bool {
        self.is_torn.load(Relaxed)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::points::{Random, separate};
    use crate::{Rectangle, Space, Torus, white};

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(200) })]
        #[test]
        fn the_mesh_stays_delaunay_wherever_points_are_put(
            n in 4..60usize, seed in 0..1000u64, aspect in -3.0..3.0f64, is_periodic: bool, is_grid: bool,
        ) {
            let size = [1.0, aspect.exp()];
            let space: Space =
                if is_periodic { Torus::new([0.0, 0.0], size).unwrap().into() } else { Rectangle::new([0.0, 0.0], size).unwrap().into() };
            let (domain, mut positions) = white(space, n, seed).unwrap().normalized();
            if is_grid {
                positions.iter_mut().for_each(|p| *p = domain.land((*p * 8.0).floor() / 8.0 * domain.size));
            }
            let spacing = domain.hex_spacing(n);
            let order = separate(&domain, &mut positions, 0, spacing).order;
            let sorted = order.iter().map(|&index| positions[index as usize]).collect();
            let mut mesh = LiveMesh::new(&domain, None, sorted, order, spacing).unwrap();
            let mut random = Random::new(seed, 5);
            for _ in 0..40 {
                let mut work = Transplant::default();
                let v = (random.unit() * n as f64) as u32;
                let x = random.unit();
                let place = domain.size * if is_grid { ((DVec2::new(x, random.unit()) * 16.0).floor() + 0.5) / 16.0 } else { DVec2::new(x, random.unit()) };
                mesh.take_out(v, &mut work);
                if !mesh.is_torn() {
                    mesh.put_in(v, place, 0, &mut work);
                }
                if mesh.mend().unwrap() {
                    continue;
                }
                prop_assert_eq!(mesh.triangulation().check_delaunay(), Ok(()));
            }
        }
    }
}
