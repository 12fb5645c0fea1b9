//! What a polygon's details cost: how many triangles they take, and what would save half of them.

use evenly::{MeshParams, Polygon, expected_triangles};

use crate::message::Message;

/// Details are told that make triangles so many times more than the spacing alone would.
const MANY: f64 = 2.0;
const LEAST: f64 = 100.0;
/// Tolerances that are tried, as powers of 2 in spacings.
const TRIED: std::ops::RangeInclusive<i32> = -7..=1;

/// What there is to say of a mesh with so many triangles outside of sharp corners, where `wanted` would do
/// without details.
pub fn told(polygon: &Polygon, params: &MeshParams, n_triangles: usize, wanted: f64) -> Option<Message> {
    let n = n_triangles as f64;
    if n < MANY * wanted + LEAST {
        return None;
    }
    let cost = Message::from(format!("the boundary's details take {:.0} of the {n_triangles} triangles", n - wanted));
    let has_few = |polygon: &Polygon| expected_triangles(polygon, params).is_ok_and(|expected| expected <= 0.5 * n);
    if has_few(polygon) {
        // What stands alone, or what must be a vertex or an edge: that stays.
        return Some(cost);
    }
    let tolerances: Vec<f64> = TRIED.map(|k| params.edge_length * f64::from(k).exp2()).collect();
    Some(match polygon.least_simplification(&tolerances, has_few) {
        Ok(Some(tolerance)) => cost.text("; ").setting("simplify", rounded(tolerance)).text(" would save half of them or more"),
        _ => cost,
    })
}

/// A number to two digits.
fn rounded(x: f64) -> f64 {
    format!("{x:.1e}").parse().unwrap_or(x)
}
