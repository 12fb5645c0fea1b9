//! The grid on which all positions lie.

use glam::DVec2;

/// Adding and subtracting this rounds to a multiple of 2^-47, for |x| < 16.
const SNAP: f64 = 1.5 * 32.0;
/// The spacing of the grid on which all positions lie.
pub(crate) const GRID: f64 = 1.0 / (1u64 << 47) as f64;

/// Rounds to the grid.
#[inline]
pub(crate) fn snap(p: DVec2) -> DVec2 {
    (p + SNAP) - SNAP
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn snapping_is_a_round_trip_to_the_grid() {
        let p = snap(DVec2::new(1.0 / 3.0, -0.1));
        assert_eq!(p, snap(p));
        assert!((p.x / GRID).fract() == 0.0 && (p.y / GRID).fract() == 0.0);
    }
}
