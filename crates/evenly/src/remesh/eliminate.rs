//! Exactly as many vertices as are wanted, on the surface and with its topology: long edges are split, then short ones collapsed.
//!
//! This is sample elimination by the mesh's own neighbourhoods, so it never jumps through thin parts; the lengths are a little random, so that the points are not regular.

use super::draft::Draft;
use super::queue::Queue;
use crate::triangulation::{BOUNDARY, next, prev};

/// Edges are split until none is longer than this, in the wanted spacings, and there are so many times the wanted vertices.
const LONGEST: f64 = 1.0;
const CHOICE: f64 = 3.0;
/// But never into more than so many times the wanted vertices, or edges shorter than this.
const MOST_TIMES: usize = 60;
const SHORTEST: f64 = 0.3;
/// At which part of them edges are split, at random up to as far from the other end: in the middle, the places on regular surfaces would be waves of density.
const NEAREST_SPLIT: f64 = 0.35;
/// By how much of itself a length is lengthened at random.
const RANDOM: f64 = 0.3;
/// Edges on creases count so much shorter whose ends are to be taken away.
const LOOSE: f64 = 0.5;
/// How far collapses may bend a triangle, as a cosine; the next where no more can be collapsed.
const TURNS: [f64; 5] = [0.5, 0.2, 0.0, -0.3, -0.9];

/// Splits the longest edges until there are vertices enough to choose from.
pub(super) fn subdivide(draft: &mut Draft, spacing: f64, n_wanted: usize, seed: u64) {
    let mut queue = Queue::default();
    let add = |queue: &mut Queue, draft: &Draft, h: u32| {
        let length = draft.length(h);
        if length > SHORTEST * spacing {
            queue.push(1.0 / length, [draft.mesh.origin[h as usize], draft.mesh.target(h)]);
        }
    };
    let all = (0..draft.mesh.origin.len() as u32).filter(|&h| draft.mesh.twin[h as usize] == BOUNDARY || draft.mesh.twin[h as usize] > h);
    all.for_each(|h| add(&mut queue, draft, h));
    let enough = CHOICE * n_wanted as f64;
    let most = MOST_TIMES * n_wanted.max(100) + draft.n_live;
    let (mut suspects, mut ring) = (Vec::new(), Vec::new());
    while let Some([a, b]) = queue.pop() {
        // Each edge is split once, and never comes again.
        let Some(h) = draft.find(a, b) else { continue };
        let is_short = draft.length(h) <= LONGEST * spacing;
        if is_short && draft.n_live as f64 >= enough || draft.n_live >= most {
            break;
        }
        let m = draft.split(h, NEAREST_SPLIT + (1.0 - 2.0 * NEAREST_SPLIT) * unit(seed, [a, b]));
        // On large triangles of the surface: thin ones would be split many times.
        suspects.extend(draft.mesh.around(draft.outgoing[m as usize]).map(next));
        draft.legalize_within(&mut suspects, |draft, h| add(&mut queue, draft, h));
        ring.clear();
        ring.extend(draft.mesh.around(draft.outgoing[m as usize]).flat_map(|h| [h, prev(h)]));
        ring.retain(|&h| draft.mesh.twin[h as usize] == BOUNDARY || draft.mesh.origin[h as usize] == m);
        ring.iter().for_each(|&h| add(&mut queue, draft, h));
    }
}

/// Collapses the shortest edges until exactly so many vertices are left, and none on a crease that is not pinned; the mesh is made Delaunay on the way. What is left of these where
/// nothing else helps is pinned as well.
///
/// False if that many cannot be reached.
pub(super) fn eliminate(draft: &mut Draft, n_wanted: usize, seed: u64) -> bool {
    draft.legalize(&mut (0..draft.mesh.origin.len() as u32).collect(), |_, _| {});
    for turn in TURNS {
        collapse_all(draft, n_wanted, turn, seed);
        if draft.n_loose == 0 && draft.n_live == n_wanted {
            return true;
        }
    }
    (0..draft.vertices.len() as u32).filter(|&v| draft.is_live(v)).collect::<Vec<_>>().into_iter().for_each(|v| {
        if draft.is_loose(v) {
            draft.pin(v);
        }
    });
    TURNS.iter().for_each(|&turn| collapse_all(draft, n_wanted, turn, seed));
    draft.n_live == n_wanted
}

/// Collapses what can be, while more than is wanted is left.
fn collapse_all(draft: &mut Draft, n_wanted: usize, turn: f64, seed: u64) {
    let mut queue = Queue::default();
    let add = |queue: &mut Queue, draft: &Draft, h: u32| {
        let ends = [draft.mesh.origin[h as usize], draft.mesh.target(h)];
        // On creases first, so that what is beside them is not in the way.
        let is_loose = draft.is_crease[h as usize] && ends.iter().any(|&v| draft.is_loose(v));
        let share = if is_loose { LOOSE } else { 1.0 };
        queue.push(share * draft.length(h) * (1.0 + RANDOM * unit(seed, ends)), ends);
    };
    let is_first = |draft: &Draft, h: u32| draft.mesh.twin[h as usize] == BOUNDARY || h < draft.mesh.twin[h as usize];
    let all = (0..draft.mesh.origin.len() as u32).filter(|&h| draft.mesh.origin[h as usize] != BOUNDARY && is_first(draft, h));
    all.for_each(|h| add(&mut queue, draft, h));
    let (mut suspects, mut ring) = (Vec::new(), Vec::new());
    while let Some([a, b]) = queue.pop() {
        let has_enough = draft.n_live - draft.n_loose <= n_wanted;
        if has_enough && draft.n_loose == 0 {
            return;
        }
        if !draft.is_live(a) || !draft.is_live(b) {
            continue;
        }
        let Some(h) = draft.find_edge(a, b) else { continue };
        let ends = if unit(!seed, [a, b]) < 0.5 { [a, b] } else { [b, a] };
        let Some(gone) = ends.into_iter().find(|&v| (!has_enough || draft.is_loose(v)) && draft.collapse(h, v, turn)) else { continue };
        let kept = if gone == a { b } else { a };
        suspects.clear();
        suspects.extend(draft.mesh.around(draft.outgoing[kept as usize]).flat_map(|h| [h, next(h)]));
        draft.legalize(&mut suspects, |draft, h| add(&mut queue, draft, h));
        ring.clear();
        ring.extend(draft.mesh.around(draft.outgoing[kept as usize]).flat_map(|h| [h, prev(h)]));
        ring.retain(|&h| draft.mesh.twin[h as usize] == BOUNDARY || draft.mesh.origin[h as usize] == kept);
        ring.iter().for_each(|&h| add(&mut queue, draft, h));
    }
}

/// A number in [0, 1) that belongs to an edge, whichever end comes first (Steele, Lea and Flood's SplitMix64, 2014).
fn unit(seed: u64, [a, b]: [u32; 2]) -> f64 {
    let mut z = seed ^ (u64::from(a.min(b)) << 32 | u64::from(a.max(b))).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 * (1.0 / (1u64 << 53) as f64)
}
