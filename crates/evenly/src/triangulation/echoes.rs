//! What the points of a mesh with a boundary see in it, as in a mirror.

use glam::DVec2;

use super::half_edges::{BOUNDARY, next};
use super::held::Held;
use super::live::LiveMesh;
use super::spoke::Spoke;
use crate::star::{Star, Wedge};

/// Where the spokes are a fan at a boundary, what they show is seen there once more, as in a mirror: the star so goes all around, and rules need not know of boundaries. At a
/// corner it goes around by twice the corner's angle.
pub(super) fn close(star: &mut Star, spokes: &mut Vec<Spoke>) {
    let n = spokes.len();
    star.wedges.truncate(n - 1);
    let axis = spokes[0].way.normalize_or_zero();
    for k in (0..n - 1).rev() {
        star.wedges.push(star.wedges[k]);
        if k > 0 {
            let way = 2.0 * axis * spokes[k].way.dot(axis) - spokes[k].way;
            spokes.push(Spoke { way, is_echo: true, ..spokes[k] });
            star.lengths.push(star.lengths[k]);
            star.is_mirror.push(false);
        }
    }
}

/// The same for what lies around a vertex on a straight boundary, along which the ring begins.
pub(super) fn reflect(star: &mut Star) {
    let Star { ring, beyond, .. } = star;
    let axis = ring[0].normalize_or_zero();
    let image = |place: DVec2| 2.0 * axis * place.dot(axis) - place;
    for k in (1..ring.len() - 1).rev() {
        ring.push(image(ring[k]));
    }
    for k in 0..beyond.len() {
        beyond.push(image(beyond[k]));
    }
}

/// Whether what lies along a boundary is hidden from the vertex by this neighbour and its image: so where it sees the three at an obtuse angle.
fn hides(neighbour: &Spoke, along: &Spoke) -> bool {
    (along.way - neighbour.way).dot(neighbour.way) > 0.0
}

/// Takes away the neighbours along the boundary that are hidden from the vertex of a closed star, whose fan has so many spokes.
pub(super) fn hide(star: &mut Star, spokes: &mut Vec<Spoke>, n_in_fan: usize) {
    for (along, neighbour) in [(n_in_fan - 1, n_in_fan - 2), (0, 1)] {
        let n = spokes.len();
        if n > 3 && hides(&spokes[neighbour], &spokes[along]) {
            let (before, after) = ((along + n - 1) % n, (along + 1) % n);
            star.wedges[before] = wedge(spokes[before].way, spokes[after].way);
            star.wedges.remove(along);
            star.lengths.remove(along);
            star.is_mirror.remove(along);
            spokes.remove(along);
        }
    }
}

impl LiveMesh {
    /// Whether the side between two neighbouring spokes is an edge that stays.
    pub(super) fn is_wall(&self, held: &Held, spoke: &Spoke, after: &Spoke) -> bool {
        self.mesh.twin(next(spoke.half_edge)) == BOUNDARY || held.is_line(spoke.vertex, after.vertex)
    }

    /// Where the cell of `v` would reach across an edge that stays, `v` itself is seen behind that.
    pub(super) fn wall_off(&self, held: &Held, v: u32, star: &mut Star, spokes: &mut Vec<Spoke>) {
        let scale = 1.0 / self.spacing;
        let mut k = 0;
        while k < spokes.len() {
            let (spoke, after) = (spokes[k], spokes[star.after(k)]);
            k += 1;
            if spoke.half_edge == BOUNDARY {
                break;
            }
            // The centre of the triangle lies beyond its side if the angle across is obtuse.
            if spoke.dot >= 0.0 || !self.is_wall(held, &spoke, &after) {
                continue;
            }
            let side = after.way - spoke.way;
            let way = 2.0 * (spoke.way - side * (spoke.way.dot(side) / side.length_squared()));
            let length = way.length() * scale;
            if length == 0.0 {
                continue;
            }
            spokes.insert(k, Spoke { vertex: v, is_echo: true, way, length, half_edge: spoke.half_edge, ..Spoke::default() });
            star.lengths.insert(k, length);
            star.is_mirror.insert(k, false);
            star.wedges[k - 1] = wedge(spoke.way, way);
            star.wedges.insert(k, wedge(way, after.way));
            k += 1;
        }
    }
}

fn wedge(u: DVec2, v: DVec2) -> Wedge {
    let inverse = 1.0 / (u.length() * v.length());
    let (cos, sin) = (u.dot(v) * inverse, u.perp_dot(v) * inverse);
    Wedge { cos, sin, cosecant: 1.0 / sin }
}
