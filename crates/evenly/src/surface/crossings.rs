//! Where a surface runs through itself: exact tests of all triangles that may meet.

use glam::DVec3;
use rayon::prelude::*;

use super::Surface;
use super::bvh::{Bounds, Bvh};
use crate::predicates::orientation;
use crate::triangulation::BOUNDARY;

/// Corners so near to a plane, in longest sides, lie in it.
const FLAT: f64 = 1e-11;

/// The pairs of triangles that cross each other, by their numbers in the given mesh. Neighbours that only share their edge or corner do not, nor do triangles that
/// touch or lie in one plane.
pub fn self_intersections(surface: &Surface) -> Vec<[usize; 2]> {
    let n = surface.n_triangles();
    let bounds: Vec<Bounds> = (0..n).map(|t| Bounds::of(&surface.corners(t))).collect();
    let tree = Bvh::new(&bounds);
    // Triangles of one polygon lie in one plane, many thousands of them in each other's boxes.
    let patches = flat_patches(surface);
    let patch_of_nodes = tree.groups(&patches);
    let crossed_by = |t: usize| {
        let mut others = Vec::new();
        let is_own = |node: usize| patch_of_nodes[node] == Some(patches[t]);
        tree.meeting(bounds[t], is_own, |other| {
            let other = other as usize;
            if other > t && patches[other] != patches[t] && do_cross(surface, t, other) {
                others.push([t, other].map(|t| surface.faces[t]));
            }
        });
        others.sort_unstable();
        others
    };
    (0..n).into_par_iter().flat_map_iter(crossed_by).collect()
}

/// For each triangle the patch to which it belongs, by the number of one of its triangles: those of a patch
/// hang together by edges, and lie in one plane but for rounding.
fn flat_patches(surface: &Surface) -> Vec<u32> {
    let mut patches: Vec<u32> = (0..surface.n_triangles() as u32).collect();
    let root = |patches: &mut Vec<u32>, mut t: u32| {
        while patches[t as usize] != t {
            patches[t as usize] = patches[patches[t as usize] as usize];
            t = patches[t as usize];
        }
        t
    };
    for (h, &twin) in surface.half_edges.twin.iter().enumerate() {
        let is_first = twin != BOUNDARY && h < twin as usize;
        if is_first && is_flat([h / 3, twin as usize / 3].map(|t| surface.corners(t))) {
            let [a, b] = [h as u32 / 3, twin / 3].map(|t| root(&mut patches, t));
            patches[a.max(b) as usize] = a.min(b);
        }
    }
    (0..patches.len() as u32).map(|t| root(&mut patches, t)).collect()
}

/// Whether two triangles lie in one plane: that of the larger.
fn is_flat(both: [[DVec3; 3]; 2]) -> bool {
    let [one, other] = both.map(|[a, b, c]| (b - a).cross(c - a));
    let (normal, from, places) =
        if one.length_squared() > other.length_squared() { (one, both[0][0], both[1]) } else { (other, both[1][0], both[0]) };
    let sides = both.iter().flat_map(|&[a, b, c]| [a.distance(b), b.distance(c), c.distance(a)]);
    let longest = sides.fold(0.0, f64::max);
    places.iter().all(|&p| (p - from).dot(normal).abs() <= FLAT * longest * normal.length())
}

fn do_cross(surface: &Surface, a: usize, b: usize) -> bool {
    let places = [a, b].map(|t| surface.corners(t));
    // A vertex that was split is two at one place.
    let is_shared = |side: usize, k: usize| places[1 - side].contains(&places[side][k]);
    let crosses = |side: usize| {
        let sides = [[0, 1], [1, 2], [2, 0]];
        // An edge with a shared end only touches there.
        { sides }.into_iter().any(|[from, to]| {
            !is_shared(side, from) && !is_shared(side, to) && do_pierce([places[side][from], places[side][to]], places[1 - side])
        })
    };
    crosses(0) || crosses(1)
}

/// Whether a segment goes through the inside of a triangle or its edges, from one side to the other.
fn do_pierce([p, q]: [DVec3; 2], [a, b, c]: [DVec3; 3]) -> bool {
    let (above, below) = (orientation(a, b, c, p), orientation(a, b, c, q));
    if above == 0.0 || below == 0.0 || (above > 0.0) == (below > 0.0) {
        return false;
    }
    let sides = [orientation(p, q, a, b), orientation(p, q, b, c), orientation(p, q, c, a)];
    sides.iter().all(|&side| side >= 0.0) || sides.iter().all(|&side| side <= 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_segment_pierces_what_it_goes_through_and_nothing_beside() {
        let triangle = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let through = |x: f64, y: f64| do_pierce([DVec3::new(x, y, -1.0), DVec3::new(x, y, 1.0)], triangle);
        assert!(through(0.25, 0.25) && through(0.5, 0.25) && !through(0.75, 0.5) && !through(-0.1, 0.5));
        assert!(!do_pierce([DVec3::new(0.2, 0.2, 0.0), DVec3::new(0.2, 0.2, 1.0)], triangle));
    }
}
