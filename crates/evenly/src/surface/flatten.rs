//! Triangles without area whose corners are apart: the middle one lies on the longest side.

use glam::DVec3;

use crate::triangulation::{BOUNDARY, HalfEdges, Patch, next, prev};

/// A triangle lower than this part of its longest side has no area.
const FLAT: f64 = 1e-12;
/// Each round flips what it can; chains of flat triangles take several.
const ROUNDS: usize = 8;

/// Flips the longest sides of flat triangles, which lie on the corner across from it, and takes away those whose longest side is on a boundary. Returns how many.
pub(super) fn mend_flat(half_edges: &mut HalfEdges, faces: &mut Vec<usize>, points: &[DVec3]) -> usize {
    let height = |corners: [u32; 3]| {
        let [a, b, c] = corners.map(|v| points[v as usize]);
        let longest = (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
        (b - a).cross(c - a).length() / longest
    };
    let is_flat = |corners: [u32; 3]| {
        let height = height(corners);
        height <= FLAT || height.is_nan()
    };
    let longest_side = |half_edges: &HalfEdges, t: usize| {
        let length = |h: u32| points[half_edges.origin[h as usize] as usize].distance_squared(points[half_edges.target(h) as usize]);
        (3 * t as u32..3 * t as u32 + 3).max_by(|&a, &b| length(a).total_cmp(&length(b)))
    };
    let mut n_mended = 0;
    for _ in 0..ROUNDS {
        let flat: Vec<usize> = (0..half_edges.n_triangles()).filter(|&t| is_flat(half_edges.triangle(t))).collect();
        if flat.is_empty() {
            break;
        }
        let mut is_dropped = vec![false; half_edges.n_triangles()];
        let mut n_changed = 0;
        for t in flat {
            let Some(h) = longest_side(half_edges, t).filter(|_| is_flat(half_edges.triangle(t))) else { continue };
            let twin = half_edges.twin[h as usize];
            if twin == BOUNDARY {
                is_dropped[t] = true;
                n_changed += 1;
                continue;
            }
            if is_dropped[twin as usize / 3] {
                continue;
            }
            let [p, q, r, s] = [h, next(h), prev(h), prev(twin)].map(|h| half_edges.origin[h as usize]);
            // Either may be flat still, but not both as much as before; and no edge may come to be twice.
            let is_better = height([s, q, r]).min(height([r, p, s])) > height([p, q, r]);
            let is_new = !half_edges.around(prev(h)).any(|h| half_edges.target(h) == s || half_edges.origin[prev(h) as usize] == s);
            if is_better && is_new && Patch::whole(half_edges).flip(h) {
                n_changed += 1;
            }
        }
        n_mended += n_changed;
        if is_dropped.contains(&true) {
            *half_edges = without(half_edges, &is_dropped);
            let mut kept = is_dropped.iter();
            faces.retain(|_| kept.next() == Some(&false));
        }
        if n_changed == 0 {
            break;
        }
    }
    n_mended
}

/// The other triangles, in order.
fn without(half_edges: &HalfEdges, is_dropped: &[bool]) -> HalfEdges {
    let mut number = vec![BOUNDARY; is_dropped.len()];
    let kept: Vec<usize> = (0..is_dropped.len()).filter(|&t| !is_dropped[t]).collect();
    for (new, &t) in (0..).zip(&kept) {
        number[t] = new;
    }
    let all = || kept.iter().flat_map(|&t| 3 * t..3 * t + 3);
    let twin = |h: usize| {
        let twin = half_edges.twin[h];
        let across = if twin == BOUNDARY { BOUNDARY } else { number[twin as usize / 3] };
        if across == BOUNDARY { BOUNDARY } else { 3 * across + twin % 3 }
    };
    HalfEdges { origin: all().map(|h| half_edges.origin[h]).collect(), twin: all().map(twin).collect() }
}
