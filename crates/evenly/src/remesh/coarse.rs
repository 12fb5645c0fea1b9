//! Whether a surface gets enough vertices: how much of its area and volume so coarse a mesh loses.

use glam::DVec3;

use super::live::Start;
use crate::surface::Surface;

/// A loss of more than this share is told, and how many vertices would lose this other one.
const MUCH: f64 = 0.05;
const LITTLE: f64 = 0.01;

/// A volume below this part of that of a cube with as much area cannot be compared: as of two sheets.
const THIN: f64 = 1e-3;

/// What there is to say of a start with too few vertices.
pub(super) fn warning(surface: &Surface, start: &Start, n_points: usize) -> Option<String> {
    let whole = |t: usize| surface.corners(t);
    let of_start = |t: usize| start.half_edges.triangle(t).map(|v| start.vertices[v as usize].at);
    let (area, volume) = measured((0..surface.n_triangles()).map(whole));
    let (start_area, start_volume) = measured((0..start.half_edges.n_triangles()).map(of_start));
    let of_area = (area - start_area) / area;
    // Twice the area, and six times the volume, which of a cube are 12 and 6.
    let has_volume = surface.is_closed() && volume.abs() > THIN * 6.0 * libm::pow(area / 12.0, 1.5);
    let of_volume = if has_volume { (volume - start_volume) / volume } else { 0.0 };
    let loss = of_area.abs().max(of_volume.abs());
    if !(loss > MUCH && loss.is_finite()) {
        return None;
    }
    // What chords lose falls with the square of their length.
    let needed = n_points as f64 * loss / LITTLE;
    let digits = libm::pow(10.0, libm::log10(needed).floor() - 1.0);
    let percent = |share: f64| format!("{:.0} % {}", 100.0 * share.abs(), if share < 0.0 { "more" } else { "less" });
    let both = match has_volume {
        true => format!("{} area and {} volume", percent(of_area), percent(of_volume)),
        false => format!("{} area", percent(of_area)),
    };
    Some(format!(
        "{n_points} vertices are few for this surface: a mesh of them has {both}; with about {:.0} it would be 1 %",
        (needed / digits).ceil() * digits
    ))
}

/// Twice the area, and six times the volume.
fn measured(triangles: impl Iterator<Item = [DVec3; 3]>) -> (f64, f64) {
    triangles.fold((0.0, 0.0), |(area, volume), [a, b, c]| (area + (b - a).cross(c - a).length(), volume + a.dot(b.cross(c))))
}
