//! The way along a surface: from a place to the nearest one to a target, from triangle to triangle, so that it never jumps to another sheet.

use glam::DVec3;

use super::{Features, Surface};
use crate::triangulation::{next, prev};

/// A place on a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Place {
    pub face: u32,
    pub at: DVec3,
    /// Of the triangle's corners.
    pub weights: [f64; 3],
}

/// Steps at most; a walk goes nearer with each, so that is for ever.
const MAX_STEPS: usize = 100_000;

impl Place {
    /// Where the weights of a triangle's corners lead.
    pub fn new(surface: &Surface, face: u32, weights: [f64; 3]) -> Self {
        let [a, b, c] = surface.corners(face as usize);
        Self { face, at: weights[0] * a + weights[1] * b + weights[2] * c, weights }
    }

    /// The place's part in three numbers of the triangle's corners.
    pub fn mean(&self, values: [f64; 3]) -> f64 {
        values.iter().zip(self.weights).map(|(value, weight)| value * weight).sum()
    }
}

impl Features {
    /// The surface's normal at a place, rounded between creases.
    pub fn normal(&self, place: &Place) -> DVec3 {
        let normals = &self.corner_normals[3 * place.face as usize..][..3];
        let [a, b, c] = place.weights;
        (a * normals[0] + b * normals[1] + c * normals[2]).normalize_or_zero()
    }
}

impl Surface {
    /// The place nearest to `target`, found by walking from a triangle to the next while that leads nearer; creases are not crossed.
    pub(crate) fn project(&self, features: &Features, face: u32, target: DVec3) -> Place {
        let mut best = self.nearest_on(face, target);
        let mut distance = best.at.distance_squared(target);
        for _ in 0..MAX_STEPS {
            let mut nearer = None;
            let mut look = |face: u32| {
                let place = self.nearest_on(face, target);
                let other = place.at.distance_squared(target);
                if other < distance {
                    (nearer, distance) = (Some(place), other);
                }
            };
            let mesh = &self.half_edges;
            let first = 3 * best.face;
            match best.weights.map(|weight| weight > 0.0) {
                [true, true, true] => return best,
                // On an edge: the triangle across.
                [false, true, true] | [true, false, true] | [true, true, false] => {
                    let opposite = best.weights.iter().position(|&weight| weight <= 0.0).unwrap_or(0) as u32;
                    let edge = next(first + opposite);
                    if features.is_crease[edge as usize] {
                        return best;
                    }
                    look(mesh.twin[edge as usize] / 3);
                }
                // At a corner: all around it, to the creases on both sides.
                _ => {
                    let corner = best.weights.iter().position(|&weight| weight > 0.0).unwrap_or(0) as u32;
                    let start = first + corner;
                    let mut at = start;
                    let is_around = loop {
                        let last = prev(at);
                        if features.is_crease[last as usize] {
                            break false;
                        }
                        at = mesh.twin[last as usize];
                        if at == start {
                            break true;
                        }
                        look(at / 3);
                    };
                    at = start;
                    while !is_around && !features.is_crease[at as usize] {
                        at = next(mesh.twin[at as usize]);
                        look(at / 3);
                    }
                }
            }
            match nearer {
                Some(place) => best = place,
                None => break,
            }
        }
        best
    }

    /// The place of a triangle that is nearest to a target.
    pub(crate) fn nearest_on(&self, face: u32, target: DVec3) -> Place {
        let (at, weights) = nearest_in_triangle(self.corners(face as usize), target);
        Place { face, at, weights }
    }
}

/// The place nearest to `p` in a triangle, and its weights: exactly 0 on edges and at corners (Ericson, "Real-Time Collision Detection", 2005, section 5.1.5).
#[inline]
pub(super) fn nearest_in_triangle([a, b, c]: [DVec3; 3], p: DVec3) -> (DVec3, [f64; 3]) {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return (a, [1.0, 0.0, 0.0]);
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return (b, [0.0, 1.0, 0.0]);
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return (c, [0.0, 0.0, 1.0]);
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let t = d1 / (d1 - d3);
        return (a + t * ab, [1.0 - t, t, 0.0]);
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let t = d2 / (d2 - d6);
        return (a + t * ac, [1.0 - t, 0.0, t]);
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        let t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return (b + t * (c - b), [0.0, 1.0 - t, t]);
    }
    let share = 1.0 / (va + vb + vc);
    let (v, w) = (vb * share, vc * share);
    (a + ab * v + ac * w, [va * share, v, w])
}
