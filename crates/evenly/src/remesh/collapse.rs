//! Collapses of a draft's edges: an end is taken away, if what is left is a mesh that fits the surface.

use glam::DVec3;

use super::draft::Draft;
use super::shape::Guard;
use crate::triangulation::{BOUNDARY, next, prev};

/// Vertices have so many neighbours at most.
const MOST_NEIGHBOURS: usize = 12;
/// Collapses that may bend triangles by this, as a cosine, may also leave obtuse triangles between vertices that all stay.
const LAST_TURN: f64 = -0.5;

impl Draft<'_> {
    /// Takes an end of the edge of `h` away, so that its triangles go to the other end, if that leaves a mesh whose triangles bend by less than `least_turn`, a cosine.
    pub fn collapse(&mut self, h: u32, v: u32, least_turn: f64) -> bool {
        let u = if v == self.mesh.origin[h as usize] { self.mesh.target(h) } else { self.mesh.origin[h as usize] };
        if !self.can_collapse(h, v, u, least_turn) {
            return false;
        }
        let t = self.mesh.twin[h as usize];
        let ring: Vec<u32> = self.mesh.around(self.outgoing[v as usize]).collect();
        ring.iter().for_each(|&h| self.mesh.origin[h as usize] = u);
        let mut touched = vec![u];
        // In place of each triangle at the edge its two other sides become one.
        for h in [h, t].into_iter().filter(|&h| h != BOUNDARY) {
            let (n, p) = (next(h), prev(h));
            let apex = self.mesh.origin[p as usize];
            let [x, y] = [n, p].map(|side| self.mesh.twin[side as usize]);
            let is_crease = self.is_crease[n as usize] || self.is_crease[p as usize];
            for (one, other) in [(x, y), (y, x)] {
                if one != BOUNDARY {
                    self.mesh.twin[one as usize] = other;
                    self.is_crease[one as usize] = is_crease;
                }
            }
            // One of the two sides has a neighbour, or the triangle would have been alone.
            let leaves_apex = |side: u32| if self.mesh.origin[side as usize] == apex { side } else { next(side) };
            let inner = if x != BOUNDARY { x } else { y };
            self.outgoing[apex as usize] = leaves_apex(inner);
            self.outgoing[u as usize] = if self.mesh.origin[inner as usize] == u { inner } else { next(inner) };
            touched.push(apex);
            for k in 3 * (h / 3)..3 * (h / 3) + 3 {
                self.mesh.origin[k as usize] = BOUNDARY;
                self.mesh.twin[k as usize] = BOUNDARY;
            }
        }
        self.outgoing[v as usize] = BOUNDARY;
        self.n_live -= 1;
        self.n_loose -= usize::from(self.is_loose(v));
        touched.into_iter().for_each(|v| self.start_at_boundary(v));
        true
    }

    fn is_on_boundary(&self, v: u32) -> bool {
        self.mesh.twin[self.outgoing[v as usize] as usize] == BOUNDARY
    }

    fn can_collapse(&mut self, h: u32, v: u32, u: u32, least_turn: f64) -> bool {
        let vertex = &self.vertices[v as usize];
        // A crease is left only along it.
        let stays = vertex.is_pinned || vertex.is_given && self.keeps_given;
        if stays || vertex.is_on_crease && !self.is_crease[h as usize] {
            return false;
        }
        let t = self.mesh.twin[h as usize];
        let apexes = [h, t].map(|h| if h == BOUNDARY { BOUNDARY } else { self.mesh.origin[prev(h) as usize] });
        // The only common neighbours are the apexes.
        self.round += 1;
        let (mut n_neighbours, mut n_common) = ([0, 0], 0);
        for (k, at) in [v, u].into_iter().enumerate() {
            let first = self.outgoing[at as usize];
            let mut mark = |draft: &mut Self, other: u32| {
                n_neighbours[k] += 1;
                if k == 0 {
                    draft.marks[other as usize] = draft.round;
                } else if draft.marks[other as usize] == draft.round {
                    n_common += 1;
                }
            };
            let mut h = first;
            loop {
                let other = self.mesh.target(h);
                mark(self, other);
                let turned = self.mesh.twin[prev(h) as usize];
                if turned == BOUNDARY {
                    let last = self.mesh.origin[prev(h) as usize];
                    mark(self, last);
                    break;
                }
                if turned == first {
                    break;
                }
                h = turned;
            }
        }
        let n_apexes = apexes.iter().filter(|&&apex| apex != BOUNDARY).count();
        let is_boundary_edge = n_apexes == 1;
        if n_common != n_apexes || n_neighbours[0] + n_neighbours[1] > MOST_NEIGHBOURS + 4 {
            return false;
        }
        if self.is_on_boundary(v) && (!is_boundary_edge || n_neighbours[0] + n_neighbours[1] < 5)
            || n_neighbours[0] + n_neighbours[1] < 7 - 2 * usize::from(is_boundary_edge)
        {
            return false;
        }
        // An apex loses a neighbour, and two creases never become one.
        let first_side = [h, t].into_iter().filter(|&h| h != BOUNDARY);
        for h in first_side {
            let apex = self.mesh.origin[prev(h) as usize];
            let n = self.mesh.around(self.outgoing[apex as usize]).count();
            if n < if self.is_on_boundary(apex) { 2 } else { 4 } || self.is_crease[next(h) as usize] && self.is_crease[prev(h) as usize] {
                return false;
            }
        }
        let (from, to) = (self.at(v), self.at(u));
        let is_spared = !self.vertices[v as usize].is_on_crease && least_turn > LAST_TURN;
        self.mesh.around(self.outgoing[v as usize]).all(|h| {
            let [x, y] = [self.mesh.target(h), self.mesh.origin[prev(h) as usize]];
            if x == u || y == u {
                return true;
            }
            let [b, c] = [x, y].map(|v| self.at(v));
            let (old, new) = ((b - from).cross(c - from), (b - to).cross(c - to));
            let is_turned = new.dot(old) <= least_turn * new.length() * old.length();
            let is_bad = is_turned || is_spared && self.is_wedged([u, x, y]);
            !is_bad && Guard::FIRM.allows(self.fit(old, [v, x, y]), self.fit(new, [u, x, y]))
        })
    }

    /// Whether a triangle would be obtuse for good.
    fn is_wedged(&self, corners: [u32; 3]) -> bool {
        let [a, b, c] = corners.map(|v| self.at(v));
        let is_obtuse = |at: DVec3, one: DVec3, other: DVec3| (one - at).dot(other - at) < 0.0;
        corners.iter().all(|&v| self.vertices[v as usize].is_pinned) && (is_obtuse(a, b, c) || is_obtuse(b, c, a) || is_obtuse(c, a, b))
    }
}
