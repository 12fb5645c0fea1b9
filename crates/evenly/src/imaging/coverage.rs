//! What dots cover of a page: the tone of a stipple drawing.

use super::image::Image;
use crate::error::Error;
use crate::points::PointSet;

/// Samples a pixel, along each axis: as many as a mask has bits.
const SAMPLES: usize = 4;

/// The share of each pixel that is covered by at least one dot. Pixels span the points' domain, the first row at its top; `radii`, in input units, are the dots'. What dots
/// cover beyond the domain is left out, also on a torus.
///
/// # Errors
/// [`Error::InvalidParameter`] if there is not one radius a point, 0 or more and finite, and for a size that no [`Image`] has.
pub fn dot_coverage(points: &PointSet, radii: &[f64], width: usize, height: usize) -> Result<Image, Error> {
    let wrong = |value: String| Error::InvalidParameter { name: "radii", value, expected: "one length a point, 0 or more, and finite" };
    if radii.len() != points.n_points() {
        return Err(wrong(format!("{} lengths", radii.len())));
    }
    if let Some(radius) = radii.iter().find(|&&radius| !(radius >= 0.0 && radius.is_finite())) {
        return Err(wrong(radius.to_string()));
    }
    let blank = Image::new(width, height, 1, vec![0.0; width.saturating_mul(height).min(Image::MOST_PIXELS + 1)])?;
    let (origin, size) = (points.space().origin(), points.space().size());
    // In samples, from the top left.
    let scale = [width, height].map(|n| (n * SAMPLES) as f64);
    let mut masks = vec![0u16; blank.values().len()];
    for (p, &radius) in points.positions().iter().zip(radii) {
        let x = (p[0] - origin[0]) / size[0] * scale[0];
        let y = (origin[1] + size[1] - p[1]) / size[1] * scale[1];
        let [rx, ry] = [0, 1].map(|axis| radius / size[axis] * scale[axis]);
        for row in within(y, ry, height * SAMPLES) {
            let rest = 1.0 - ((row as f64 + 0.5 - y) / ry).powi(2);
            for column in within(x, rx * rest.max(0.0).sqrt(), width * SAMPLES) {
                masks[column / SAMPLES + row / SAMPLES * width] |= 1 << (column % SAMPLES + row % SAMPLES * SAMPLES);
            }
        }
    }
    let all = (SAMPLES * SAMPLES) as f64;
    Image::new(width, height, 1, masks.into_iter().map(|mask| f64::from(mask.count_ones()) / all).collect())
}

/// The samples whose middles are within a reach of a place.
fn within(place: f64, reach: f64, n: usize) -> std::ops::Range<usize> {
    let first = (place - reach - 0.5).ceil().max(0.0) as usize;
    let end = ((place + reach - 0.5).floor() + 1.0).clamp(0.0, n as f64) as usize;
    first..end.max(first)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Rectangle, hexagonal};

    #[test]
    fn dots_cover_their_area_and_none_twice() {
        let space = Rectangle::new([5.0, -1.0], [2.0, 1.0]).unwrap();
        let middle = |places: Vec<[f64; 2]>| PointSet::new(space, places).unwrap();
        let covered = |points: &PointSet, radius: f64| {
            let image = dot_coverage(points, &vec![radius; points.n_points()], 400, 200).unwrap();
            image.values().iter().sum::<f64>() / 40_000.0
        };
        let one = covered(&middle(vec![[6.0, -0.5]]), 0.3);
        assert!((one - std::f64::consts::PI * 0.09).abs() < 1e-3, "{one}");
        assert_eq!(covered(&middle(vec![[6.0, -0.5]; 3]), 0.3), one);
        // A quarter of a dot in the upper left corner.
        let image = dot_coverage(&middle(vec![[5.0, 0.0]]), &[0.2], 20, 10).unwrap();
        assert!(image.values()[0] == 1.0 && image.values()[199] == 0.0);
        let many = hexagonal(space, 500).unwrap();
        // Some lie on the boundary.
        let radius = 0.3 * many.hex_spacing();
        let share = covered(&many, radius) / (500.0 * std::f64::consts::PI * radius * radius);
        assert!((0.9..=1.0).contains(&share), "{share}");
        assert!(dot_coverage(&many, &[1.0], 10, 10).is_err() && dot_coverage(&many, &vec![-1.0; 500], 10, 10).is_err());
        assert!(dot_coverage(&many, &vec![1.0; 500], 0, 10).is_err());
    }
}
