//! Cracks at T-vertices: where a vertex of the boundary lies on a boundary edge, that edge's triangle is divided.

use std::collections::{HashMap, HashSet};

use glam::DVec3;

use super::clean::Clean;

/// How far a vertex may lie from an edge, in lengths of the surface, which is about 1.
const NEAR: f64 = 1e-9;

/// Divides triangles at the vertices on their open edges, until there are none. How many vertices were met.
pub(super) fn stitch(clean: &mut Clean, points: &[DVec3]) -> usize {
    let mut n_stitched = 0;
    loop {
        let open = open_edges(&clean.triangles);
        let on_boundary: HashSet<u32> = open.iter().flat_map(|&(t, k)| [corner(clean, t, k), corner(clean, t, k + 1)]).collect();
        let mut by_x: Vec<u32> = on_boundary.into_iter().collect();
        by_x.sort_by(|&a, &b| points[a as usize].x.total_cmp(&points[b as usize].x).then(a.cmp(&b)));
        // One edge of a triangle at a time: the others are met in the next round.
        let mut is_divided = vec![false; clean.triangles.len()];
        for (t, k) in open {
            if is_divided[t] {
                continue;
            }
            let [a, b, c] = [0, 1, 2].map(|j| corner(clean, t, k + j));
            let between = vertices_on(points, &by_x, [a, b]);
            let between: Vec<u32> = between.into_iter().filter(|&v| v != c).collect();
            if between.is_empty() {
                continue;
            }
            is_divided[t] = true;
            n_stitched += between.len();
            let mut from = a;
            for &v in &between {
                clean.triangles.push([from, v, c]);
                clean.faces.push(clean.faces[t]);
                from = v;
            }
            clean.triangles[t] = [from, b, c];
        }
        if !is_divided.contains(&true) {
            return n_stitched;
        }
    }
}

fn corner(clean: &Clean, t: usize, k: usize) -> u32 {
    clean.triangles[t][k % 3]
}

/// The edges that one triangle has alone, as its number and that of the first corner.
fn open_edges(triangles: &[[u32; 3]]) -> Vec<(usize, usize)> {
    let ends = |t: usize, k: usize| {
        let [a, b] = [triangles[t][k], triangles[t][(k + 1) % 3]];
        [a.min(b), a.max(b)]
    };
    let all = || (0..triangles.len()).flat_map(|t| (0..3).map(move |k| (t, k)));
    let mut n_of: HashMap<[u32; 2], usize> = HashMap::with_capacity(2 * triangles.len());
    all().for_each(|(t, k)| *n_of.entry(ends(t, k)).or_default() += 1);
    all().filter(|&(t, k)| n_of[&ends(t, k)] == 1).collect()
}

/// The vertices on an edge, between its ends, in order along it.
fn vertices_on(points: &[DVec3], by_x: &[u32], [a, b]: [u32; 2]) -> Vec<u32> {
    let [p, q] = [points[a as usize], points[b as usize]];
    let (low, high) = (p.x.min(q.x) - NEAR, p.x.max(q.x) + NEAR);
    let first = by_x.partition_point(|&v| points[v as usize].x < low);
    let near = by_x[first..].iter().copied().take_while(|&v| points[v as usize].x <= high);
    let length_squared = p.distance_squared(q);
    let share = |v: u32| (points[v as usize] - p).dot(q - p) / length_squared;
    let is_on = |&v: &u32| {
        let s = share(v);
        let place = points[v as usize];
        v != a
            && v != b
            && place.distance(p + s * (q - p)) <= NEAR
            && place.distance(p) > NEAR
            && place.distance(q) > NEAR
            && s > 0.0
            && s < 1.0
    };
    let mut on: Vec<u32> = near.filter(is_on).collect();
    on.sort_by(|&v, &w| share(v).total_cmp(&share(w)));
    on
}
