//! Stars in a polygon: of what a point sees.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use glam::DVec2;

use super::live::{LiveMesh, Outside};
use super::shared::Territory;
use super::sight::Moments;
use super::stars::StarBuffer;
use crate::space::Boundary;

/// By how much more than others the area of a cell may be off that a polygon's boundary cuts: in its nooks it must.
const LEEWAY: f64 = 0.25;
/// Half the side of the box, in spacings, in which a point looks first for what it sees.
const NEARBY: f64 = 2.5;
/// So many points are looked at, at most, for those that stand in for hidden neighbours.
const MOST_SEEN: usize = 400;
/// How exactly the square of a cell's reach is found where cells overlap, and how many triangles are looked at for it, at most.
const EXACT: f64 = 1e-6;
const MOST_LOOKS: usize = 1 << 11;
/// Corners of triangles, which may be on a boundary, are looked at this part of the way before them.
const ON_BOUNDARY: f64 = 1e-6;

impl LiveMesh {
    /// Whether nothing of a boundary is so near to a point that its star could be another there, and none of its neighbours is the frame's.
    pub(super) fn is_clear(&self, boundary: &Boundary, v: u32, buffer: &mut StarBuffer) -> bool {
        let StarBuffer { star, spokes, .. } = buffer;
        let at = self.mesh.position(v);
        let reach = (0..star.n_spokes()).map(|k| star.lengths[k].max(star.circumradius(k))).fold(0.0, f64::max) * self.spacing;
        spokes.iter().all(|spoke| spoke.vertex < self.n_live)
            && (boundary.clearance(at) > reach || !boundary.is_near(at - reach, at + reach))
    }

    /// Turns the spokes in the buffer into the star of what is seen of the cell in a polygon.
    pub(super) fn fill_within(&self, boundary: &Boundary, v: u32, territory: Territory, buffer: &mut StarBuffer) -> Result<(), Outside> {
        let at = self.mesh.position(v);
        let (low, high) = (-at, self.domain.size - at);
        // Where a boundary is near, little is seen: of a box around, and of a larger one where that is not all.
        let mut half = DVec2::splat(NEARBY * self.spacing);
        let is_less = loop {
            let (box_low, box_high) = (low.max(-half), high.min(half));
            let is_less = self.look_within(boundary, v, [box_low, box_high], territory, buffer)?;
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
        boundary: &Boundary,
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
            if boundary.sees(at, place) {
                wall_cell.cut(other, place - at);
            } else {
                n_hidden += 1;
            }
        }
        if n_hidden == 0 {
            return Ok(sight.look(at, wall_cell, boundary));
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
                if wall_cell.is_cut_by(place - at) && boundary.sees(at, place) {
                    wall_cell.cut(other, place - at);
                    is_cut = true;
                }
            }
            if is_cut {
                sight.look(at, wall_cell, boundary);
                reach = 2.0 * sight.reach();
            }
        }
        Ok(true)
    }

    fn distance_squared(&self, at: DVec2, v: u32) -> f64 {
        self.mesh.position(v).distance_squared(at)
    }

    /// The squared distance of the farthest place of what `v` sees of its cell from the nearest point that sees it, of those that were looked at for its star; the outline is given relative to `v`. What
    /// is not above `floor` may be anything up to it.
    ///
    /// Behind corners cells overlap: what this point sees may be nearer to one that it does not see, and the farthest place then need not be a corner. It is found in smaller and smaller triangles, those
    /// first that may hold it.
    pub fn reach_of_seeing(&self, v: u32, near: &[u32], outline: &[DVec2], floor: f64) -> f64 {
        let at = self.position(v);
        let is_nearer = |place: DVec2, other: DVec2| place.distance_squared(other) < place.length_squared();
        let others = near.iter().map(|&other| self.position(other) - at);
        let nearer: Vec<DVec2> = others.filter(|&other| outline.iter().any(|&corner| is_nearer(corner, other))).collect();
        let farthest = outline.iter().map(|&corner| (at + corner).distance_squared(at)).fold(0.0, f64::max);
        if nearer.is_empty() || farthest <= floor {
            return farthest;
        }
        let sees = |other: DVec2, place: DVec2| self.domain.sees(at + other, at + place);
        let sees_all = |other: DVec2, corners: [DVec2; 3]| {
            self.boundary().is_none_or(|boundary| boundary.sees_all(at + other, corners.map(|corner| at + corner)))
        };
        let ends = outline.iter().zip(outline.iter().cycle().skip(1));
        let mut parts: BinaryHeap<Part> = ends.map(|(&a, &b)| Part::new([DVec2::ZERO, a, b], DVec2::ZERO, f64::INFINITY)).collect();
        let (mut found, mut n_looks) = (floor, 0);
        let mut seers = Vec::new();
        while let Some(part) = parts.pop() {
            if part.bound <= found * (1.0 + EXACT) || n_looks > MOST_LOOKS {
                return part.bound.max(found);
            }
            n_looks += 1;
            let Part { corners, mut seer, bound } = part;
            let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
            let of = |place: DVec2| place.length_squared().min(place.distance_squared(seer));
            let farthest = corners.into_iter().max_by(|&a, &b| of(a).total_cmp(&of(b)));
            for place in [farthest.unwrap_or(middle).lerp(middle, ON_BOUNDARY), middle] {
                let mut distance = place.length_squared().min(place.distance_squared(seer));
                seers.clear();
                seers.extend(nearer.iter().copied().filter(|&other| place.distance_squared(other) < distance));
                seers.sort_by(|a, b| place.distance_squared(*a).total_cmp(&place.distance_squared(*b)));
                for &other in seers.iter().filter(|&&other| sees(other, place)) {
                    distance = distance.min(place.distance_squared(other));
                    // On a boundary nobody sees a place, so one before it stands for it.
                    if sees_all(other, corners.map(|corner| corner.lerp(middle, ON_BOUNDARY))) {
                        seer = other;
                        break;
                    }
                }
                found = found.max(distance);
            }
            parts.extend(halves(corners).map(|corners| Part::new(corners, seer, bound)).into_iter().filter(|part| part.bound > found));
        }
        found
    }
}

/// A triangle of what a point sees of its cell, relative to it.
struct Part {
    corners: [DVec2; 3],
    /// Besides that point one that sees all of it; and the squared distance from points that see it that no place exceeds.
    seer: DVec2,
    bound: f64,
}

impl Part {
    fn new(corners: [DVec2; 3], seer: DVec2, bound: f64) -> Self {
        let farthest = |from: DVec2| corners.iter().map(|corner| corner.distance_squared(from)).fold(0.0, f64::max);
        Self { corners, seer, bound: bound.min(farthest(seer)).min(farthest(DVec2::ZERO)) }
    }
}

impl Ord for Part {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound.total_cmp(&other.bound)
    }
}

impl PartialOrd for Part {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Part {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Part {}

/// A triangle halved across its longest side.
fn halves([a, b, c]: [DVec2; 3]) -> [[DVec2; 3]; 2] {
    let [ab, bc, ca] = [a.distance_squared(b), b.distance_squared(c), c.distance_squared(a)];
    let [a, b, c] = if ab >= bc.max(ca) {
        [a, b, c]
    } else if bc >= ca {
        [b, c, a]
    } else {
        [c, a, b]
    };
    let middle = a.midpoint(b);
    [[a, middle, c], [middle, b, c]]
}
