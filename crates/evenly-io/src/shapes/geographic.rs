//! What is to be said of longitudes and latitudes: they are no lengths.

use evenly::Polygon;

/// Coordinates within so many degrees of 0 may be anything.
const ANYTHING: f64 = 1.0;
/// A polygon with places this near to both ends lies across the antimeridian.
const END: f64 = 179.9;

/// The polygon, with what is to be said of it.
pub(super) fn noted(polygon: Polygon) -> Polygon {
    let [low, high] = [f64::min as fn(f64, f64) -> f64, f64::max].map(|pick| {
        let corners = polygon.rings().iter().flatten();
        corners.copied().reduce(|p, q| [pick(p[0], q[0]), pick(p[1], q[1])]).unwrap_or_default()
    });
    let farthest = [low, high].as_flattened().iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let is_geographic = low[0] >= -180.0 && high[0] <= 180.0 && low[1] >= -90.0 && high[1] <= 90.0 && farthest > ANYTHING;
    if !is_geographic {
        return polygon;
    }
    let polygon =
        polygon.noted("coordinates look like longitudes and latitudes: lengths are in degrees, which differ; project them for true ones");
    if low[0] <= -END && high[0] >= END {
        return polygon
            .noted("the polygon reaches the antimeridian from both sides: its parts lie 360 degrees apart, and do not meet there");
    }
    polygon
}
