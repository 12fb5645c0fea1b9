//! Which targets are known to be reached.

use super::PushPullParams;

/// Coverage radii, and the largest smallest distances with which runs on a torus of 1,000 and of 10,000 points converge: for capacity
/// tolerances from 0.0386, and from 0.1 or without one. Between rows the tougher one counts.
const KNOWN: [(f64, f64, f64); 8] = [
    (0.61, 0.00, 0.90),
    (0.62, 0.91, 0.92),
    (0.63, 0.92, 0.92),
    (0.64, 0.92, 0.93),
    (0.65, 0.93, 0.94),
    (0.67, 0.94, 0.95),
    (0.70, 0.94, 0.95),
    (0.75, 0.94, 0.96),
];

/// The nearest targets that are known to be reached, where those of `params` are tougher.
pub(super) fn nearest_known(params: &PushPullParams) -> Option<(f64, f64)> {
    let distance = params.min_distance.unwrap_or(0.0);
    let radius = params.coverage_radius.unwrap_or(f64::INFINITY);
    let is_loose = params.capacity_tolerance.is_none_or(|tolerance| tolerance >= 0.1);
    let rows = KNOWN.map(|(radius, strict, loose)| (radius, if is_loose { loose } else { strict }));
    let reached = |(row_radius, most): (f64, f64)| (most > 0.0).then(|| (distance.min(most), radius.max(row_radius)));
    let way = |&(near_distance, near_radius): &(f64, f64)| {
        (distance - near_distance) + if radius.is_finite() { near_radius - radius } else { 0.0 }
    };
    let nearest = rows.into_iter().filter_map(reached).min_by(|a, b| way(a).total_cmp(&way(b)))?;
    (way(&nearest) > 0.0).then_some(nearest)
}
