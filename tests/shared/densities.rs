//! Densities on the unit square for tests and benches.

use std::f64::consts::TAU;

/// Waves along both axes: 1 + depth to 1 - depth.
pub fn waves(depth: f64) -> impl Fn([f64; 2]) -> f64 {
    move |p| 1.0 + depth * (TAU * p[0]).cos() * (TAU * p[1]).cos()
}

/// Two blobs on a floor, across the seam of a torus.
pub fn blobs(floor: f64) -> impl Fn([f64; 2]) -> f64 {
    let blob = |p: [f64; 2], centre: [f64; 2], width: f64| {
        let squared: f64 = (0..2).map(|axis| (p[axis] - centre[axis]).abs()).map(|d| d.min(1.0 - d).powi(2)).sum();
        (-squared / (2.0 * width * width)).exp()
    };
    move |p| floor + blob(p, [0.3, 0.3], 0.1) + blob(p, [0.7, 0.6], 0.15)
}

/// A number from 0 to 1 for a place, as if at random.
pub fn hash(p: [f64; 2]) -> f64 {
    ((p[0] * 7919.0 + p[1] * 104_729.0).sin() * 43_758.545_3).fract().abs()
}
