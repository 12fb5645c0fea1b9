//! From triangles to a manifold: who stands across which edge, with an orientation, and every vertex in the middle of one fan.

use glam::DVec3;

use super::clean::Clean;
use crate::error::Error;
use crate::triangulation::{BOUNDARY, HalfEdges, next, prev};

/// So many faults are named in a message.
const NAMED: usize = 5;

/// Finds the twins of all half-edges, and says what was done for that.
///
/// With `is_repaired`, triangles are turned where neighbours run the other way, sheets that touch along an edge are separated, and what cannot be told apart is
/// cut open there.
///
/// # Errors
/// [`Error::InvalidMesh`] where an edge has more than two triangles, or two that do not agree on which side is outside, and that is not to be repaired.
pub(super) fn manifold(clean: &Clean, points: &[DVec3], is_repaired: bool) -> Result<(HalfEdges, Vec<String>), Error> {
    let mut triangles = clean.triangles.clone();
    let edges = edges(&triangles);
    let mut notes = Vec::new();
    let name = |half_edges: &[u32]| {
        let mut ends =
            [half_edges[0], next(half_edges[0])].map(|h| clean.sources[clean.triangles[h as usize / 3][h as usize % 3] as usize]);
        ends.sort_unstable();
        let faces: Vec<usize> = half_edges.iter().map(|&h| clean.faces[h as usize / 3]).collect();
        format!("edge {}-{} (triangles {faces:?})", ends[0], ends[1])
    };
    let named = |faults: &[&[u32]]| {
        let more = if faults.len() > NAMED { format!(" and {} more", faults.len() - NAMED) } else { String::new() };
        faults.iter().take(NAMED).map(|edge| name(edge)).collect::<Vec<_>>().join(", ") + &more
    };

    // Neighbours that run the other way.
    let origin = |triangles: &[[u32; 3]], h: u32| triangles[h as usize / 3][h as usize % 3];
    let pairs: Vec<&[u32]> = edges.iter().map(Vec::as_slice).filter(|edge| edge.len() == 2).collect();
    let disagreeing = |triangles: &[[u32; 3]]| -> Vec<&[u32]> {
        pairs.iter().copied().filter(|edge| origin(triangles, edge[0]) == origin(triangles, edge[1])).collect()
    };
    let faults = disagreeing(&triangles);
    if !faults.is_empty() {
        if !is_repaired {
            let text = named(&faults);
            return Err(Error::InvalidMesh(format!(
                "neighbouring triangles do not agree on which side is outside, at {text}; repair turns them"
            )));
        }
        let volume = |t: usize| {
            let [a, b, c] = triangles[t].map(|v| points[v as usize]);
            a.dot(b.cross(c))
        };
        let turned = orientation(triangles.len(), &pairs, |a, b| origin(&triangles, a) != origin(&triangles, b), volume);
        let n_turned = turned.iter().filter(|&&is| is).count();
        // A turned triangle keeps its half-edges' numbers only if its edges keep their places: (a b c) becomes (b a c), and its edges are sorted again.
        for (triangle, _) in triangles.iter_mut().zip(&turned).filter(|(_, is)| **is) {
            triangle.swap(0, 1);
        }
        notes.push(format!("{n_turned} triangles were turned over, as their neighbours run the other way"));
    }
    let edges = self::edges(&triangles);

    // Twins, where there are two.
    let mut half_edges = HalfEdges { origin: triangles.iter().flatten().copied().collect(), twin: vec![BOUNDARY; 3 * triangles.len()] };
    let (mut crowded, mut n_cut) = (Vec::new(), 0);
    for edge in &edges {
        match edge[..] {
            [_] => {}
            [a, b] if origin(&triangles, a) != origin(&triangles, b) => join(&mut half_edges, a, b),
            [_, _] => n_cut += 1,
            _ => crowded.push(&edge[..]),
        }
    }
    if n_cut > 0 {
        notes.push(format!("the surface has one side only, and was cut open along {n_cut} edges"));
    }
    if !crowded.is_empty() {
        if !is_repaired {
            let text = named(&crowded);
            return Err(Error::InvalidMesh(format!("more than two triangles meet at {text}; repair separates sheets that touch")));
        }
        let n_separated = crowded.iter().filter(|edge| separate(&mut half_edges, edge, points)).count();
        let n_open = crowded.len() - n_separated;
        if n_separated > 0 {
            notes.push(format!("{n_separated} edges at which sheets touch were separated"));
        }
        if n_open > 0 {
            notes.push(format!("{n_open} edges with more than two triangles were cut open"));
        }
    }

    Ok((half_edges, notes))
}

/// The half-edges of each edge, in order of their numbers.
fn edges(triangles: &[[u32; 3]]) -> Vec<Vec<u32>> {
    let mut all: Vec<([u32; 2], u32)> = (0..3 * triangles.len() as u32)
        .map(|h| {
            let [a, b] = [h, next(h)].map(|h| triangles[h as usize / 3][h as usize % 3]);
            ([a.min(b), a.max(b)], h)
        })
        .collect();
    all.sort_unstable();
    all.chunk_by(|a, b| a.0 == b.0).map(|edge| edge.iter().map(|&(_, h)| h).collect()).collect()
}

fn join(half_edges: &mut HalfEdges, a: u32, b: u32) {
    half_edges.twin[a as usize] = b;
    half_edges.twin[b as usize] = a;
}

/// Which triangles are to be turned so that neighbours agree as far as that goes: of each component the smaller part, or of a closed one that
/// which leaves a positive volume.
fn orientation(n_triangles: usize, pairs: &[&[u32]], agrees: impl Fn(u32, u32) -> bool, volume: impl Fn(usize) -> f64) -> Vec<bool> {
    let mut neighbours = vec![Vec::new(); n_triangles];
    for edge in pairs {
        let is_same = agrees(edge[0], edge[1]);
        neighbours[edge[0] as usize / 3].push((edge[1] as usize / 3, is_same));
        neighbours[edge[1] as usize / 3].push((edge[0] as usize / 3, is_same));
    }
    let mut turned: Vec<Option<bool>> = vec![None; n_triangles];
    for seed in 0..n_triangles {
        if turned[seed].is_some() {
            continue;
        }
        turned[seed] = Some(false);
        let mut component = vec![seed];
        let mut k = 0;
        while k < component.len() {
            let own = turned[component[k]] == Some(true);
            for &(other, is_same) in &neighbours[component[k]] {
                if turned[other].is_none() {
                    turned[other] = Some(own == is_same);
                    component.push(other);
                }
            }
            k += 1;
        }
        let n_turned = component.iter().filter(|&&t| turned[t] == Some(true)).count();
        let is_closed = component.iter().all(|&t| neighbours[t].len() == 3);
        let is_inside_out = if is_closed && n_turned > 0 {
            component.iter().map(|&t| if turned[t] == Some(true) { -volume(t) } else { volume(t) }).sum::<f64>() < 0.0
        } else {
            2 * n_turned > component.len()
        };
        if is_inside_out {
            component.iter().for_each(|&t| turned[t] = turned[t].map(|is| !is));
        }
    }
    turned.into_iter().map(|is| is == Some(true)).collect()
}

/// Pairs the triangles at an edge so that each two enclose what lies behind them both: solids that touch at the edge come apart. False, and they are left open,
/// where as many run one way as the other is not so.
fn separate(half_edges: &mut HalfEdges, edge: &[u32], points: &[DVec3]) -> bool {
    let place = |h: u32| points[half_edges.origin[h as usize] as usize];
    let (first, from) = (edge[0], half_edges.origin[edge[0] as usize]);
    let axis = (place(next(first)) - place(first)).normalize_or_zero();
    let side = |h: u32| {
        let way = place(prev(h)) - place(first);
        way - axis * way.dot(axis)
    };
    let (x, y) = (side(first), axis.cross(side(first)));
    let mut around: Vec<(f64, u32)> = edge.iter().map(|&h| (libm::atan2(side(h).dot(y), side(h).dot(x)), h)).collect();
    around.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let is_forward = |h: u32| half_edges.origin[h as usize] == from;
    // A triangle that runs along the axis has its outside where angles are larger, and its inside where they are less: there its partner is, as brackets close what others
    // have opened.
    let (mut open, mut partners) = (Vec::new(), Vec::new());
    for &(_, h) in around.iter().chain(&around) {
        if partners.iter().any(|&(a, b)| a == h || b == h) {
            continue;
        }
        if !is_forward(h) {
            if !open.contains(&h) {
                open.push(h);
            }
        } else if let Some(partner) = open.pop() {
            partners.push((h, partner));
        }
    }
    if 2 * partners.len() != around.len() {
        return false;
    }
    partners.into_iter().for_each(|(a, b)| join(half_edges, a, b));
    true
}

/// Gives each fan of triangles a vertex of its own. Returns of each vertex what it was.
pub(super) fn split_fans(half_edges: &mut HalfEdges, n_vertices: usize) -> Vec<u32> {
    let mut vertices: Vec<u32> = (0..n_vertices as u32).collect();
    let (mut is_done, mut is_used) = (vec![false; half_edges.origin.len()], vec![false; n_vertices]);
    for h in 0..half_edges.origin.len() as u32 {
        if is_done[h as usize] {
            continue;
        }
        let v = half_edges.origin[h as usize];
        let fan: Vec<u32> = half_edges.around(h).collect();
        let own = if is_used[v as usize] {
            vertices.push(v);
            vertices.len() as u32 - 1
        } else {
            v
        };
        is_used[v as usize] = true;
        for h in fan {
            half_edges.origin[h as usize] = own;
            is_done[h as usize] = true;
        }
    }
    vertices
}
