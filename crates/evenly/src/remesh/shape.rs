//! What triangles on a surface must be: fit to it, and Delaunay.

use glam::DVec3;

/// The angles across an edge may exceed pi by so much in the sine of their sum.
const ROUNDING: f64 = 1e-9;
/// A flip turns no triangle by more than this: the cosine.
const LEAST_TURN: f64 = 0.1;

/// How far a triangle's normal may lean from the surface's: the cosine must not be less, or not fall.
#[derive(Debug, Clone, Copy)]
pub(super) struct Guard(pub f64);

impl Guard {
    pub const FIRM: Self = Self(0.6);
    /// Where moves have been blocked so often the guard softens by this much each time, down to the last.
    const SOFTENING: f64 = 0.005;
    const SOFT: f64 = 0.3;

    /// The guard at a vertex whose moves have been blocked so often.
    pub fn after(n_blocked: u32) -> Self {
        Self((Self::FIRM.0 - Self::SOFTENING * f64::from(n_blocked)).max(Self::SOFT))
    }

    pub fn allows(self, before: f64, after: f64) -> bool {
        after > self.0 || after >= before
    }

    /// Whether the edge between the first two of four corners may become that between the last two: that turns no triangle over, or away from the surface, whose normals count where
    /// they are given.
    pub fn allows_flip(self, [p, q, r, s]: [DVec3; 4], normals: [Option<DVec3>; 4]) -> bool {
        let normal = |a: DVec3, b: DVec3, c: DVec3| (b - a).cross(c - a);
        let (left, right, new) = (normal(p, q, r), normal(q, p, s), [normal(s, q, r), normal(r, p, s)]);
        let old = left + right;
        if !new.iter().all(|n| n.dot(old) > LEAST_TURN * n.length() * old.length()) {
            return false;
        }
        let [at_p, at_q, at_r, at_s] = normals;
        let before = Self::fit(left, [at_p, at_q, at_r]).min(Self::fit(right, [at_q, at_p, at_s]));
        let after = Self::fit(new[0], [at_s, at_q, at_r]).min(Self::fit(new[1], [at_r, at_p, at_s]));
        self.allows(before, after)
    }

    /// Whether a triangle fits the surface so well, whatever it was before. Without a root.
    #[inline]
    pub fn holds(self, normal: DVec3, corners: [Option<DVec3>; 3]) -> bool {
        let (sum, n) = total(corners);
        let (dot, least) = (normal.dot(sum), self.0 * n);
        n == 0.0 || dot > 0.0 && dot * dot > least * least * normal.length_squared()
    }

    /// The cosine between a triangle's normal, of any length, and the mean of those of its corners that count; 1 if none does.
    #[inline]
    pub fn fit(normal: DVec3, corners: [Option<DVec3>; 3]) -> f64 {
        let (sum, n) = total(corners);
        if n == 0.0 {
            return 1.0;
        }
        let length = n * normal.length();
        if length > 0.0 { normal.dot(sum) / length } else { -1.0 }
    }
}

/// The sum of what counts, and how many do.
#[inline]
fn total(corners: [Option<DVec3>; 3]) -> (DVec3, f64) {
    corners.into_iter().flatten().fold((DVec3::ZERO, 0.0), |(sum, n), corner| (sum + corner, n + 1.0))
}

/// Whether the angles at `r` and `s` across the edge `p` `q` sum to pi at most: in space, too, one of both diagonals does, so flips come to an end.
#[inline]
pub(super) fn is_delaunay([p, q, r, s]: [DVec3; 4]) -> bool {
    let (u, v, w, x) = (p - r, q - r, q - s, p - s);
    let (cross_r, cross_s) = (u.cross(v).length(), w.cross(x).length());
    let (dot_r, dot_s) = (u.dot(v), w.dot(x));
    // The sine of the sum, times all four lengths.
    let sine = dot_r * cross_s + cross_r * dot_s;
    let is_more = sine < -ROUNDING * ((dot_r * dot_r + cross_r * cross_r) * (dot_s * dot_s + cross_s * cross_s)).sqrt();
    // What cannot be told, of triangles too small for numbers, stays.
    !is_more
}
