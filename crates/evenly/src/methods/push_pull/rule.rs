//! The three steps of a visit, on a copy of the star: pull what is too far, push what is too near, and press or suck where the cell is
//! too small or too large. All move neighbours along their spokes, so the angles of the star stay true.

use crate::star::{Rule, Senses, Star};

/// How much beyond the wanted distance a neighbour is pushed: nothing is then left to rounding.
const OVERSHOOT: f64 = 1e-3;
/// What is kept without a wanted distance, so that no two points ever meet.
const LEAST_DISTANCE: f64 = 1e-3;
/// How much below the wanted radius a triangle is pulled.
const UNDERSHOOT: f64 = 1e-4;
/// A capacity that differs from the mean by less than this is that of the mean.
pub(super) const LEAST_TOLERANCE: f64 = 1e-8;
/// Sides shorter than this part of a cell's longest, walls aside, do next to nothing for its area: the neighbours behind them stay.
const SHORT: f64 = 0.25;
/// How much of a star's slack is taken off the distance and added to the radius and the tolerance. Cells
/// at boundaries are of any area, and those next to them must make up for it; of distances least is given.
const SLACK_OF_DISTANCE: f64 = 0.2;
const SLACK_OF_RADIUS: f64 = 1.0;
const SLACK_OF_CAPACITY: f64 = 20.0;
/// The area of a cell of the hexagonal lattice with spacing 1: the mean capacity.
const MEAN_CAPACITY: f64 = 0.866_025_403_784_438_6;

/// The targets, relative to the wanted spacing and the mean capacity, and the part of each move that is made.
#[derive(Clone, Copy)]
pub(crate) struct PushPull {
    pub min_distance: Option<f64>,
    pub coverage_radius: Option<f64>,
    pub capacity_tolerance: Option<f64>,
    pub relaxation: f64,
}

impl Rule for PushPull {
    fn senses(&self) -> Senses {
        Senses {
            lengths: Some(self.min_distance.unwrap_or(LEAST_DISTANCE)),
            radii: self.coverage_radius,
            mass: self.capacity_tolerance.is_some(),
            ..Senses::default()
        }
    }

    fn visit(&self, star: &mut Star) -> bool {
        let &Self { min_distance, coverage_radius, capacity_tolerance, relaxation } = self;
        let slack = star.slack;
        let has_pulled = coverage_radius.is_some_and(|radius| cover(star, radius * (1.0 + SLACK_OF_RADIUS * slack), relaxation));
        let least = (1.0 - SLACK_OF_DISTANCE * slack).max(LEAST_DISTANCE);
        let has_pushed = push_away(star, least * min_distance.unwrap_or(LEAST_DISTANCE), relaxation);
        let has_pressed = capacity_tolerance.is_some_and(|tolerance| equalize(star, tolerance + SLACK_OF_CAPACITY * slack, relaxation));
        has_pulled || has_pushed || has_pressed
    }
}

/// Coverage (the paper's optimization 2): a triangle whose circumradius is too large is pulled in, to a similar one. Of two triangles
/// that pull at a neighbour the stronger has it. Obtuse ones are pulled too: on curved surfaces they count.
fn cover(star: &mut Star, radius: f64, relaxation: f64) -> bool {
    if star.is_all_covered(radius) {
        return false;
    }
    let n = star.n_spokes();
    let mut scales = std::mem::take(&mut star.scratch);
    scales.clear();
    scales.resize(n, 1.0f64);
    for k in (0..n).filter(|&k| !star.is_covered(k, radius)) {
        let scale = radius * (1.0 - UNDERSHOOT) / star.weighted_radius(k);
        for end in [k, star.after(k)] {
            scales[end] = scales[end].min(scale);
        }
    }
    for (length, scale) in star.lengths.iter_mut().zip(&scales) {
        *length *= 1.0 - relaxation * (1.0 - scale);
    }
    star.scratch = scales;
    true
}

/// Conflict (optimization 1): a neighbour that is too near is pushed away. One's own image behind a wall is no neighbour.
fn push_away(star: &mut Star, distance: f64, relaxation: f64) -> bool {
    let mut has_pushed = false;
    let is_weighted = !star.metric.spokes.is_empty();
    for k in 0..star.n_spokes() {
        let stretch = if is_weighted { star.stretch(k) } else { 1.0 };
        let weighted = star.lengths[k] * stretch;
        if weighted < distance && !star.is_mirror[k] {
            let missing = distance * (1.0 + OVERSHOOT) - weighted;
            star.lengths[k] += relaxation * missing / stretch;
            has_pushed = true;
        }
    }
    has_pushed
}

/// The capacity of the star's cell, relative to the mean.
pub(super) fn capacity(star: &mut Star) -> f64 {
    let area = star.measure_cell();
    star.metric.mass.unwrap_or(area) / MEAN_CAPACITY
}

/// Capacity (optimization 3): a cell of wrong area presses on its sides in proportion to their length, p = -(A - mean) / sum l^2, so that
/// each goes by p l and the neighbour behind it by twice that. Walls do not give way, and short sides are left alone.
fn equalize(star: &mut Star, tolerance: f64, relaxation: f64) -> bool {
    let excess = capacity(star) - 1.0;
    if excess.abs() <= tolerance.max(LEAST_TOLERANCE) + star.leeway {
        return false;
    }
    let Star { lengths, sides, is_mirror, metric, .. } = star;
    for (side, _) in sides.iter_mut().zip(is_mirror).filter(|(_, is_mirror)| **is_mirror) {
        *side = 0.0;
    }
    // A side that is thinner than others, as one that reaches into a gap, counts as a shorter one.
    let densest = metric.sides.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    sides.iter_mut().zip(&metric.sides).for_each(|(side, density)| *side *= density / densest);
    let short = SHORT * sides.iter().copied().fold(0.0, f64::max);
    for side in sides.iter_mut().filter(|side| **side < short) {
        *side = 0.0;
    }
    // Where a side goes by its length times p, the cell gains as much times its mass a length.
    let density = if metric.sides.is_empty() { 1.0 } else { densest };
    let gain: f64 = density * sides.iter().map(|side| side * side).sum::<f64>();
    if gain > 0.0 {
        let pressure = -excess * MEAN_CAPACITY / gain;
        for (length, side) in lengths.iter_mut().zip(sides) {
            *length += relaxation * 2.0 * pressure * *side;
        }
    }
    true
}
