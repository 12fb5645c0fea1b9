//! Polygons of all kinds, for tests.

#![allow(dead_code, clippy::unwrap_used)]

use std::f64::consts::TAU;

/// A ring of points.
pub type Ring = Vec<[f64; 2]>;

pub fn rectangle([x, y]: [f64; 2], [width, height]: [f64; 2]) -> Ring {
    vec![[x, y], [x + width, y], [x + width, y + height], [x, y + height]]
}

pub fn l_shape() -> Vec<Ring> {
    vec![vec![[0.0, 0.0], [1.0, 0.0], [1.0, 0.5], [0.5, 0.5], [0.5, 1.0], [0.0, 1.0]]]
}

/// A square with a crooked hole.
pub fn holed_square() -> Vec<Ring> {
    vec![rectangle([0.0, 0.0], [1.0, 1.0]), vec![[0.35, 0.3], [0.65, 0.35], [0.7, 0.65], [0.3, 0.6]]]
}

/// Tips at radius 1, and corners between them at a radius from 0 to 1.
pub fn star(n_tips: usize, inner: f64) -> Vec<Ring> {
    let corner = |k: usize| {
        let radius = if k.is_multiple_of(2) { 1.0 } else { inner };
        let (sin, cos) = (TAU * k as f64 / (2 * n_tips) as f64).sin_cos();
        [radius * cos, radius * sin]
    };
    vec![(0..2 * n_tips).map(corner).collect()]
}

pub fn circle(n_corners: usize) -> Vec<Ring> {
    star(n_corners.div_ceil(2), 1.0)
}

/// Teeth as wide as told, a tenth apart, on a bar.
pub fn comb(n_teeth: usize, width: f64) -> Vec<Ring> {
    let pitch = 1.0 / n_teeth as f64;
    let mut ring = vec![[0.0, 0.0], [1.0, 0.0]];
    for k in (0..n_teeth).rev() {
        let left = k as f64 * pitch;
        let right = left + width * pitch;
        ring.extend([[right, 0.2], [right, 1.0], [left, 1.0], [left, 0.2]]);
    }
    vec![ring]
}

/// An arm as wide as told that winds inwards.
pub fn spiral(n_turns: f64, width: f64) -> Vec<Ring> {
    let n = (24.0 * n_turns) as usize;
    let at = |k: usize, shift: f64| {
        let turn = TAU * k as f64 / 24.0;
        let radius = 1.0 - 0.8 * k as f64 / n as f64 + shift;
        [radius * turn.cos(), radius * turn.sin()]
    };
    let gap = 0.8 / n_turns;
    let outer = (0..=n).map(|k| at(k, 0.0));
    vec![outer.chain((0..=n).rev().map(|k| at(k, -width * gap))).collect()]
}

/// Squares in squares, each a hole in the one before or an island in it.
pub fn nested(n_rings: usize) -> Vec<Ring> {
    (0..n_rings).map(|k| k as f64 / (2 * n_rings + 1) as f64).map(|low| rectangle([low, low], [1.0 - 2.0 * low; 2])).collect()
}

pub fn needle(height: f64) -> Vec<Ring> {
    vec![vec![[0.0, 0.0], [1.0, 0.0], [0.5, height]]]
}

/// A square cut open from the right to near its middle, as wide as told.
pub fn slit(width: f64) -> Vec<Ring> {
    let half = 0.5 * width;
    vec![vec![[0.0, 0.0], [1.0, 0.0], [1.0, 0.5 - half], [0.3, 0.5], [1.0, 0.5 + half], [1.0, 1.0], [0.0, 1.0]]]
}

/// Two squares and a passage between them, as wide as told.
pub fn passage(width: f64) -> Vec<Ring> {
    let (low, high) = (0.4, 0.4 + width);
    let lower = [[0.0, 0.0], [1.0, 0.0], [1.0, low], [2.0, low], [2.0, 0.0], [3.0, 0.0]];
    let upper = [[3.0, 1.0], [2.0, 1.0], [2.0, high], [1.0, high], [1.0, 1.0], [0.0, 1.0]];
    vec![lower.into_iter().chain(upper).collect()]
}

/// Turned by an angle, scaled, and moved.
pub fn moved(rings: &[Ring], turn: f64, scale: f64, origin: [f64; 2]) -> Vec<Ring> {
    let (sin, cos) = turn.sin_cos();
    let place = |&[x, y]: &[f64; 2]| [origin[0] + scale * (cos * x - sin * y), origin[1] + scale * (sin * x + cos * y)];
    rings.iter().map(|ring| ring.iter().map(place).collect()).collect()
}

/// A coast: a circle whose sides have been halved, and their middles moved, until it has so many corners.
pub fn coast(n_corners: usize) -> Vec<Ring> {
    // A plain generator, so that it is always the same coast.
    let mut state = 1u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1u32 << 30) - 1.0
    };
    let mut ring = star(6, 1.0).remove(0);
    while ring.len() < n_corners {
        let next = ring.iter().cycle().skip(1);
        let halved = ring.iter().zip(next).flat_map(|(&[ax, ay], &[bx, by])| {
            let by_how_much = 0.2 * random();
            [[ax, ay], [0.5 * (ax + bx) + by_how_much * (by - ay), 0.5 * (ay + by) - by_how_much * (bx - ax)]]
        });
        ring = halved.collect();
    }
    vec![ring]
}
