//! What the input's own corners force: where no division of an angle between two creases is within the targets, the triangles in it cannot be.

use super::live::LiveSurface;
use super::polish::Bounds;
use crate::geometry::triangle::Shape;
use crate::triangulation::{BOUNDARY, next, prev};

/// A triangle in such a corner may be worse than its best division by so much, in degrees.
const SPARE_DEG: f64 = 3.0;
/// And is not obtuse, to rounding.
pub(super) const RIGHT_DEG: f64 = 90.0 + 1e-6;

/// Triangles that miss the bounds on angles.
#[derive(Debug, Default)]
pub(super) struct Missed {
    /// Those in corners of the input that force it, by their numbers.
    pub forced: Vec<usize>,
    /// At so many corners.
    pub n_corners: usize,
    /// How many others there are.
    pub n_others: usize,
}

/// Angles that every mesh is to keep, in degrees, but where the input forces others.
const PLAIN_DEG: [f64; 2] = [30.0, 90.0];

impl LiveSurface<'_> {
    /// By how much triangles that the input does not force miss what every mesh is to keep, all together.
    pub(super) fn misfit(&self) -> f64 {
        let bounds = Bounds::new(PLAIN_DEG);
        let mesh = self.half_edges();
        let free = mesh.triangles().enumerate().filter(|(t, _)| self.forced.binary_search(t).is_err());
        free.map(|(_, t)| {
            let [least, most] = Shape::of_space(t.map(|v| self.at(v))).extreme_angles_deg();
            if bounds.hold([least, most]) { 0.0 } else { (PLAIN_DEG[0] - least).max(0.0) + (most - PLAIN_DEG[1]).max(0.0) }
        })
        .sum()
    }

    /// The triangles that miss the bounds on angles, and which of them the input's corners force to.
    pub(super) fn missed(&self, bounds: Bounds) -> Missed {
        let mesh = self.half_edges();
        let mut missed = Missed::default();
        let mut corners = Vec::new();
        for (t, vertices) in mesh.triangles().enumerate() {
            let shape = Shape::of_space(vertices.map(|v| self.at(v)));
            let [least, most] = shape.extreme_angles_deg();
            if bounds.hold([least, most]) {
                continue;
            }
            let forcing = (0..3).filter(|&k| self.is_bound(vertices[k])).find(|&k| {
                let best = bounds.best_division(self.sector_deg(3 * t as u32 + k as u32));
                // Nothing but the input's own obtuse angle makes one.
                best.is_some_and(|[smallest, largest]| least >= smallest - SPARE_DEG && most <= largest.max(RIGHT_DEG))
            });
            match forcing {
                Some(k) => {
                    missed.forced.push(t);
                    corners.push(vertices[k]);
                }
                None => missed.n_others += 1,
            }
        }
        corners.sort_unstable();
        corners.dedup();
        missed.n_corners = corners.len();
        missed
    }

    /// The angle in degrees between the two creases, or boundaries, on either side of the corner that half-edge `h` leaves, all triangles between them together.
    fn sector_deg(&self, h: u32) -> f64 {
        let mesh = &self.mesh;
        let at = mesh.origin(h);
        let angle = |h: u32| {
            let [a, b, c] = [h, next(h), prev(h)].map(|h| self.at(mesh.origin(h)));
            (b - a).angle_between(c - a).to_degrees()
        };
        let mut sum = angle(h);
        // One way around, then the other.
        let mut side = h;
        while !self.is_bond(at, mesh.origin(next(side))) {
            let twin = mesh.twin(side);
            if twin == BOUNDARY || next(twin) == h {
                break;
            }
            side = next(twin);
            sum += angle(side);
        }
        let mut side = prev(h);
        while !self.is_bond(at, mesh.origin(side)) {
            let twin = mesh.twin(side);
            if twin == BOUNDARY || twin == h {
                break;
            }
            sum += angle(twin);
            side = prev(twin);
        }
        sum
    }
}

impl Bounds {
    /// Whether an angle can be divided so that all parts are within the bounds.
    pub(super) fn divides(self, angle_deg: f64) -> bool {
        self.best_division(angle_deg).is_none()
    }

    /// Of an angle that no number of equal parts brings within the bounds, the smallest and the largest angle that triangles in its best division have; `None` for one
    /// that can be divided.
    fn best_division(self, angle_deg: f64) -> Option<[f64; 2]> {
        let [smallest, largest] = self.degrees();
        let excess = |n: f64| (smallest - angle_deg / n).max(angle_deg / n - largest).max(0.0);
        let n = (angle_deg / largest).ceil().max(1.0);
        if excess(n) == 0.0 {
            return None;
        }
        // One part fewer, or as many.
        let n = if n > 1.0 && excess(n - 1.0) < excess(n) { n - 1.0 } else { n };
        let part = angle_deg / n;
        // Beside a large part the two others are small.
        let others = 0.5 * (180.0 - part);
        Some([part.min(others).min(smallest), part.max(others).max(largest)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn right_and_sharp_angles_are_forced_and_others_are_not() {
        let bounds = Bounds::of_beta(0.7);
        for divided in [60.0, 46.0, 88.0, 91.5, 120.0, 170.0, 180.0, 270.0, 360.0] {
            assert_eq!(bounds.best_division(divided), None, "{divided}");
        }
        let [least, most] = bounds.best_division(90.0).unwrap();
        assert!((least - 45.0).abs() < 1e-9 && most < 89.0, "{least} {most}");
        let [least, _] = bounds.best_division(20.0).unwrap();
        assert!((least - 20.0).abs() < 1e-9);
    }
}
