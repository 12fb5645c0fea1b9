//! Patches: where only a few places are bad, each is cut out with what is around it, settled for itself, and put back.
//! What is good elsewhere is neither looked at nor moved meanwhile.

use std::collections::HashMap;

use super::state::State;
use crate::triangulation::{BOUNDARY, Bonds, Edge, HalfEdges, Track, Triangulation};

/// A patch is what can be reached from bad triangles over so many edges.
const REACH: usize = 8;
/// More than this part of all triangles is no patch.
const MOST_SHARE: f64 = 0.25;

/// A part of a mesh.
pub(super) struct Patch {
    /// Its points; on its rim they stay. Of each, the state's `corners` tell which of the whole's points it is; its rails begin with the whole's that it has.
    pub state: State,
    /// The whole's rail that each of these is.
    rails: Vec<u32>,
    /// Of the whole, its points, but those on its rim, and its edges.
    inside: Vec<u32>,
    edges: Vec<usize>,
}

impl Patch {
    /// The whole's rail that one of the patch is; `None` for one on its rim.
    pub fn rail(&self, rail: u32) -> Option<u32> {
        self.rails.get(rail as usize).copied()
    }
}

/// A state, and its triangulation.
#[derive(Clone, Copy)]
pub(super) struct Whole<'a> {
    pub state: &'a State,
    pub triangulation: &'a Triangulation,
    /// The point that each vertex stands for.
    pub source: &'a [u32],
}

/// Cuts out what is around triangles for which `is_bad`; `None` if that is more than [`MOST_SHARE`] of all.
pub(super) fn cut_out(whole: Whole, is_bad: impl Fn([u32; 3]) -> bool) -> Option<Vec<Patch>> {
    let half_edges = &whole.triangulation.half_edges;
    let n_vertices = whole.triangulation.positions.len();
    let most = (MOST_SHARE * half_edges.n_triangles() as f64) as usize;

    // Triangles within reach, ring by ring.
    let outgoing = half_edges.outgoing(n_vertices);
    let mut is_in = vec![false; half_edges.n_triangles()];
    let mut members: Vec<u32> = (0u32..).zip(half_edges.triangles()).filter(|&(_, t)| is_bad(t)).map(|(t, _)| t).collect();
    members.iter().for_each(|&t| is_in[t as usize] = true);
    let mut is_reached = vec![false; n_vertices];
    let mut first = 0;
    for _ in 0..REACH {
        let ring = first..members.len();
        first = ring.end;
        for k in ring {
            for v in half_edges.triangle(members[k] as usize) {
                if std::mem::replace(&mut is_reached[v as usize], true) {
                    continue;
                }
                for t in half_edges.around(outgoing[v as usize]).map(|h| h / 3) {
                    if !std::mem::replace(&mut is_in[t as usize], true) {
                        members.push(t);
                    }
                }
            }
        }
        if members.len() > most {
            return None;
        }
    }

    let by_ends: HashMap<[u32; 2], usize> = whole.state.bonds.edges.iter().map(|edge| edge.ends).zip(0..).collect();
    let mut is_taken = vec![false; half_edges.n_triangles()];
    let mut patches = Vec::new();
    for &start in &members {
        if is_taken[start as usize] {
            continue;
        }
        let triangles = component(half_edges, start, |t| is_in[t as usize] && !std::mem::replace(&mut is_taken[t as usize], true));
        patches.push(whole.patch(&triangles, |t| is_in[t as usize], &by_ends));
    }
    Some(patches)
}

/// All triangles connected to one across edges, for which `take` is true the first time.
fn component(half_edges: &HalfEdges, start: u32, mut take: impl FnMut(u32) -> bool) -> Vec<u32> {
    let mut triangles = Vec::new();
    let mut stack = vec![start];
    while let Some(t) = stack.pop() {
        if take(t) {
            triangles.push(t);
            stack.extend((3 * t..3 * t + 3).map(|h| half_edges.twin[h as usize]).filter(|&twin| twin != BOUNDARY).map(|twin| twin / 3));
        }
    }
    triangles
}

impl Whole<'_> {
    /// The patch of these triangles, of all for which `is_in`.
    fn patch(&self, triangles: &[u32], is_in: impl Fn(u32) -> bool, by_ends: &HashMap<[u32; 2], usize>) -> Patch {
        let half_edges = &self.triangulation.half_edges;
        let Bonds { tracks, rails, edges, sizing, hints } = &self.state.bonds;
        let mut numbers = HashMap::new();
        let mut points: Vec<u32> = Vec::new();
        let mut number = |point: u32| {
            *numbers.entry(point).or_insert_with(|| {
                points.push(point);
                points.len() as u32 - 1
            })
        };
        let (mut own, mut own_edges, mut own_rails) = (Vec::new(), Vec::new(), Vec::new());
        let mut rail_numbers = HashMap::new();
        let mut rim = Vec::new();
        for h in triangles.iter().flat_map(|&t| 3 * t..3 * t + 3) {
            let of = [half_edges.origin[h as usize], half_edges.target(h)].map(|v| self.source[v as usize]);
            let ends = of.map(&mut number);
            let twin = half_edges.twin[h as usize];
            let is_rim = twin != BOUNDARY && !is_in(twin / 3);
            if is_rim {
                rim.push(ends);
            }
            // A line is there from both sides; at the rim it belongs to what is outside.
            if let Some(&edge) = by_ends.get(&of).filter(|_| !is_rim) {
                let rail = edges[edge].rail;
                let rail = *rail_numbers.entry(rail).or_insert_with(|| {
                    own_rails.push(rail);
                    own_rails.len() as u32 - 1
                });
                own.push(Edge { ends, rail, is_line: edges[edge].is_line });
                own_edges.push(edge);
            }
        }
        let place = |point: u32| self.state.points[point as usize];
        let mut is_rim = vec![false; points.len()];
        rim.iter().flatten().for_each(|&point| is_rim[point as usize] = true);
        let rim_rails = own_rails.len() as u32..;
        own.extend(rim.iter().zip(rim_rails).map(|(&ends, rail)| Edge { ends, rail, is_line: false }));
        let of_rim = rim.iter().map(|ends| ends.map(|point| place(points[point as usize])));
        let track = |(&point, &is_rim): (&u32, &bool)| match tracks[point as usize] {
            _ if is_rim => Track::Fixed,
            Track::Rail(rail) => rail_numbers.get(&rail).map_or(Track::Fixed, |&rail| Track::Rail(rail)),
            track => track,
        };
        let bonds = Bonds {
            tracks: points.iter().zip(&is_rim).map(track).collect(),
            rails: own_rails.iter().map(|&rail| rails[rail as usize]).chain(of_rim).collect(),
            edges: own,
            sizing: sizing.clone(),
            hints: points.iter().map(|&point| hints[point as usize]).collect(),
        };
        let inside = points.iter().zip(&is_rim).filter(|(_, is_rim)| !**is_rim).map(|(&point, _)| point).collect();
        let state = State { points: points.iter().map(|&point| place(point)).collect(), corners: points, bonds };
        Patch { state, rails: own_rails, inside, edges: own_edges }
    }
}

/// The whole with what patches have become: other points and edges in place of those that were in them.
pub(super) fn put_back(whole: State, patches: Vec<(Patch, State)>) -> State {
    let State { mut points, mut corners, mut bonds } = whole;
    let mut is_gone = vec![false; points.len()];
    let mut has_gone = vec![false; bonds.edges.len()];
    for (Patch { rails, inside, edges, .. }, state) in patches {
        inside.iter().for_each(|&point| is_gone[point as usize] = true);
        edges.iter().for_each(|&edge| has_gone[edge] = true);
        let mut numbers = Vec::with_capacity(state.points.len());
        for (k, (&at, &point)) in state.points.iter().zip(&state.corners).enumerate() {
            let hint = state.bonds.hints[k];
            if point != BOUNDARY {
                is_gone[point as usize] = false;
                (points[point as usize], bonds.hints[point as usize]) = (at, hint);
                numbers.push(point);
                continue;
            }
            numbers.push(points.len() as u32);
            points.push(at);
            corners.push(BOUNDARY);
            is_gone.push(false);
            bonds.hints.push(hint);
            bonds.tracks.push(match state.bonds.tracks[k] {
                Track::Rail(rail) => Track::Rail(rails[rail as usize]),
                track => track,
            });
        }
        for edge in state.bonds.edges {
            if let Some(&rail) = rails.get(edge.rail as usize) {
                bonds.edges.push(Edge { ends: edge.ends.map(|v| numbers[v as usize]), rail, is_line: edge.is_line });
                has_gone.push(false);
            }
        }
    }

    let edges = bonds.edges.iter().zip(&has_gone).filter(|(_, has_gone)| !**has_gone).map(|(&edge, _)| edge).collect();
    State { points, corners, bonds }.without(&is_gone, edges)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Graded, MeshParams, State, boundary, graded, limit_growth, scatter};
    use crate::points::Random;
    use crate::polygon::Polygon;
    use crate::space::{Domain, SegmentTree};
    use crate::triangulation::LiveMesh;

    /// A square with a hole and a line, points at random in it, and their mesh.
    fn meshed() -> (Domain, State, LiveMesh) {
        let square = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let hole = vec![[0.2, 0.2], [0.3, 0.2], [0.25, 0.3]];
        let polygon = Polygon::from_rings(vec![square, hole]).unwrap();
        let mut params = MeshParams::new(0.012);
        params.lines = vec![vec![[0.5, 0.0], [0.6, 0.7]]];
        let Graded { outline, mut background, .. } = graded(&polygon, &params).unwrap();
        let parts = boundary::divide(&outline, &mut background);
        limit_growth(&mut background.sizing, params.growth);
        let inside = scatter(&background.sizing, &SegmentTree::new(&[]), &mut Random::new(1, 1));
        let state = State::new(&outline, background, &parts, inside);
        let mesh = LiveMesh::bounded(&polygon.domain(), &state.points, state.bonds.clone(), 0.012).unwrap();
        let state = State::of(&mesh, state.corners).unwrap();
        (polygon.domain(), state, mesh)
    }

    /// What is where, without numbers.
    fn told(state: &State) -> Vec<String> {
        let place = |point: u32| state.points[point as usize];
        let points = (0..).zip(&state.points).map(|(k, p)| format!("{p} {:?}", state.bonds.tracks[k]));
        let edges = state.bonds.edges.iter().map(|edge| format!("{:?} {} {}", edge.ends.map(place), edge.rail, edge.is_line));
        let mut told: Vec<String> = points.chain(edges).collect();
        told.sort();
        told
    }

    #[test]
    fn what_is_cut_out_and_put_back_unchanged_is_the_whole() {
        let (domain, state, mesh) = meshed();
        let triangulation = mesh.triangulation();
        let (_, source) = mesh.bonds().unwrap();
        let before = told(&state);
        let mut n_patches = 0;
        for seed in 0..40 {
            let mut random = Random::new(seed, 2);
            let whole = Whole { state: &state, triangulation: &triangulation, source };
            let n_bad = 1 + seed as usize % 3;
            let bad: Vec<usize> = (0..n_bad).map(|_| (random.unit() * triangulation.half_edges.n_triangles() as f64) as usize).collect();
            let corners: Vec<[u32; 3]> = bad.iter().map(|&t| triangulation.half_edges.triangle(t)).collect();
            let Some(patches) = cut_out(whole, |t| corners.contains(&t)) else { continue };
            n_patches += patches.len();
            for patch in &patches {
                // A patch can be triangulated by itself, and has nothing loose.
                let State { points, bonds, .. } = &patch.state;
                let own = LiveMesh::bounded(&domain, points, bonds.clone(), 0.012).unwrap();
                let is_there: std::collections::HashSet<&u32> = own.bonds().unwrap().1.iter().collect();
                assert_eq!(is_there.len(), points.len());
            }
            let unchanged = patches.into_iter().map(|patch| {
                let state = patch.state.clone();
                (patch, state)
            });
            assert_eq!(told(&put_back(state.clone(), unchanged.collect())), before, "seed {seed}");
        }
        assert!(n_patches > 30, "{n_patches}");
    }
}
