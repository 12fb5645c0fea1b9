//! The local feature size: how far a surface is from its medial axis, found by balls that shrink until they touch.
//!
//! Ma, Bae and Choi, "3D Medial Axis Point Approximation Using Nearest Neighbors and the Normal Field", The Visual Computer 28, 2012, doi
//! 10.1007/s00371-011-0594-7. Balls whose two touching places are seen from their middle at a small angle are of noise, and stop before.

use glam::DVec3;
use rayon::prelude::*;

use super::Surface;
use super::bvh::{Bounds, Bvh};
use super::features::Features;

/// Places seen under less than this are noise.
const LEAST_COS: f64 = 0.866;
/// Steps in which a ball shrinks, at most.
const MAX_STEPS: usize = 50;

/// The local feature size at each vertex, in the units inside.
pub(super) fn feature_sizes(surface: &Surface) -> Vec<f64> {
    let points = &surface.points;
    let normals = Features::boundaries(surface).vertex_normals(surface);
    let bounds: Vec<Bounds> = points.iter().map(|&p| Bounds::of(&[p])).collect();
    let tree = Bvh::new(&bounds);
    let all = Bounds::of(points);
    let largest = (all.high - all.low).length();
    let centres: Vec<DVec3> = (0..points.len())
        .into_par_iter()
        .flat_map_iter(|v| [1.0, -1.0].map(|side| shrink(points, &tree, v, side * normals[v], largest)))
        .flatten()
        .collect();
    let bounds: Vec<Bounds> = centres.iter().map(|&p| Bounds::of(&[p])).collect();
    let axis = Bvh::new(&bounds);
    let size = |&p: &DVec3| axis.nearest(p, f64::INFINITY, |k| centres[k as usize].distance_squared(p)).map_or(largest, |(_, d)| d.sqrt());
    points.par_iter().map(size).collect()
}

/// The middle of the largest ball that touches the surface at a vertex and has no other vertex inside; `None` where it stays as large as all.
fn shrink(points: &[DVec3], tree: &Bvh, v: usize, normal: DVec3, largest: f64) -> Option<DVec3> {
    let p = points[v];
    if normal == DVec3::ZERO {
        return None;
    }
    let mut radius = largest;
    for _ in 0..MAX_STEPS {
        let centre = p - radius * normal;
        let distance = |k: u32| if k as usize == v { f64::INFINITY } else { points[k as usize].distance_squared(centre) };
        let Some((q, _)) = tree.nearest(centre, (radius * (1.0 - 1e-9)).powi(2), distance) else { break };
        let way = p - points[q as usize];
        let smaller = way.length_squared() / (2.0 * normal.dot(way));
        let next = p - smaller * normal;
        let cos = (p - next).normalize_or_zero().dot((points[q as usize] - next).normalize_or_zero());
        if !(smaller > 0.0 && smaller < radius) || cos > LEAST_COS {
            break;
        }
        radius = smaller;
    }
    (radius < largest).then_some(p - radius * normal)
}
