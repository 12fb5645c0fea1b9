//! Where points cannot come to rest there are too many or too few of them: some are taken away or added, far from each other, and the others find their places anew.

use std::collections::HashMap;

use glam::DVec2;

use super::aim::Aim;
use super::state::State;
use crate::space::snap;
use crate::triangulation::{BORDER, Bonds, HalfEdges, LiveMesh, Track, Triangulation, circumcentre, prev};

/// Edges of the border that are longer than this many spacings are better halved.
const LONG: f64 = 1.3;
/// And nearer to an end than by this part of them no point comes onto them.
const LEAST_SHARE: f64 = 0.2;
/// Changes keep so many spacings from each other.
const APART: f64 = 4.0;
/// No more changes at a time.
const MOST: usize = 4000;

/// What is to be changed.
#[derive(Debug, Clone, Copy)]
enum Change {
    /// This point goes.
    Remove(u32),
    /// One comes into the middle of this edge of the border or of a line, by its number there.
    Halve(usize),
    /// This point goes, and one comes beside it onto this edge.
    Land(u32, usize),
    /// One comes here, in a triangle of the sizing near this one.
    Add(DVec2, u32),
}

/// A place where something is wrong.
struct Fault {
    /// How wrong.
    badness: f64,
    at: DVec2,
    spacing: f64,
    change: Change,
}

/// Adds and removes points where triangles are not as they are to be; `None` where there is nothing to change. Edges on rails for which `may_halve` is false stay whole.
pub(super) fn repair(mesh: &LiveMesh, corners: Vec<u32>, aim: &Aim, may_halve: impl Fn(u32) -> bool) -> Option<State> {
    let (bonds, source) = mesh.bonds()?;
    let Triangulation { half_edges, positions, .. } = mesh.triangulation();
    let mut points = vec![DVec2::ZERO; bonds.tracks.len()];
    source.iter().zip(&positions).for_each(|(&point, &at)| points[point as usize] = at);
    let number: HashMap<[u32; 2], usize> = bonds.border.iter().chain(&bonds.lines).copied().zip(0..).collect();
    let size = |v: u32| mesh.local_spacing(v);

    let outgoing = half_edges.outgoing(positions.len());
    let mut faults = Vec::new();
    for t in 0..half_edges.n_triangles() {
        let badness = aim.badness(half_edges.triangle(t).map(|v| positions[v as usize]));
        if badness == 0.0 {
            continue;
        }
        let Some(shortest) = shortest(&half_edges, &positions, t) else { continue };
        let corners = half_edges.triangle(t);
        let spacing = corners.into_iter().map(size).sum::<f64>() / 3.0;
        let (a, b) = (half_edges.origin[shortest as usize], half_edges.target(shortest));
        // Are there too many points around, or too few?
        let (mut share, mut n) = (0.0, 0.0);
        for corner in corners {
            for h in half_edges.around(outgoing[corner as usize]) {
                let [a, b, c] = half_edges.triangle(h as usize / 3);
                let side = (size(a) + size(b) + size(c)) / 3.0;
                let [a, b, c] = [a, b, c].map(|v| positions[v as usize]);
                share += 2.0 * (b - a).perp_dot(c - a) / (3f64.sqrt() * side * side);
                n += 1.0;
            }
        }
        let is_crowded = share < n;
        let of = |v: u32| bonds.tracks[source[v as usize] as usize];
        let gone = match (of(a), of(b)) {
            (Track::Free, _) => Some(a),
            (_, Track::Free) => Some(b),
            (Track::Rail(_), _) => Some(a),
            (_, Track::Rail(_)) => Some(b),
            (Track::Fixed, Track::Fixed) => None,
        };
        let removal = gone.map(|v| (positions[v as usize], Change::Remove(source[v as usize])));
        let addition = || filling(&half_edges, &positions, source, &bonds, &number, t, &may_halve);
        let change = match addition() {
            // As many as before, but one on the border: that settles it whether there are too many or not.
            Some(landing @ (_, Change::Land(..))) if longest(&half_edges, &positions, t) > LONG * spacing => Some(landing),
            addition if is_crowded => removal.or(addition),
            addition => addition.or(removal),
        };
        faults.extend(change.map(|(at, change)| Fault { badness, at, spacing, change }));
    }
    let faults = apart(faults);
    if faults.is_empty() {
        return None;
    }
    Some(changed(State { points, corners, bonds }, &faults))
}

/// The half-edge of a triangle's shortest side.
fn shortest(half_edges: &HalfEdges, positions: &[DVec2], t: usize) -> Option<u32> {
    let at = |v: u32| positions[v as usize];
    let length = |h: u32| at(half_edges.origin[h as usize]).distance(at(half_edges.target(h)));
    [0, 1, 2].map(|k| 3 * t as u32 + k).into_iter().min_by(|&a, &b| length(a).total_cmp(&length(b)))
}

/// The length of a triangle's longest side.
fn longest(half_edges: &HalfEdges, positions: &[DVec2], t: usize) -> f64 {
    let [a, b, c] = half_edges.triangle(t).map(|v| positions[v as usize]);
    a.distance(b).max(b.distance(c)).max(c.distance(a))
}

/// How a triangle that is too large is filled: by halving its longest side, if that lies on the border or a line or the triangle is obtuse, or by a point in its middle.
fn filling(
    half_edges: &HalfEdges,
    positions: &[DVec2],
    source: &[u32],
    bonds: &Bonds,
    number: &HashMap<[u32; 2], usize>,
    t: usize,
    may_halve: &impl Fn(u32) -> bool,
) -> Option<(DVec2, Change)> {
    let at = |v: u32| positions[v as usize];
    let sides = [0, 1, 2].map(|k| 3 * t as u32 + k);
    let length = |h: u32| at(half_edges.origin[h as usize]).distance(at(half_edges.target(h)));
    let longest = sides.into_iter().max_by(|&a, &b| length(a).total_cmp(&length(b)))?;
    let (from, to) = (half_edges.origin[longest as usize], half_edges.target(longest));
    let apex = at(half_edges.origin[prev(longest) as usize]);
    let middle = snap(0.5 * (at(from) + at(to)));
    let ends = [source[from as usize], source[to as usize]];
    let is_obtuse = (at(from) - apex).dot(at(to) - apex) < 0.0;
    if let Some(&edge) = number.get(&ends).or_else(|| number.get(&[ends[1], ends[0]])) {
        let point = source[half_edges.origin[prev(longest) as usize] as usize];
        let way = at(to) - at(from);
        let foot = snap(at(from) + way * ((apex - at(from)).dot(way) / way.length_squared()).clamp(LEAST_SHARE, 1.0 - LEAST_SHARE));
        let change = if is_obtuse && bonds.tracks[point as usize] == Track::Free {
            (foot, Change::Land(point, edge))
        } else {
            (middle, Change::Halve(edge))
        };
        return may_halve(bonds.on_rail[edge]).then_some(change);
    }
    let hint = bonds.hints[source[from as usize] as usize];
    let [a, b, c] = half_edges.triangle(t).map(at);
    let place = if is_obtuse { middle } else { snap(a + circumcentre(b - a, c - a)) };
    Some((place, Change::Add(place, hint)))
}

/// The worst faults that are far from each other.
fn apart(mut faults: Vec<Fault>) -> Vec<Fault> {
    faults.sort_by(|a, b| b.badness.total_cmp(&a.badness));
    let mut chosen: Vec<Fault> = Vec::new();
    for fault in faults {
        if chosen.len() == MOST {
            break;
        }
        if chosen.iter().all(|other| other.at.distance(fault.at) > APART * other.spacing.max(fault.spacing)) {
            chosen.push(fault);
        }
    }
    chosen
}

/// The state with these changes.
fn changed(state: State, faults: &[Fault]) -> State {
    let State { mut points, mut corners, bonds } = state;
    let Bonds { mut tracks, rails, border, lines, on_rail, sizing, mut hints } = bonds;
    let n_border = border.len();
    let mut edges: Vec<Option<[u32; 2]>> = border.into_iter().chain(lines).map(Some).collect();
    let mut on_rail = on_rail;
    let mut is_border: Vec<bool> = (0..edges.len()).map(|k| k < n_border).collect();
    let mut is_gone = vec![false; points.len()];
    let mut is_whole = vec![true; edges.len()];
    for fault in faults {
        match fault.change {
            Change::Remove(point) => is_gone[point as usize] = true,
            Change::Halve(edge) | Change::Land(_, edge) => {
                // An edge is halved once.
                let Some([from, to]) = edges[edge].filter(|_| is_whole[edge]) else { continue };
                is_whole[edge] = false;
                if let Change::Land(point, _) = fault.change {
                    is_gone[point as usize] = true;
                }
                let middle = points.len() as u32;
                points.push(fault.at);
                tracks.push(Track::Rail(on_rail[edge]));
                hints.push(hints[from as usize]);
                edges[edge] = Some([from, middle]);
                edges.push(Some([middle, to]));
                on_rail.push(on_rail[edge]);
                is_border.push(is_border[edge]);
            }
            Change::Add(at, hint) => {
                points.push(at);
                tracks.push(Track::Free);
                hints.push(hint);
            }
        }
    }
    is_gone.resize(points.len(), false);
    corners.resize(points.len(), BORDER);
    // Where a point on a rail goes, the edges before and after it become one.
    let mut leaving = HashMap::new();
    for (k, edge) in edges.iter().enumerate() {
        if let Some([from, _]) = edge
            && is_gone[*from as usize]
        {
            leaving.insert(*from, k);
        }
    }
    for k in 0..edges.len() {
        let Some([from, mut to]) = edges[k] else { continue };
        if is_gone[from as usize] {
            continue;
        }
        while is_gone[to as usize] {
            let Some(&after) = leaving.get(&to) else { break };
            let Some([_, next]) = edges[after] else { break };
            to = next;
        }
        edges[k] = Some([from, to]);
    }
    for edge in &mut edges {
        if edge.is_some_and(|[from, _]| is_gone[from as usize]) {
            *edge = None;
        }
    }

    // What is left, numbered anew in the same order.
    let mut number = vec![BORDER; points.len()];
    let kept: Vec<usize> = (0..points.len()).filter(|&k| !is_gone[k]).collect();
    kept.iter().zip(0..).for_each(|(&k, new)| number[k] = new);
    let renumbered = |wanted: bool| {
        let all = edges.iter().zip(&is_border).zip(&on_rail).filter(move |((edge, is), _)| edge.is_some() && **is == wanted);
        all.filter_map(|((edge, _), rail)| Some((edge.as_ref()?.map(|v| number[v as usize]), *rail))).collect::<Vec<_>>()
    };
    let (border, lines) = (renumbered(true), renumbered(false));
    let bonds = Bonds {
        tracks: kept.iter().map(|&k| tracks[k]).collect(),
        rails,
        on_rail: border.iter().chain(&lines).map(|&(_, rail)| rail).collect(),
        border: border.into_iter().map(|(edge, _)| edge).collect(),
        lines: lines.into_iter().map(|(edge, _)| edge).collect(),
        sizing,
        hints: kept.iter().map(|&k| hints[k]).collect(),
    };
    State { points: kept.iter().map(|&k| points[k]).collect(), corners: kept.iter().map(|&k| corners[k]).collect(), bonds }
}
