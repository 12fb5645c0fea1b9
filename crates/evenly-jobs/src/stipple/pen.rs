//! How large dots are.

use std::f64::consts::PI;

use evenly::{Density, PointSet};

use super::ink::dot_area;

/// Dots are so wide at most, in the spacing of where it is darkest: they do not touch.
const WIDEST: f64 = 0.8;

/// For each dot its area, relative to the largest, as its size by tone has it.
pub fn dot_areas(points: &PointSet, darkness: &Density, mean_darkness: f64) -> Vec<f64> {
    let ([width, height], n) = (points.space().size(), points.n_points().max(1) as f64);
    // Tones are means over some spacing, so that noise does not show in the sizes.
    let spacing = (width * height / n).sqrt();
    let cells = [width, height].map(|side| (side / spacing).ceil().max(1.0) as usize);
    let tones = darkness.resampled(cells[0], cells[1]);
    let cell = |at: f64, side: f64, n: usize| ((at / side * n as f64) as usize).min(n - 1);
    let tone = |p: &[f64; 2]| tones[cell(p[0], width, cells[0]) + cell(height - p[1], height, cells[1]) * cells[0]];
    points.positions().iter().map(|p| dot_area(mean_darkness * tone(p))).collect()
}

/// The diameter of the largest dot: as wide as dots neither touch each other where they are densest nor make the picture darker than it is.
pub fn widest_dot(points: &PointSet, mean_darkness: f64, areas: &[f64]) -> f64 {
    let area = points.space().area();
    let total: f64 = areas.iter().sum();
    let as_dark = 2.0 * (mean_darkness * area / (PI * total.max(f64::MIN_POSITIVE))).sqrt();
    // The densest of all parts that hold some dots.
    let [width, height] = points.space().size();
    let part = 3.0 * points.hex_spacing();
    let [columns, rows] = [width, height].map(|side| (side / part).ceil().max(1.0) as usize);
    let densest = points.density().resampled(columns, rows).into_iter().fold(1.0, f64::max);
    as_dark.min(WIDEST * points.hex_spacing() / densest.sqrt())
}
