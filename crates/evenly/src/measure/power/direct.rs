//! Waves summed point by point: exact to rounding.
//!
//! With e(t) = exp(-2 pi i t), the sum over points of e(a x) e(b y) is a product of matrices, frequencies a times points times frequencies b; in real
//! numbers, of cosines and sines. One product serves b and -b.

use ndarray::{Array2, Axis, linalg::general_mat_mul};
use rayon::prelude::*;

use super::waves::Waves;

/// Frequencies along each axis, and points, in one product: as much as lies in a cache.
const ROWS: usize = 64;
const COLUMNS: usize = 1024;
const POINTS: usize = 1024;

/// Adds `share` of the power of every frequency.
pub(super) fn add_power(waves: &Waves, share: f64, power: &mut [f64]) {
    let half = waves.half[1];
    power.par_chunks_mut(ROWS * (2 * half + 1)).enumerate().for_each(|(block, power)| {
        for first in (0..=half).step_by(COLUMNS) {
            add_block(waves, share, [block * ROWS, first], power);
        }
    });
}

/// Adds to rows of frequencies, `power`, those columns b that begin with `first` up or down from 0.
fn add_block(waves: &Waves, share: f64, first: [usize; 2], power: &mut [f64]) {
    let half = waves.half[1];
    let n_rows = power.len() / (2 * half + 1);
    let n_columns = COLUMNS.min(half + 1 - first[1]);
    let sums = sums(waves, first, [n_rows, n_columns]);
    for (row, power) in power.chunks_mut(2 * half + 1).enumerate() {
        for column in 0..n_columns {
            let of = |function: [usize; 2]| sums[[row + function[0] * n_rows, column + function[1] * n_columns]];
            let [cc, cs, sc, ss] = [[0, 0], [0, 1], [1, 0], [1, 1]].map(of);
            let (a, b) = (first[0] + row, first[1] + column);
            let mut add = |at: usize, b: i64, real: f64, imaginary: f64| {
                let real = real - waves.of_density(a, b);
                power[at] += share * (real * real + imaginary * imaginary);
            };
            add(half + b, b as i64, cc - ss, sc + cs);
            if b > 0 {
                add(half - b, -(b as i64), cc + ss, sc - cs);
            }
        }
    }
}

/// The products of functions of x, cosines of so many frequencies from the first on and then their sines, with those of y; summed over the points.
fn sums(waves: &Waves, first: [usize; 2], [n_rows, n_columns]: [usize; 2]) -> Array2<f64> {
    let mut sums = Array2::zeros((2 * n_rows, 2 * n_columns));
    let (mut of_x, mut of_y) = (Array2::zeros((POINTS, 2 * n_rows)), Array2::zeros((POINTS, 2 * n_columns)));
    for start in (0..waves.x.len()).step_by(POINTS) {
        let n_points = POINTS.min(waves.x.len() - start);
        for point in 0..n_points {
            let index = start + point;
            turn(waves.x[index], first[0], waves.weight[index], of_x.row_mut(point).as_slice_mut().unwrap_or_default());
            turn(waves.y[index], first[1], 1.0, of_y.row_mut(point).as_slice_mut().unwrap_or_default());
        }
        let [(of_x, _), (of_y, _)] = [&of_x, &of_y].map(|functions| functions.view().split_at(Axis(0), n_points));
        general_mat_mul(1.0, &of_x.t(), &of_y, 1.0, &mut sums);
    }
    sums
}

/// Fills in the cosines of a place's frequencies from `first` on, and then the sines: each from the one before, by a rotation.
fn turn(place: f64, first: usize, weight: f64, functions: &mut [f64]) {
    use std::f64::consts::TAU;
    let (cosines, sines) = functions.split_at_mut(functions.len() / 2);
    let start = (first as f64 * place).fract();
    let (sine, cosine) = libm::sincos(TAU * start);
    let (turn_sine, turn_cosine) = libm::sincos(TAU * place);
    let (mut c, mut s) = (weight * cosine, weight * sine);
    for (cosine, sine) in cosines.iter_mut().zip(sines) {
        (*cosine, *sine) = (c, s);
        (c, s) = (c * turn_cosine - s * turn_sine, s * turn_cosine + c * turn_sine);
    }
}
