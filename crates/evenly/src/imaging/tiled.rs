//! A point set laid over pixels, as often as it takes.

use crate::error::Error;
use crate::points::PointSet;

/// The places of samples, in pixels from the lower left corner, in [0, width) x [0, height) and a margin around: a torus is repeated, a rectangle cut.
///
/// # Errors
/// [`Error::Degenerate`] for no points, and a rectangle that holds fewer pixels than asked for.
pub(super) fn tiled(points: &PointSet, spacing: f64, size: [f64; 2], margin: f64) -> Result<Vec<[f64; 2]>, Error> {
    if points.n_points() == 0 {
        return Err(Error::Degenerate("there are no points to sample with".into()));
    }
    if points.space().region().is_some() {
        return Err(Error::Degenerate("points of a polygon sample no picture; take those of a torus or a rectangle".into()));
    }
    let (domain, positions) = points.normalized();
    let scale = spacing / (domain.area() / positions.len() as f64).sqrt();
    let period = (domain.size * scale).to_array();
    // Rounding may make a set of a whole number of pixels a hair smaller.
    if !domain.is_periodic && (0..2).any(|axis| period[axis] * (1.0 + 1e-9) < size[axis]) {
        let [width, height] = period.map(|side| side.floor());
        return Err(Error::Degenerate(format!(
            "the rectangle's points sample {width} x {height} pixels; {} x {} are too many",
            size[0], size[1]
        )));
    }
    let tiles = |axis: usize| match domain.is_periodic {
        true => (-margin / period[axis]).floor() as i64..=((size[axis] + margin) / period[axis]).floor() as i64,
        false => 0..=0,
    };
    let mut places = Vec::new();
    for row in tiles(1) {
        for column in tiles(0) {
            let corner = [column as f64 * period[0], row as f64 * period[1]];
            let place = positions.iter().map(|p| [corner[0] + p.x * scale, corner[1] + p.y * scale]);
            places.extend(place.filter(|p| (0..2).all(|axis| p[axis] >= -margin && p[axis] < size[axis] + margin)));
        }
    }
    Ok(places)
}
