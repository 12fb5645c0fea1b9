//! Stars in a polygon: of what a point sees.

use glam::DVec2;

use super::live::{LiveMesh, Outside};
use super::shared::Territory;
use super::sight::Moments;
use super::stars::StarBuffer;
use crate::space::Border;

/// By how much more than others the area of a cell may be off that a polygon's border cuts: in its nooks it must.
const LEEWAY: f64 = 0.25;
/// So many points are looked at, at most, for those that stand in for hidden neighbours.
const MOST_SEEN: usize = 400;

impl LiveMesh {
    /// Whether nothing of a border is so near to a point that its star could be another there, and none of its neighbours is the frame's.
    pub(super) fn is_clear(&self, border: &Border, v: u32, buffer: &mut StarBuffer) -> bool {
        let StarBuffer { star, spokes, sight, .. } = buffer;
        let at = self.mesh.position(v);
        let reach = (0..star.n_spokes()).map(|k| star.lengths[k].max(star.circumradius(k))).fold(0.0, f64::max) * self.spacing;
        spokes.iter().all(|spoke| spoke.vertex < self.n_live) && (border.clearance(at) > reach || sight.is_alone(at, reach, border))
    }

    /// Turns the spokes in the buffer into the star of what is seen of the cell in a polygon.
    pub(super) fn fill_within(&self, border: &Border, v: u32, territory: Territory, buffer: &mut StarBuffer) -> Result<(), Outside> {
        let StarBuffer { star, spokes, wall_cell, sight, near, moving, .. } = buffer;
        let at = self.mesh.position(v);
        near.clear();
        near.extend(spokes.iter().map(|spoke| spoke.vertex).filter(|&vertex| vertex < self.n_live));
        let seen = |&vertex: &u32| {
            let place = self.mesh.position(vertex);
            border.sees(at, place).then_some((vertex, place - at))
        };
        let n_seen = near.iter().filter_map(seen).count();
        wall_cell.clip(at, self.domain.size, near.iter().filter_map(seen));
        let mut is_less = sight.look(at, wall_cell, border);
        if n_seen < spokes.len() {
            // Where neighbours are hidden, others stand in for them: from ring to ring.
            near.push(v);
            let mut ring = 0..near.len() - 1;
            while !ring.is_empty() && near.len() < MOST_SEEN {
                let reach = 2.0 * sight.reach();
                let is_near = |vertex: u32| self.mesh.position(vertex).distance_squared(at) < reach * reach;
                let end = near.len();
                for k in ring {
                    if is_near(near[k]) {
                        self.walk(near[k], territory, moving)?;
                        for other in moving.iter().map(|spoke| spoke.vertex) {
                            if other < self.n_live && !near.contains(&other) {
                                near.push(other);
                            }
                        }
                    }
                }
                ring = end..near.len();
                let mut is_cut = false;
                for (other, way) in near[ring.clone()].iter().filter(|&&other| is_near(other)).filter_map(seen) {
                    wall_cell.cut(other, way);
                    is_cut = true;
                }
                if is_cut {
                    is_less = sight.look(at, wall_cell, border);
                }
            }
        }
        if is_less || n_seen < spokes.len() {
            let scale = 1.0 / self.spacing;
            sight.cell.fill(star, spokes, scale);
            // What is seen may be less than the hull that the star shows.
            let Moments { area, centroid, .. } = sight.moments();
            (star.metric.mass, star.metric.centroid) = (Some(area * scale * scale), Some(centroid * scale));
            star.leeway = LEEWAY;
        } else {
            sight.outline.clear();
        }
        Ok(())
    }

    /// The squared distance of a place that the vertex `v` sees to the nearest point that sees it, of those that were looked at for the star of `v`.
    pub fn distance_to_seeing(&self, v: u32, near: &[u32], place: DVec2) -> f64 {
        let others = near.iter().map(|&other| self.position(other)).filter(|&other| self.domain.sees(other, place));
        others.chain([self.position(v)]).map(|other| other.distance_squared(place)).fold(f64::INFINITY, f64::min)
    }
}
