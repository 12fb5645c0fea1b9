//! Domains of all shapes, for tests.

#![allow(dead_code, clippy::unwrap_used)]

use evenly::{PointSet, Rectangle, Space, Torus};

pub fn torus(origin: [f64; 2], size: [f64; 2]) -> Space {
    Torus::new(origin, size).unwrap().into()
}

pub fn rectangle(origin: [f64; 2], size: [f64; 2]) -> Space {
    Rectangle::new(origin, size).unwrap().into()
}

/// Square and long, far off, tiny and huge.
pub fn spaces() -> Vec<Space> {
    vec![
        torus([0.0, 0.0], [1.0, 1.0]),
        torus([-20.0, 1e9], [300.0, 3.0]),
        torus([0.0, 0.0], [1e-12, 7e-12]),
        rectangle([0.0, 0.0], [1.0, 1.0]),
        rectangle([1e9, -5.0], [1.0, 100.0]),
        rectangle([-1e12, 0.0], [1e12, 3e11]),
    ]
}

/// One of them.
pub fn nth(k: usize) -> Space {
    spaces().swap_remove(k)
}

pub fn n_distinct(points: &PointSet) -> usize {
    let mut bits: Vec<[u64; 2]> = points.positions().iter().map(|p| p.map(f64::to_bits)).collect();
    bits.sort_unstable();
    bits.dedup();
    bits.len()
}
