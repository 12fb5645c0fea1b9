//! The normalised domain that all geometry works in.
//!
//! Coordinates are scaled by a power of two, so that the longer side lies in [1, 2), and every position and period is a multiple
//! of 2^-47. Differences of positions, and sums with a few periods, are therefore exact: a triangle and its copy across the
//! seam give the predicates the same bits.

use std::sync::Arc;

use glam::DVec2;

use super::boundary::Boundary;
use super::grid::snap;
use crate::geometry::spacing::hexagonal_spacing;
use crate::predicates::is_left_turn;

/// Adding and subtracting this rounds to an integer, for |x| < 2^51.
const ROUND: f64 = 1.5 * (1u64 << 52) as f64;
/// A box [0, size.x] x [0, size.y], periodic or not, or what a boundary encloses in it.
#[derive(Debug, Clone)]
pub(crate) struct Domain {
    pub size: DVec2,
    pub is_periodic: bool,
    /// 1 / size on a torus, 0 on a rectangle: no difference is ever a period then.
    inverse_period: DVec2,
    /// What a spoke stays below along each axis: half a period, or anything.
    longest_spoke: DVec2,
    origin: DVec2,
    /// The far corner in input units.
    end: DVec2,
    /// A power of two: normalised = (input - origin) * scale.
    scale: f64,
    /// What encloses the domain, where that is not the box itself.
    pub boundary: Option<Arc<Boundary>>,
}

impl Domain {
    /// The box of this size, in input units, with its lower left corner at `origin`.
    pub fn new(origin: [f64; 2], size: [f64; 2], is_periodic: bool) -> Self {
        let (origin, size) = (DVec2::from(origin), DVec2::from(size));
        let scale = libm::ldexp(1.0, -libm::ilogb(size.max_element()));
        let domain = Self {
            size: snap(size * scale),
            is_periodic,
            inverse_period: DVec2::ZERO,
            longest_spoke: DVec2::INFINITY,
            origin,
            end: origin + size,
            scale,
            boundary: None,
        };
        let size = domain.size;
        domain.with_size(size)
    }

    /// What a boundary encloses in it.
    pub fn within(self, boundary: Arc<Boundary>) -> Self {
        Self { boundary: Some(boundary), ..self }
    }

    /// The same domain, `copies` times as wide and high: the finite cover of a torus.
    pub fn covered(&self, copies: [u32; 2]) -> Self {
        self.clone().with_size(self.size * DVec2::new(f64::from(copies[0]), f64::from(copies[1])))
    }

    /// The domain of which this is the cover.
    pub fn uncovered(&self, copies: [u32; 2]) -> Self {
        self.clone().with_size(self.size / DVec2::new(f64::from(copies[0]), f64::from(copies[1])))
    }

    fn with_size(mut self, size: DVec2) -> Self {
        self.size = size;
        if self.is_periodic {
            self.inverse_period = 1.0 / size;
            self.longest_spoke = 0.5 * size;
        }
        self
    }

    pub fn area(&self) -> f64 {
        self.boundary.as_ref().map_or(self.size.x * self.size.y, |boundary| boundary.area)
    }

    /// The spacing of the hexagonal lattice with `n_points` points.
    pub fn hex_spacing(&self, n_points: usize) -> f64 {
        hexagonal_spacing(self.area(), n_points as f64)
    }

    /// From input units.
    pub fn normalize(&self, p: [f64; 2]) -> DVec2 {
        let mut q = (DVec2::from(p) - self.origin) * self.scale;
        if self.is_periodic {
            q -= (q / self.size).floor() * self.size;
        }
        self.inside(q)
    }

    /// A place in input units, normalised, wherever it lies and not rounded.
    pub fn place(&self, p: [f64; 2]) -> DVec2 {
        (DVec2::from(p) - self.origin) * self.scale
    }

    /// Whether a place in the frame, in input units, lies in the domain or on its boundary.
    pub fn holds(&self, p: [f64; 2]) -> bool {
        self.boundary.as_ref().is_none_or(|boundary| boundary.holds(self.land((DVec2::from(p) - self.origin) * self.scale)))
    }

    /// The place in the domain, clear of a boundary, that is next to one in it.
    #[inline]
    pub fn inside(&self, q: DVec2) -> DVec2 {
        let q = self.land(q);
        self.boundary.as_ref().map_or(q, |boundary| boundary.inside(q))
    }

    /// To input units.
    pub fn restore(&self, q: DVec2) -> [f64; 2] {
        let mut p = self.origin + q / self.scale;
        for axis in 0..2 {
            let at_end = p[axis] >= self.end[axis];
            if self.is_periodic && at_end {
                p[axis] = self.origin[axis];
            } else if at_end || q[axis] == self.size[axis] {
                p[axis] = self.end[axis];
            }
        }
        p.into()
    }

    /// A length in input units.
    /// Places in input units, each at its index.
    pub fn restored(&self, order: &[u32], places: &[DVec2]) -> Vec<[f64; 2]> {
        let mut restored = vec![[0.0; 2]; order.len()];
        for (&index, &place) in order.iter().zip(places) {
            restored[index as usize] = self.restore(place);
        }
        restored
    }

    pub fn restore_length(&self, length: f64) -> f64 {
        length / self.scale
    }

    /// The vector from `a` to `b`, the shortest of its periodic images. Exact.
    #[inline]
    pub fn spoke(&self, a: DVec2, b: DVec2) -> DVec2 {
        let d = b - a;
        let periods = (d * self.inverse_period + ROUND) - ROUND;
        d - periods * self.size
    }

    /// Whether three places make a triangle turned the right way, given the spokes from the first to the others; exact. On a torus its
    /// third edge must be a spoke too: in a triangle that reaches too far round, the three would not close.
    #[inline]
    pub fn is_upright(&self, u: DVec2, v: DVec2) -> bool {
        is_left_turn(u, v) && self.is_spoke(v - u)
    }

    /// Whether a vector is shorter than its other periodic images; at half a period two are alike.
    #[inline]
    pub fn is_spoke(&self, d: DVec2) -> bool {
        d.abs().cmplt(self.longest_spoke).all()
    }

    /// The place in the box nearest to `q`, on the grid: wrapped on a torus, clamped in a rectangle.
    #[inline]
    pub fn land(&self, q: DVec2) -> DVec2 {
        let q = snap(q);
        if self.is_periodic {
            let below = DVec2::select(q.cmplt(DVec2::ZERO), self.size, DVec2::ZERO);
            let above = DVec2::select(q.cmpge(self.size), self.size, DVec2::ZERO);
            q + below - above
        } else {
            q.clamp(DVec2::ZERO, self.size)
        }
    }

    /// Where a point at `from` comes to that is to go to `to`: a boundary stops it, or leads it along.
    #[inline]
    pub fn walk(&self, from: DVec2, to: DVec2) -> DVec2 {
        let to = self.land(to);
        self.boundary.as_ref().map_or(to, |boundary| boundary.land(from, to))
    }

    /// Whether no boundary stands between two places.
    #[inline]
    pub fn sees(&self, a: DVec2, b: DVec2) -> bool {
        self.boundary.as_ref().is_none_or(|boundary| boundary.sees(a, b))
    }

    /// The radius of the largest disk around a place that the box holds: on a torus, without covering a place twice.
    pub fn room(&self, q: DVec2) -> f64 {
        let room = if self.is_periodic { 0.5 * self.size } else { q.min(self.size - q) };
        room.min_element()
    }

    /// Whether a place lies in the domain.
    pub fn contains(&self, q: DVec2) -> bool {
        q.cmpge(DVec2::ZERO).all() && q.cmple(self.size).all() && self.boundary.as_ref().is_none_or(|boundary| boundary.contains(q))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::GRID;

    #[test]
    fn a_position_survives_the_way_in_and_out() {
        for (origin, size) in [([0.0, 0.0], [1.0, 1.0]), ([-7.0, 1e6], [3e5, 2.0]), ([1e-9, 0.0], [1e-12, 3e-12])] {
            let domain = Domain::new(origin, size, false);
            let corner = [origin[0] + size[0], origin[1] + size[1]];
            assert_eq!(domain.restore(domain.normalize(origin)), origin);
            assert_eq!(domain.restore(domain.normalize(corner)), corner);
            let inside = [origin[0] + 0.3 * size[0], origin[1] + 0.7 * size[1]];
            let back = domain.restore(domain.normalize(inside));
            for axis in 0..2 {
                assert!((back[axis] - inside[axis]).abs() <= 1e-14 * size[0].max(size[1]).max(origin[axis].abs()));
            }
        }
    }

    #[test]
    fn the_far_side_of_a_torus_is_its_near_side() {
        let domain = Domain::new([-1.0, 2.0], [3.0, 0.7], true);
        assert_eq!(domain.normalize([2.0, 2.7]).x, 0.0);
        assert_eq!(domain.restore(domain.size - GRID)[0], -1.0 + 3.0 - 2.0 * GRID);
        let spoke = domain.spoke(domain.normalize([-0.9, 2.1]), domain.normalize([1.9, 2.1]));
        assert!((domain.restore_length(spoke.x) + 0.2).abs() < 1e-12);
    }
}
