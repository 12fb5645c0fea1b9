//! Stars in a polygon: of what a point sees.

use glam::DVec2;

use super::live::{LiveMesh, Outside};
use super::shared::Territory;
use super::sight::Moments;
use super::stars::StarBuffer;
use crate::space::Border;

/// By how much more than others the area of a cell may be off that a polygon's border cuts: in its nooks it must.
const LEEWAY: f64 = 0.25;
/// Half the side of the box, in spacings, in which a point looks first for what it sees.
const NEARBY: f64 = 2.5;
/// So many points are looked at, at most, for those that stand in for hidden neighbours.
const MOST_SEEN: usize = 400;

impl LiveMesh {
    /// Whether nothing of a border is so near to a point that its star could be another there, and none of its neighbours is the frame's.
    pub(super) fn is_clear(&self, border: &Border, v: u32, buffer: &mut StarBuffer) -> bool {
        let StarBuffer { star, spokes, .. } = buffer;
        let at = self.mesh.position(v);
        let reach = (0..star.n_spokes()).map(|k| star.lengths[k].max(star.circumradius(k))).fold(0.0, f64::max) * self.spacing;
        spokes.iter().all(|spoke| spoke.vertex < self.n_live) && (border.clearance(at) > reach || !border.is_near(at - reach, at + reach))
    }

    /// Turns the spokes in the buffer into the star of what is seen of the cell in a polygon.
    pub(super) fn fill_within(&self, border: &Border, v: u32, territory: Territory, buffer: &mut StarBuffer) -> Result<(), Outside> {
        let at = self.mesh.position(v);
        let (low, high) = (-at, self.domain.size - at);
        // Where a border is near, little is seen: of a box around, and of a larger one where that is not all.
        let mut half = DVec2::splat(NEARBY * self.spacing);
        let is_less = loop {
            let (box_low, box_high) = (low.max(-half), high.min(half));
            let is_less = self.look_within(border, v, [box_low, box_high], territory, buffer)?;
            let is_whole = box_low == low && box_high == high;
            if is_whole || buffer.sight.outline.iter().all(|corner| corner.cmpgt(0.999 * -half).all() && corner.cmplt(0.999 * half).all()) {
                break is_less;
            }
            half *= 4.0;
        };
        let StarBuffer { star, spokes, sight, .. } = buffer;
        if is_less {
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

    /// Finds what `v` sees of its cell in a box, given relative to it; whether that is less than the cell that its neighbours in the mesh cut out.
    fn look_within(
        &self,
        border: &Border,
        v: u32,
        [low, high]: [DVec2; 2],
        territory: Territory,
        buffer: &mut StarBuffer,
    ) -> Result<bool, Outside> {
        let StarBuffer { spokes, wall_cell, sight, near, moving, .. } = buffer;
        let at = self.mesh.position(v);
        near.clear();
        near.extend(spokes.iter().map(|spoke| spoke.vertex).filter(|&vertex| vertex < self.n_live));
        // The nearest first: what they cut off, others need not.
        near.sort_by(|&a, &b| self.distance_squared(at, a).total_cmp(&self.distance_squared(at, b)));
        wall_cell.begin_in(low, high);
        let mut n_hidden = spokes.len() - near.len();
        for &other in &*near {
            let place = self.mesh.position(other);
            if border.sees(at, place) {
                wall_cell.cut(other, place - at);
            } else {
                n_hidden += 1;
            }
        }
        if n_hidden == 0 {
            return Ok(sight.look(at, wall_cell, border));
        }
        // Where neighbours are hidden, others stand in for them: from ring to ring.
        near.push(v);
        let mut ring = 0..near.len() - 1;
        let mut reach = f64::INFINITY;
        while !ring.is_empty() && near.len() < MOST_SEEN {
            let end = near.len();
            for k in ring {
                if self.distance_squared(at, near[k]) < reach * reach {
                    self.walk(near[k], territory, moving)?;
                    for other in moving.iter().map(|spoke| spoke.vertex) {
                        if other < self.n_live && !near.contains(&other) {
                            near.push(other);
                        }
                    }
                }
            }
            ring = end..near.len();
            let mut is_cut = reach.is_infinite();
            for &other in &near[ring.clone()] {
                let place = self.mesh.position(other);
                if wall_cell.is_cut_by(place - at) && border.sees(at, place) {
                    wall_cell.cut(other, place - at);
                    is_cut = true;
                }
            }
            if is_cut {
                sight.look(at, wall_cell, border);
                reach = 2.0 * sight.reach();
            }
        }
        Ok(true)
    }

    fn distance_squared(&self, at: DVec2, v: u32) -> f64 {
        self.mesh.position(v).distance_squared(at)
    }

    /// The squared distance of a place that the vertex `v` sees to the nearest point that sees it, of those that were looked at for the star of `v`.
    pub fn distance_to_seeing(&self, v: u32, near: &[u32], place: DVec2) -> f64 {
        let nearer = |least: f64, &other: &u32| {
            let squared = self.distance_squared(place, other);
            if squared < least && self.domain.sees(self.position(other), place) { squared } else { least }
        };
        near.iter().fold(self.distance_squared(place, v), nearer)
    }
}
