//! Coarsening: vertices that refinement has added, and others near them, are taken out where all angles stay large enough without them.
//!
//! Around a detail that stands alone, refinement adds layer after layer of vertices, about twice as many as are
//! needed. Each is taken out on trial: its hole is triangulated so that the smallest angle is largest, and the
//! vertices around move and their edges flip (as in Freitag and Ollivier-Gooch, "Tetrahedral mesh improvement
//! using swapping and smoothing", IJNME 40, 1997) until no angle is too small; where one stays, so does the vertex.

use std::collections::HashMap;

use glam::DVec2;

use super::aim::cosines;
use crate::space::snap;
use crate::triangulation::{BOUNDARY, HalfEdges};

/// Vertices whose shortest edge is below this part of what is wanted are tried.
const SHORT: f64 = 0.6;
/// So many edges from what was added, others are tried too.
const RINGS: usize = 2;
/// So many at most are tried: more are added between walls that nearly touch, and hardly one too many.
const MOST_TRIED: usize = 20_000;
/// Passes over the vertices.
const PASSES: usize = 3;
/// Rounds of moves and flips around a hole.
const ROUNDS: usize = 6;
/// Holes with more corners than this stay as they are.
const MOST_CORNERS: usize = 16;
/// How far a vertex first tries to move, in lengths of its shortest edge, and how often it halves that.
const FIRST_STEP: f64 = 0.25;
const HALVINGS: usize = 5;

/// Triangles from which vertices are taken out.
pub(super) struct Coarsening {
    positions: Vec<DVec2>,
    /// Triangles that are no more have no corners.
    triangles: Vec<Option<[u32; 3]>>,
    /// The triangles around each vertex.
    around: Vec<Vec<u32>>,
    /// The outline's segment on which an edge lies, by its ends, in the direction of its triangle.
    segments: HashMap<[u32; 2], u32>,
    /// The segments' ends.
    rails: Vec<[DVec2; 2]>,
    /// No angle may have a cosine above this.
    most_cosine: f64,
}

/// A refined mesh, and what coarsening leaves of it.
pub(super) struct Coarse {
    pub half_edges: HalfEdges,
    pub positions: Vec<DVec2>,
    /// The outline's segment on which an edge lies, by its ends, in the direction of its triangle.
    pub segments: HashMap<[u32; 2], u32>,
    /// The number that each vertex had when it was refined.
    pub source: Vec<u32>,
}

/// Where a vertex may go.
#[derive(Clone, Copy, PartialEq)]
enum Freedom {
    Nowhere,
    Anywhere,
    Along(u32),
}

impl Coarsening {
    /// No angle is to be smaller than `least_deg`; `rails` are the ends of the outline's segments.
    pub fn new(Coarse { half_edges, positions, segments, .. }: Coarse, rails: Vec<[DVec2; 2]>, least_deg: f64) -> Self {
        let mut around = vec![Vec::new(); positions.len()];
        for (t, corners) in (0..).zip(half_edges.triangles()) {
            corners.into_iter().for_each(|v| around[v as usize].push(t));
        }
        let triangles = half_edges.triangles().map(Some).collect();
        Self { positions, triangles, around, segments, rails, most_cosine: libm::cos(least_deg.to_radians()) }
    }

    /// Takes out what it can of the vertices from `first_added` on, and of those near them, where edges are much
    /// shorter than `size` asks for. What is fixed stays where it is.
    pub fn run(&mut self, first_added: usize, is_fixed: impl Fn(u32) -> bool, size: impl Fn(u32) -> f64) {
        let mut near: Vec<u32> = (first_added as u32..self.positions.len() as u32).collect();
        for _ in 0..RINGS {
            near = near.iter().flat_map(|&v| self.corners_around(v)).collect();
            near.sort_unstable();
            near.dedup();
        }
        near.retain(|&v| !is_fixed(v));
        near.truncate(MOST_TRIED);
        for _ in 0..PASSES {
            let mut is_done = true;
            for &v in &near {
                if self.shortest(v) < SHORT * size(v) {
                    is_done &= !self.take_out(v, &is_fixed);
                }
            }
            if is_done {
                break;
            }
        }
    }

    /// What is left, renumbered.
    pub fn finish(self) -> Coarse {
        let triangles: Vec<[u32; 3]> = self.triangles.into_iter().flatten().collect();
        let source: Vec<u32> = (0..self.positions.len() as u32).filter(|&v| !self.around[v as usize].is_empty()).collect();
        let mut number = vec![BOUNDARY; self.positions.len()];
        source.iter().zip(0..).for_each(|(&v, new)| number[v as usize] = new);
        Coarse {
            half_edges: HalfEdges::of_triangles(source.len(), triangles.iter().map(|t| t.map(|v| number[v as usize]))),
            positions: source.iter().map(|&v| self.positions[v as usize]).collect(),
            segments: self.segments.into_iter().map(|(ends, segment)| (ends.map(|v| number[v as usize]), segment)).collect(),
            source,
        }
    }

    /// The length of a vertex's shortest edge.
    fn shortest(&self, v: u32) -> f64 {
        let at = self.positions[v as usize];
        self.corners_around(v).filter(|&u| u != v).map(|u| self.positions[u as usize].distance(at)).fold(f64::INFINITY, f64::min)
    }

    /// Takes a vertex out; false where it has to stay.
    fn take_out(&mut self, v: u32, is_fixed: &impl Fn(u32) -> bool) -> bool {
        let Some(holes) = self.holes(v) else { return false };
        // Whoever is next to the hole may give way, and those next to them.
        let mut movers: Vec<u32> = holes.iter().flatten().flat_map(|&u| self.corners_around(u)).filter(|&u| u != v).collect();
        movers.sort_unstable();
        movers.dedup();
        let mut old: Vec<u32> = movers.iter().flat_map(|&u| self.around[u as usize].iter().copied()).collect();
        old.sort_unstable();
        old.dedup();
        let mut triangles: Vec<[u32; 3]> =
            old.iter().filter_map(|&t| self.triangles[t as usize]).filter(|corners| !corners.contains(&v)).collect();
        for hole in &holes {
            let Some(filled) = self.filled(hole) else { return false };
            triangles.extend(filled);
        }
        let segment = (holes.len() == 2 || self.is_on_segment(v)).then(|| [holes[0][0], holes[0][holes[0].len() - 1]]);
        let mut patch = Patch::new(self, &movers, triangles, segment, is_fixed);
        if !patch.settle() {
            return false;
        }
        let Patch { vertices, positions, triangles, .. } = patch;
        for (&u, p) in vertices.iter().zip(positions) {
            self.positions[u as usize] = p;
        }
        // The hole's segment in place of the vertex's two, in each direction that these had.
        if let Some([to, from]) = segment {
            for ends in [[from, to], [to, from]] {
                if let Some(number) = self.segments.remove(&[ends[0], v]) {
                    self.segments.remove(&[v, ends[1]]);
                    self.segments.insert(ends, number);
                }
            }
        }
        for &t in &old {
            for u in self.triangles[t as usize].take().into_iter().flatten() {
                self.around[u as usize].retain(|&other| other != t);
            }
        }
        for (&t, corners) in old.iter().zip(triangles) {
            let corners = corners.map(|k| vertices[k as usize]);
            corners.into_iter().for_each(|u| self.around[u as usize].push(t));
            self.triangles[t as usize] = Some(corners);
        }
        true
    }

    fn corners_around(&self, v: u32) -> impl Iterator<Item = u32> {
        self.around[v as usize].iter().filter_map(|&t| self.triangles[t as usize]).flatten()
    }

    fn is_on_segment(&self, v: u32) -> bool {
        self.corners_around(v).any(|u| self.segments.contains_key(&[v, u]) || self.segments.contains_key(&[u, v]))
    }

    /// What is left where a vertex was, counter-clockwise: on a segment each side's hole, beginning and ending on it.
    /// `None` where segments meet.
    fn holes(&self, v: u32) -> Option<Vec<Vec<u32>>> {
        let following: HashMap<u32, u32> = self.around[v as usize]
            .iter()
            .filter_map(|&t| self.triangles[t as usize])
            .map(|corners| {
                let k = corners.iter().position(|&u| u == v).unwrap_or(0);
                (corners[(k + 1) % 3], corners[(k + 2) % 3])
            })
            .collect();
        let is_segment = |u: u32| self.segments.contains_key(&[v, u]) || self.segments.contains_key(&[u, v]);
        // In the order of their numbers, so that the result is always the same.
        let mut starts: Vec<u32> = following.keys().copied().filter(|&u| is_segment(u)).collect();
        starts.sort_unstable();
        let is_closed = starts.is_empty();
        if is_closed {
            starts.extend(following.keys().min());
        }
        let mut holes = Vec::new();
        for start in starts {
            let mut hole = vec![start];
            let mut at = start;
            while let Some(&next) = following.get(&at).filter(|_| hole.len() <= MOST_CORNERS) {
                if next == start {
                    break;
                }
                hole.push(next);
                at = next;
                if is_segment(at) {
                    break;
                }
            }
            holes.push(hole);
        }
        let n_around: usize = holes.iter().map(|hole| hole.len() - 1).sum::<usize>() + usize::from(is_closed);
        (holes.len() <= 2 && n_around == following.len()).then_some(holes)
    }

    /// A polygon's triangles, of which the smallest angle is as large as possible; `None` where one would be turned over
    /// (Klincsek, "Minimal triangulations of polygonal domains", Annals of Discrete Mathematics 9, 1980).
    fn filled(&self, polygon: &[u32]) -> Option<Vec<[u32; 3]>> {
        let n = polygon.len();
        let at = |i: usize| self.positions[polygon[i] as usize];
        // The least of the largest cosines between two corners, and the third corner with which it is reached.
        let mut best = [[(f64::NEG_INFINITY, 0); MOST_CORNERS + 1]; MOST_CORNERS + 1];
        for span in 2..n {
            for i in 0..n - span {
                let j = i + span;
                best[i][j] = (i + 1..j)
                    .map(|k| (largest_cosine([at(i), at(k), at(j)]).max(best[i][k].0).max(best[k][j].0), k))
                    .min_by(|a, b| a.0.total_cmp(&b.0))?;
            }
        }
        if best[0][n - 1].0 == f64::INFINITY {
            return None;
        }
        let mut triangles = Vec::with_capacity(n - 2);
        let mut stack = vec![[0, n - 1]];
        while let Some([i, j]) = stack.pop().filter(|[i, j]| j - i > 1) {
            let k = best[i][j].1;
            triangles.push([polygon[i], polygon[k], polygon[j]]);
            stack.extend([[i, k], [k, j]].into_iter().filter(|[i, j]| j - i > 1));
        }
        Some(triangles)
    }
}

/// What is around a hole, with vertices numbered of its own.
struct Patch<'a> {
    vertices: Vec<u32>,
    positions: Vec<DVec2>,
    freedom: Vec<Freedom>,
    rails: &'a [[DVec2; 2]],
    triangles: Vec<[u32; 3]>,
    around: Vec<Vec<u32>>,
    /// Edges that stay, by their ends in both directions.
    is_segment: Vec<[u32; 2]>,
    most_cosine: f64,
}

impl<'a> Patch<'a> {
    fn new(
        whole: &'a Coarsening,
        movers: &[u32],
        triangles: Vec<[u32; 3]>,
        segment: Option<[u32; 2]>,
        is_fixed: &impl Fn(u32) -> bool,
    ) -> Self {
        let mut vertices: Vec<u32> = triangles.iter().flatten().copied().collect();
        vertices.sort_unstable();
        vertices.dedup();
        let local = |u: u32| vertices.binary_search(&u).map_or(BOUNDARY, |k| k as u32);
        let mut is_segment: Vec<[u32; 2]> = segment.into_iter().flat_map(|[a, b]| [[a, b], [b, a]]).map(|ends| ends.map(local)).collect();
        let mut freedom: Vec<Freedom> = vertices
            .iter()
            .map(|u| if is_fixed(*u) || movers.binary_search(u).is_err() { Freedom::Nowhere } else { Freedom::Anywhere })
            .collect();
        let mut around = vec![Vec::new(); vertices.len()];
        let mut inside = Vec::with_capacity(triangles.len());
        for (t, corners) in (0..).zip(&triangles) {
            for k in 0..3 {
                let ends = [corners[k], corners[(k + 1) % 3]];
                if let Some(&number) = whole.segments.get(&ends) {
                    let [a, b] = ends.map(local);
                    is_segment.extend([[a, b], [b, a]]);
                    for v in [a, b] {
                        let freedom = &mut freedom[v as usize];
                        *freedom = match *freedom {
                            Freedom::Anywhere => Freedom::Along(number),
                            Freedom::Along(other) if other == number => *freedom,
                            _ => Freedom::Nowhere,
                        };
                    }
                }
                around[local(corners[k]) as usize].push(t);
            }
            inside.push(corners.map(local));
        }
        Self {
            positions: vertices.iter().map(|&u| whole.positions[u as usize]).collect(),
            vertices,
            freedom,
            rails: &whole.rails,
            triangles: inside,
            around,
            is_segment,
            most_cosine: whole.most_cosine,
        }
    }

    /// Moves vertices and flips edges until all angles are large enough; false where they do not get so.
    fn settle(&mut self) -> bool {
        for _ in 0..ROUNDS {
            let mut is_changed = false;
            for v in 0..self.vertices.len() as u32 {
                is_changed |= self.freedom[v as usize] != Freedom::Nowhere && self.improve(v);
            }
            is_changed |= self.flip();
            if self.triangles.iter().all(|&t| self.largest_cosine(t) <= self.most_cosine) {
                return true;
            }
            if !is_changed {
                return false;
            }
        }
        false
    }

    fn largest_cosine(&self, t: [u32; 3]) -> f64 {
        largest_cosine(t.map(|v| self.positions[v as usize]))
    }

    fn largest_around(&self, v: u32) -> f64 {
        self.around[v as usize].iter().map(|&t| self.largest_cosine(self.triangles[t as usize])).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Moves a vertex to where the smallest angle around it is larger.
    fn improve(&mut self, v: u32) -> bool {
        let at = self.positions[v as usize];
        let others = self.around[v as usize].iter().flat_map(|&t| self.triangles[t as usize]).filter(|&u| u != v);
        let shortest = others.map(|u| self.positions[u as usize].distance(at)).fold(f64::INFINITY, f64::min);
        let mut step = FIRST_STEP * shortest;
        let mut least = self.largest_around(v);
        for _ in 0..HALVINGS {
            let from = self.positions[v as usize];
            let is_better = (0..8).any(|k| {
                let way = DVec2::from_angle(f64::from(k) * std::f64::consts::FRAC_PI_4) * step;
                self.positions[v as usize] = match self.freedom[v as usize] {
                    Freedom::Along(rail) => {
                        let [start, end] = self.rails[rail as usize];
                        let along = end - start;
                        let by = if k % 2 == 0 { step } else { -step };
                        let share = (from - start).dot(along) / along.length_squared() + by / along.length();
                        snap(start + along * share.clamp(0.0, 1.0))
                    }
                    _ => snap(from + way),
                };
                let found = self.largest_around(v);
                let is_better = found < least;
                if is_better {
                    least = found;
                } else {
                    self.positions[v as usize] = from;
                }
                is_better
            });
            if !is_better {
                step *= 0.5;
            }
        }
        self.positions[v as usize] != at
    }

    /// Flips edges where that makes the smallest angle larger.
    fn flip(&mut self) -> bool {
        let mut is_changed = false;
        for t in 0..self.triangles.len() as u32 {
            for k in 0..3 {
                let [a, b, c] = [0, 1, 2].map(|i| self.triangles[t as usize][(k + i) % 3]);
                if self.is_segment.contains(&[a, b]) {
                    continue;
                }
                let across = self.around[b as usize].iter().find_map(|&other| {
                    let corners = self.triangles[other as usize];
                    let i = (0..3).find(|&i| corners[i] == b && corners[(i + 1) % 3] == a)?;
                    Some((other, corners[(i + 2) % 3]))
                });
                let Some((other, d)) = across else { continue };
                let old = self.largest_cosine([a, b, c]).max(self.largest_cosine([b, a, d]));
                let new = self.largest_cosine([c, a, d]).max(self.largest_cosine([d, b, c]));
                if new < old {
                    (self.triangles[t as usize], self.triangles[other as usize]) = ([c, a, d], [d, b, c]);
                    self.around[a as usize].retain(|&t| t != other);
                    self.around[b as usize].retain(|&at| at != t);
                    self.around[c as usize].push(other);
                    self.around[d as usize].push(t);
                    is_changed = true;
                    break;
                }
            }
        }
        is_changed
    }
}

/// The largest cosine of a triangle's angles: that of the smallest. Infinite where it is turned over.
fn largest_cosine([a, b, c]: [DVec2; 3]) -> f64 {
    if (b - a).perp_dot(c - a) <= 0.0 {
        return f64::INFINITY;
    }
    cosines([a, b, c]).into_iter().fold(f64::NEG_INFINITY, f64::max)
}
