//! Oracles: what is measured, found once more by brute force over points, places and segments. They know no triangulation, and nothing of the library but its data types.

mod cells;
mod masses;
mod plane;
mod surfaces;
mod visibility;

use glam::DVec2;

/// Numbers from 0 to 1, by the generator splitmix64.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn place(&mut self, origin: DVec2, size: DVec2) -> DVec2 {
        origin + size * DVec2::new(self.unit(), self.unit())
    }
}

/// The spacing of the hexagonal lattice, from its definition.
fn hex_spacing(area: f64, n_points: usize) -> f64 {
    (2.0 * area / (3f64.sqrt() * n_points as f64)).sqrt()
}

#[track_caller]
fn assert_near(found: f64, expected: f64, tolerance: f64, case: &str) {
    assert!((found - expected).abs() <= tolerance, "{case}: {found}, expected {expected}");
}

/// The part of a convex polygon where x . way <= half.
fn cut<T: Copy>(polygon: &[(DVec2, T)], way: DVec2, half: f64, label: T) -> Vec<(DVec2, T)> {
    let excess = |corner: DVec2| corner.dot(way) - half;
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (k, &(a, side)) in polygon.iter().enumerate() {
        let (b, _) = polygon[(k + 1) % polygon.len()];
        let (at_a, at_b) = (excess(a), excess(b));
        let crossing = || a + (b - a) * (at_a / (at_a - at_b));
        match (at_a <= 0.0, at_b <= 0.0) {
            (true, true) => kept.push((a, side)),
            (true, false) => kept.extend([(a, side), (crossing(), label)]),
            (false, true) => kept.push((crossing(), side)),
            (false, false) => {}
        }
    }
    kept
}

/// The area that corners enclose, counter-clockwise.
fn area(corners: &[DVec2]) -> f64 {
    ends(corners).map(|(a, b)| 0.5 * a.perp_dot(b)).sum()
}

fn ends(corners: &[DVec2]) -> impl Iterator<Item = (DVec2, DVec2)> {
    corners.iter().copied().zip(corners.iter().copied().cycle().skip(1))
}
