//! Which lengths of a mesh are not what was asked for, and where the worst of them is.

use std::fmt;

use glam::DVec3;
use serde::Serialize;

use super::Surface;
use super::quality::{SIZE, edges};
use crate::geometry::triangle::Shape;

/// How many lengths of a mesh miss a target, and the worst of them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MissedLengths {
    /// Which lengths.
    pub what: &'static str,
    /// The least or the most that was asked for, in wanted lengths of edges.
    pub wanted: f64,
    /// How many miss it.
    pub n: usize,
    /// The worst, in the same unit.
    pub worst: f64,
    /// Its middle, in input units.
    pub at: [f64; 3],
}

impl fmt::Display for MissedLengths {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { what, wanted, n, worst, at: [x, y, z] } = self;
        write!(f, "{n} {what} {wanted} of the wanted length, the worst with {worst:.3} at ({x}, {y}, {z})")
    }
}

/// Lengths that are off by this part hold.
const ROUNDING: f64 = 1e-6;

/// The edges shorter, and the circumradii larger, than was asked for, in the lengths of edges that the mesh's attribute
/// `edge_length` wants at their corners, as those of [`remesh`](crate::remesh) have it; none without that attribute.
pub fn missed_lengths(surface: &Surface, min_distance: Option<f64>, coverage_radius: Option<f64>) -> Vec<MissedLengths> {
    let Some(attribute) = surface.attributes().iter().find(|attribute| attribute.name == SIZE) else { return Vec::new() };
    let sizes = surface.of_given(&attribute.values);
    let outward = |length: f64| surface.frame.length_outward(length);
    let short = min_distance.and_then(|wanted| {
        let all = edges(surface).map(|ends| {
            let [a, b] = ends.map(|v| surface.points[v]);
            (2.0 * outward(a.distance(b)) / (sizes[ends[0]] + sizes[ends[1]]), 0.5 * (a + b))
        });
        let misses = |share: f64| share < wanted * (1.0 - ROUNDING);
        told(surface, "edges are shorter than", wanted, all.filter(|&(share, _)| misses(share)))
    });
    let large = coverage_radius.and_then(|wanted| {
        let all = (0..surface.n_triangles()).map(|t| {
            let corners = surface.corners(t);
            let wanted: f64 = surface.half_edges.triangle(t).iter().map(|&v| sizes[v as usize]).sum();
            (3.0 * outward(Shape::of_space(corners).circumradius()) / wanted, (corners[0] + corners[1] + corners[2]) / 3.0)
        });
        let misses = |share: f64| share > wanted * (1.0 + ROUNDING);
        told(surface, "circumradii are larger than", wanted, all.filter(|&(share, _)| misses(share)))
    });
    short.into_iter().chain(large).collect()
}

/// What there is to say of those that miss a target, each with its place.
fn told(surface: &Surface, what: &'static str, wanted: f64, missing: impl Iterator<Item = (f64, DVec3)>) -> Option<MissedLengths> {
    let (mut n, mut worst) = (0, (wanted, DVec3::ZERO));
    for (share, at) in missing {
        n += 1;
        if (share - wanted).abs() > (worst.0 - wanted).abs() {
            worst = (share, at);
        }
    }
    (n > 0).then(|| MissedLengths { what, wanted, n, worst: worst.0, at: surface.frame.outward(worst.1) })
}
