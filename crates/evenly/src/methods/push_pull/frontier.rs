//! Which targets are known to be reached.

/// A coverage radius, and the largest smallest distances with which runs of 1,000 and of 10,000 points converge: for a capacity tolerance
/// from 0.0386, and for one from 0.1 or none. 0 where none is known to.
struct Row {
    radius: f64,
    strict: f64,
    loose: f64,
}

const ON_TORUS: [Row; 8] = [
    Row { radius: 0.61, strict: 0.00, loose: 0.90 },
    Row { radius: 0.62, strict: 0.91, loose: 0.92 },
    Row { radius: 0.63, strict: 0.92, loose: 0.92 },
    Row { radius: 0.64, strict: 0.92, loose: 0.93 },
    Row { radius: 0.65, strict: 0.93, loose: 0.94 },
    Row { radius: 0.67, strict: 0.94, loose: 0.95 },
    Row { radius: 0.70, strict: 0.94, loose: 0.95 },
    Row { radius: 0.75, strict: 0.94, loose: 0.96 },
];

/// Along a wall cells of equal area leave larger gaps. In a domain at least [`WIDE`] spacings wide.
const IN_RECTANGLE: [Row; 5] = [
    Row { radius: 0.64, strict: 0.00, loose: 0.90 },
    Row { radius: 0.65, strict: 0.90, loose: 0.94 },
    Row { radius: 0.66, strict: 0.92, loose: 0.95 },
    Row { radius: 0.70, strict: 0.92, loose: 0.95 },
    Row { radius: 0.75, strict: 0.94, loose: 0.95 },
];

/// The same where it is at least [`NARROW`] wide, from 300 points in a square.
const IN_SMALL_RECTANGLE: [Row; 5] = [
    Row { radius: 0.65, strict: 0.80, loose: 0.92 },
    Row { radius: 0.66, strict: 0.85, loose: 0.94 },
    Row { radius: 0.67, strict: 0.92, loose: 0.94 },
    Row { radius: 0.70, strict: 0.92, loose: 0.95 },
    Row { radius: 0.75, strict: 0.94, loose: 0.95 },
];

/// Where next to all points stand at walls.
const BETWEEN_WALLS: [Row; 1] = [Row { radius: 0.75, strict: 0.85, loose: 0.90 }];

const WIDE: f64 = 24.0;
const NARROW: f64 = 15.0;

/// With summed moves, everywhere.
const SUMMED: [Row; 1] = [Row { radius: 0.65, strict: 0.90, loose: 0.90 }];

/// What is known.
#[derive(Clone, Copy)]
pub(super) enum Known {
    OnTorus,
    InRectangle,
    InSmallRectangle,
    BetweenWalls,
    Summed,
}

impl Known {
    /// In a rectangle or polygon whose frame is so many spacings wide, or high if that is less.
    pub fn within_walls(width: f64) -> Self {
        match width {
            _ if width >= WIDE => Self::InRectangle,
            _ if width >= NARROW => Self::InSmallRectangle,
            _ => Self::BetweenWalls,
        }
    }
}

/// The nearest distance and radius that are known to be reached, where these are tougher.
pub(super) fn nearest_known(distance: Option<f64>, radius: Option<f64>, tolerance: Option<f64>, known: Known) -> Option<(f64, f64)> {
    let (distance, radius) = (distance.unwrap_or(0.0), radius.unwrap_or(f64::INFINITY));
    let is_loose = tolerance.is_none_or(|tolerance| tolerance >= 0.1);
    let rows: &[Row] = match known {
        Known::OnTorus => &ON_TORUS,
        Known::InRectangle => &IN_RECTANGLE,
        Known::InSmallRectangle => &IN_SMALL_RECTANGLE,
        Known::BetweenWalls => &BETWEEN_WALLS,
        Known::Summed => &SUMMED,
    };
    let known = rows.iter().map(|row| (row.radius, if is_loose { row.loose } else { row.strict })).filter(|&(_, most)| most > 0.0);
    // A row stands for its radius and all above, and its distance and all below.
    let in_row = |(row_radius, most): (f64, f64)| (distance.min(most), radius.max(row_radius));
    let relief = |&(near_distance, near_radius): &(f64, f64)| {
        let of_radius = if radius.is_finite() { near_radius - radius } else { 0.0 };
        distance - near_distance + of_radius
    };
    let nearest = known.map(in_row).min_by(|a, b| relief(a).total_cmp(&relief(b)))?;
    (relief(&nearest) > 0.0).then_some(nearest)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn nearest(distance: f64, radius: Option<f64>, tolerance: Option<f64>) -> Option<(f64, f64)> {
        nearest_known(Some(distance), radius, tolerance, Known::OnTorus)
    }

    #[test]
    fn what_is_known_needs_no_relief_and_what_is_not_the_least() {
        assert_eq!(nearest(0.85, Some(0.67), Some(0.0386)), None);
        assert_eq!(nearest(0.92, Some(0.63), Some(0.05)), None);
        assert_eq!(nearest(0.92, Some(0.62), Some(0.1)), None);
        assert_eq!(nearest(0.92, Some(0.62), Some(0.0386)), Some((0.91, 0.62)));
        assert_eq!(nearest(0.80, Some(0.60), Some(0.0386)), Some((0.80, 0.62)));
        assert_eq!(nearest(0.95, Some(0.66), None), Some((0.94, 0.66)));
        assert_eq!(nearest(0.97, None, Some(0.0386)), Some((0.94, f64::INFINITY)));
    }
}
