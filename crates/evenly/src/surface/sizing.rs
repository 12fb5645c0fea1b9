//! How long edges are to be where: by curvature, by the local feature size, along an axis, or as the input says.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use serde::Serialize;

use super::Surface;
use super::feature_size::feature_sizes;
use super::features::Features;
use crate::error::Error;
use crate::geometry::spacing::hexagonal_count;
use crate::triangulation::prev;

/// By what the wanted lengths of edges vary over a surface.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SurfaceSizing {
    /// By the inverse of the largest curvature; or, with an error in input units, such that triangles are about so far from the surface at most.
    Curvature {
        /// How far triangles may be from the surface.
        error: Option<f64>,
    },
    /// In proportion to the local feature size: the distance to the surface's medial axis (Amenta and Bern 1999), found by shrinking balls.
    FeatureSize,
    /// From 1 at the low end of an axis (0, 1, 2) to a ratio at its high end.
    Linear {
        /// Which coordinate.
        axis: usize,
        /// The last length over the first.
        ratio: f64,
    },
    /// As an attribute of the given mesh says, in proportion.
    Attribute(String),
    /// As these numbers say, one for each vertex of the given mesh, in proportion.
    Given(#[serde(skip)] Vec<f64>),
}

/// Lengths by curvature and feature size differ from the middle one by these factors at most.
const RANGE: [f64; 2] = [0.3, 1.25];
/// By an error they are at least, and at most, such a part of the diagonal.
const ERROR_RANGE: [f64; 2] = [1e-4, 0.25];
/// Lengths grow by at most so much a length.
const GRADATION: f64 = 0.15;
/// Curvatures are averaged with those of neighbours so often.
const SMOOTHINGS: usize = 2;

/// The wanted lengths of edges at a surface's vertices, in input units, such that about so many vertices have room; without a number as they come, which only an error of curvature has.
///
/// # Errors
/// [`Error::InvalidParameter`] for a number outside its range, an attribute that is not there, lengths that are not positive or too many or few, and where it takes a number of points.
pub fn surface_sizes(surface: &Surface, sizing: &SurfaceSizing, n_points: Option<usize>) -> Result<Vec<f64>, Error> {
    let invalid = |name, value: String, expected| Err(Error::InvalidParameter { name, value, expected });
    let mut sizes = match sizing {
        SurfaceSizing::Curvature { error } => {
            if let Some(error) = error.filter(|&error| !(error > 0.0 && error.is_finite())) {
                return invalid("error", error.to_string(), "positive and finite");
            }
            if error.is_none() && n_points.is_none() {
                return invalid("n_points", "not given".into(), "given, or an error for the curvature");
            }
            let (curvatures, diagonal) = (curvatures(surface), surface.frame.length_inward(surface.diagonal()));
            match error {
                // A triangle's middle is about h^2 k / 6 below the surface.
                Some(error) => {
                    let wanted = |curvature: f64| (6.0 * surface.frame.length_inward(*error) / curvature).sqrt();
                    let [low, high] = ERROR_RANGE.map(|part| part * diagonal);
                    curvatures.into_iter().map(|curvature| wanted(curvature).clamp(low, high)).collect()
                }
                // What is flat has no say in what the middle is.
                None => limited(curvatures.into_iter().map(f64::recip).collect(), diagonal),
            }
        }
        _ if n_points.is_none() => return invalid("n_points", "not given".into(), "given, but for an error of the curvature"),
        SurfaceSizing::FeatureSize => limited(feature_sizes(surface), f64::INFINITY),
        &SurfaceSizing::Linear { axis, ratio } => {
            if axis > 2 || !(ratio > 0.0 && ratio.is_finite()) {
                return invalid("linear", format!("{axis},{ratio}"), "an axis from 0 to 2, and a ratio that is positive and finite");
            }
            let along = |v: usize| surface.points[v][axis];
            let all = || (0..surface.n_vertices()).map(along);
            let (low, high) = (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max));
            let length = (high - low).max(f64::MIN_POSITIVE);
            all().map(|x| 1.0 + (ratio - 1.0) * (x - low) / length).collect()
        }
        SurfaceSizing::Attribute(name) => {
            let Some(attribute) = surface.attributes().iter().find(|attribute| attribute.name == *name) else {
                let names: Vec<&str> = surface.attributes().iter().map(|attribute| attribute.name.as_str()).collect();
                let there = if names.is_empty() { "there are none".to_owned() } else { format!("there are {}", names.join(", ")) };
                return invalid("attr", format!("{name:?}, where {there}"), "an attribute of the mesh");
            };
            surface.of_given(&attribute.values)
        }
        SurfaceSizing::Given(numbers) => {
            if numbers.len() != surface.n_given {
                let value = format!("{} numbers for {} vertices", numbers.len(), surface.n_given);
                return invalid("density", value, "a number for each vertex of the mesh");
            }
            surface.of_given(numbers)
        }
    };
    if let Some(size) = sizes.iter().find(|&&size| !(size > 0.0 && size.is_finite())) {
        return invalid("density", size.to_string(), "positive and finite at each vertex, a wanted length");
    }
    // Twice: the spacing depends on the sizes, and how fast they may grow on the spacing.
    for _ in 0..2 {
        if let Some(n) = n_points {
            let scale = (hexagonal_count(weighted_area(surface, &sizes), 1.0) / n as f64).sqrt();
            sizes.iter_mut().for_each(|size| *size *= scale);
        }
        if !matches!(sizing, SurfaceSizing::Linear { .. }) {
            grade(surface, &mut sizes);
        }
    }
    sizes.iter_mut().for_each(|size| *size = surface.frame.length_outward(*size));
    Ok(sizes)
}

/// About how many vertices have room on a surface whose edges are to be so long, in input units, at its vertices.
pub fn expected_vertices(surface: &Surface, sizes: &[f64]) -> f64 {
    let unit = surface.frame.length_outward(1.0);
    hexagonal_count(weighted_area(surface, sizes) * unit * unit, 1.0)
}

/// The area inside, each triangle's in squares of the mean size at its corners.
pub(crate) fn weighted_area(surface: &Surface, sizes: &[f64]) -> f64 {
    let of_triangle = |t: usize| {
        let [a, b, c] = surface.corners(t);
        let scale = surface.half_edges.triangle(t).iter().map(|&v| 1.0 / sizes[v as usize]).sum::<f64>() / 3.0;
        0.5 * (b - a).cross(c - a).length() * scale * scale
    };
    (0..surface.n_triangles()).map(of_triangle).sum()
}

/// Sizes within a range around the middle one of those below `most`.
fn limited(sizes: Vec<f64>, most: f64) -> Vec<f64> {
    let mut counting: Vec<f64> = sizes.iter().copied().filter(|&size| size > 0.0 && size < most).collect();
    if counting.is_empty() {
        return vec![1.0; sizes.len()];
    }
    let middle = counting.len() / 2;
    let median = *counting.select_nth_unstable_by(middle, f64::total_cmp).1;
    let [low, high] = RANGE.map(|factor| factor * median);
    sizes.into_iter().map(|size| if size.is_nan() { high } else { size.clamp(low, high) }).collect()
}

/// The largest curvature at each vertex, by how the normals turn along the edges that end there; averaged with its neighbours.
fn curvatures(surface: &Surface) -> Vec<f64> {
    let normals = Features::boundaries(surface).vertex_normals(surface);
    let mesh = &surface.half_edges;
    let mut curvature = vec![0f64; surface.n_vertices()];
    for h in 0..mesh.origin.len() as u32 {
        let ends = [mesh.origin[h as usize] as usize, mesh.target(h) as usize];
        let [a, b] = ends.map(|v| surface.points[v]);
        let along = ((normals[ends[1]] - normals[ends[0]]).dot(b - a) / (b - a).length_squared()).abs();
        ends.into_iter().for_each(|v| curvature[v] = curvature[v].max(along));
    }
    for _ in 0..SMOOTHINGS {
        let (mut sum, mut n) = (curvature.clone(), vec![1.0; curvature.len()]);
        for h in 0..mesh.origin.len() {
            let [a, b] = [mesh.origin[h] as usize, mesh.origin[prev(h as u32) as usize] as usize];
            sum[a] += curvature[b];
            n[a] += 1.0;
        }
        curvature = sum.into_iter().zip(n).map(|(sum, n)| sum / n).collect();
    }
    curvature
}

/// Makes sizes smaller where they would grow too fast along edges.
fn grade(surface: &Surface, sizes: &mut [f64]) {
    let mesh = &surface.half_edges;
    let outgoing = mesh.outgoing(surface.n_vertices());
    // The smallest first: positive numbers are in the order of their bits.
    let waiting = |size: f64, v: u32| Reverse((size.to_bits(), v));
    let mut queue: BinaryHeap<_> = (0..).zip(&*sizes).map(|(v, &size)| waiting(size, v)).collect();
    while let Some(Reverse((bits, v))) = queue.pop() {
        let size = f64::from_bits(bits);
        if size > sizes[v as usize] || outgoing[v as usize] == u32::MAX {
            continue;
        }
        for h in mesh.around(outgoing[v as usize]) {
            for other in [mesh.target(h), mesh.origin[prev(h) as usize]] {
                let most = size + GRADATION * surface.points[v as usize].distance(surface.points[other as usize]);
                if sizes[other as usize] > most {
                    sizes[other as usize] = most;
                    queue.push(waiting(most, other));
                }
            }
        }
    }
}
