//! What stars on a surface show: true lengths and angles, and the wanted spacing a wedge at a time.
//!
//! Each wedge has one scale, the mean of the inverse spacings at its triangle's corners, for its radius and for both its spokes. If all edges are long enough so, and all
//! radii small enough, then sin(angle) >= r_f / (2 r_c) for each angle of the mesh, however the wanted spacing varies.

use glam::{DVec2, DVec3};

use super::cells::Territory;
use super::ground::SurfaceBuffer;
use super::live::LiveSurface;
use crate::star::{Senses, Star, Wedge};
use crate::sweep::Ground;
use crate::triangulation::{BOUNDARY, Outside, Spoke, slope};

impl LiveSurface<'_> {
    /// Turns the spokes around `v` into a star.
    pub(super) fn fill(&self, v: u32, senses: &Senses, star: &mut Star, spokes: &mut Vec<Spoke<DVec3>>) {
        if spokes[spokes.len() - 1].half_edge == BOUNDARY {
            close(spokes);
        }
        let scale = 1.0 / self.spacing();
        star.clear();
        star.lengths.extend(spokes.iter().map(|spoke| spoke.squared.sqrt() * scale));
        star.is_mirror.resize(spokes.len(), false);
        for (k, spoke) in spokes.iter_mut().enumerate() {
            spoke.length = star.lengths[k];
            let share = scale * scale / (spoke.length * star.lengths[star.after(k)]);
            let sin = spoke.cross * share;
            star.wedges.push(Wedge { cos: spoke.dot * share, sin, cosecant: 1.0 / sin });
        }
        if self.has_density() || self.is_fixed(v) {
            self.weigh(v, senses, star, spokes);
        }
        // What is fixed has the cell that it has; and where moves are blocked, as in thin parts, places cannot be shared out alike.
        if self.is_fixed(v) || self.n_blocked(v) > 0 {
            star.leeway = f64::INFINITY;
        }
    }

    /// Finds what the star's lengths, radii and area are in the spacings that are wanted at its triangles.
    fn weigh(&self, v: u32, senses: &Senses, star: &mut Star, spokes: &[Spoke<DVec3>]) {
        let inverse = |v: u32| 1.0 / self.size(v);
        let own = inverse(v);
        let n = spokes.len();
        let of_wedge = |k: usize| (own + inverse(spokes[k].vertex) + inverse(spokes[if k + 1 == n { 0 } else { k + 1 }].vertex)) / 3.0;
        star.metric.radii.extend((0..n).map(of_wedge));
        for k in 0..n {
            let least = star.metric.radii[if k > 0 { k - 1 } else { n - 1 }].min(star.metric.radii[k]);
            star.metric.spokes.push(self.lengthened(v, k, least, senses, spokes));
        }
        if self.has_density() {
            // The cell's mass, kite by kite; the scale that goes with it.
            let area = star.measure_cell();
            let mass: f64 = (0..n).map(|k| star.kite(k) * star.metric.radii[k] * star.metric.radii[k]).sum();
            star.metric.mass = Some(mass);
            star.metric.scale = if area > 0.0 && mass > 0.0 { (mass / area).sqrt() } else { own };
            if senses.centroid {
                star.metric.sizes.extend(spokes.iter().map(|spoke| own / inverse(spoke.vertex)));
            }
            let radii = &star.metric.radii;
            star.metric.sides.extend((0..n).map(|k| 0.5 * (radii[if k > 0 { k - 1 } else { n - 1 }].powi(2) + radii[k].powi(2))));
        }
    }

    /// The stretch of spoke `k`: such that a neighbour which sees the next crease edge at an obtuse angle counts as too near.
    fn lengthened(&self, v: u32, k: usize, stretch: f64, senses: &Senses, spokes: &[Spoke<DVec3>]) -> f64 {
        let Some(wanted) = senses.lengths.filter(|_| self.is_fixed(v) && !self.is_fixed(spokes[k].vertex)) else { return stretch };
        let n = spokes.len();
        let spoke = &spokes[k];
        let mut stretch = stretch;
        for other in [&spokes[(k + 1) % n], &spokes[(k + n - 1) % n]] {
            if self.is_bond(v, other.vertex) {
                // The neighbour stays outside of the circle over the crease edge: its spoke is at least as long as that edge's shadow on it.
                let shadow = spoke.way.dot(other.way) / spoke.squared.sqrt() / self.spacing();
                if shadow > 0.0 {
                    stretch = stretch.min(wanted / shadow);
                }
            }
        }
        stretch
    }

    /// Two directions along the surface at a vertex.
    pub(super) fn tangents(&self, v: u32) -> [DVec3; 2] {
        let normal = self.normal(v);
        if normal == DVec3::ZERO { [DVec3::X, DVec3::Y] } else { normal.any_orthonormal_pair().into() }
    }

    /// Lays out the star of `v` and those of its neighbours in the plane along the surface.
    pub(super) fn lay_out(&self, v: u32, territory: Territory, buffer: &mut SurfaceBuffer) -> Result<(), Outside> {
        let [x, y] = self.tangents(v);
        let (at, scale) = (self.at(v), 1.0 / self.spacing());
        let flat = |other: u32| {
            let way = (self.at(other) - at) * scale;
            DVec2::new(way.dot(x), way.dot(y))
        };
        let mut ring = std::mem::take(&mut buffer.moving);
        self.walk(v, territory, &mut ring)?;
        let neighbours: Vec<u32> = ring.iter().map(|spoke| spoke.vertex).collect();
        let mut beyond = Vec::new();
        for &neighbour in &neighbours {
            self.walk(neighbour, territory, &mut ring)?;
            for spoke in &ring {
                if spoke.vertex != v && !neighbours.contains(&spoke.vertex) && !beyond.contains(&spoke.vertex) {
                    beyond.push(spoke.vertex);
                }
            }
        }
        let star = &mut buffer.star;
        star.ring.clear();
        star.ring.extend(neighbours.iter().map(|&other| flat(other)));
        star.beyond.clear();
        star.beyond.extend(beyond.iter().map(|&other| flat(other)));
        star.walls.clear();
        star.slope = if self.has_density() {
            slope(star.ring.iter().zip(&neighbours).map(|(&place, &other)| (place, self.size(other) / self.size(v))))
        } else {
            DVec2::ZERO
        };
        star.rail = self.is_fixed(v).then_some(DVec2::ZERO);
        buffer.moving = ring;
        Ok(())
    }
}

/// A fan at a boundary is seen once more, as in a mirror, so that the star goes all around.
fn close(spokes: &mut Vec<Spoke<DVec3>>) {
    let n = spokes.len();
    for k in (0..n - 1).rev() {
        // The wedge after the spoke before is there once more.
        let Spoke { dot, cross, .. } = spokes[k];
        if let Some(last) = spokes.last_mut() {
            (last.dot, last.cross) = (dot, cross);
        }
        if k > 0 {
            spokes.push(Spoke { is_echo: true, ..spokes[k] });
        }
    }
}
