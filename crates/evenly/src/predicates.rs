//! The only place where the sign of a determinant is decided: exact, by Shewchuk's adaptive arithmetic (crate `robust`).
//!
//! A plain f64 filter stands in front and answers nearly every call; its error bounds are Shewchuk's
//! ("Adaptive precision floating-point arithmetic", 1997, doi 10.1007/PL00009321).

use glam::{DVec2, DVec3};
use robust::{Coord, Coord3D};

/// Half an ulp of 1, Shewchuk's epsilon.
const EPSILON: f64 = f64::EPSILON / 2.0;
const ORIENT_BOUND: f64 = (3.0 + 16.0 * EPSILON) * EPSILON;
const IN_CIRCLE_BOUND: f64 = (10.0 + 96.0 * EPSILON) * EPSILON;

fn coord(p: DVec2) -> Coord<f64> {
    Coord { x: p.x, y: p.y }
}

/// Whether the turn from `u` to `v` is strictly to the left: the triangle (0, u, v) is counter-clockwise.
#[inline]
pub(crate) fn is_left_turn(u: DVec2, v: DVec2) -> bool {
    let (left, right) = (u.x * v.y, u.y * v.x);
    let det = left - right;
    let bound = ORIENT_BOUND * (left.abs() + right.abs());
    if det > bound {
        return true;
    }
    if det < -bound {
        return false;
    }
    robust::orient2d(coord(DVec2::ZERO), coord(u), coord(v)) > 0.0
}

/// Whether `w` lies strictly inside the circle through the origin, `u` and `v`, which make a counter-clockwise triangle.
#[inline]
pub(crate) fn is_in_circle(u: DVec2, v: DVec2, w: DVec2) -> bool {
    let (uu, vv, ww) = (u.length_squared(), v.length_squared(), w.length_squared());
    // The lifted determinant, expanded along the squares; positive where w lies outside.
    let (vw, uw, uv) = (v.perp_dot(w), u.perp_dot(w), u.perp_dot(v));
    let det = uu * vw - vv * uw + ww * uv;
    let permanent = |a: DVec2, b: DVec2| (a.x * b.y).abs() + (a.y * b.x).abs();
    let bound = IN_CIRCLE_BOUND * (uu * permanent(v, w) + vv * permanent(u, w) + ww * permanent(u, v));
    if det > bound {
        return false;
    }
    if det < -bound {
        return true;
    }
    robust::incircle(coord(DVec2::ZERO), coord(u), coord(v), coord(w)) > 0.0
}

/// Whether all points lie on one line.
pub(crate) fn are_collinear(points: &[DVec2]) -> bool {
    let Some((&first, rest)) = points.split_first() else { return true };
    // The farthest point from the first gives a line that is as well defined as it can be.
    let Some(&far) = rest.iter().max_by(|a, b| a.distance_squared(first).total_cmp(&b.distance_squared(first))) else {
        return true;
    };
    rest.iter().all(|&p| robust::orient2d(coord(first), coord(far), coord(p)) == 0.0)
}

/// Positive where `d` lies on the side of the triangle from which its corners run clockwise, negative on the other, and 0 in its plane.
pub(crate) fn orientation(a: DVec3, b: DVec3, c: DVec3, d: DVec3) -> f64 {
    let [a, b, c, d] = [a, b, c, d].map(|p| Coord3D { x: p.x, y: p.y, z: p.z });
    robust::orient3d(a, b, c, d)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_too_small_for_plain_f64_is_decided_exactly() {
        let u = DVec2::new(1.0, 1.0 + f64::EPSILON);
        let v = DVec2::new(1.0 - EPSILON, 1.0);
        // x_u y_v - y_u x_v = 1 - (1 + 2e)(1 - e) = -e + 2e^2 < 0, with e = EPSILON.
        assert!(!is_left_turn(u, v));
        assert!(is_left_turn(v, u));
        assert!(!is_left_turn(u, u));
    }

    #[test]
    fn four_corners_of_a_square_lie_on_one_circle() {
        assert!(!is_in_circle(DVec2::X, DVec2::ONE, DVec2::Y));
        let nearer = DVec2::new(0.0, 1.0 - EPSILON);
        let farther = DVec2::new(0.0, 1.0 + f64::EPSILON);
        assert!(is_in_circle(DVec2::X, DVec2::ONE, nearer));
        assert!(!is_in_circle(DVec2::X, DVec2::ONE, farther));
    }
}
