//! Delaunay refinement: points are added to a triangulation with a boundary until no triangle is thin.
//!
//! Ruppert, "A Delaunay Refinement Algorithm for Quality 2-Dimensional Mesh Generation", Journal of Algorithms 18(3), 1995, doi 10.1006/jagm.1995.1021. A segment of the boundary
//! is halved where a vertex lies in its diametral circle; else a thin triangle's circumcentre is added, or, where that would lie in the diametral circle of a segment or behind
//! one, the segment is halved. Here nothing is halved below a floor: domains may be thinner than is worth following. Lines inside are segments as well.

use std::collections::{HashMap, VecDeque};

use glam::DVec2;

use super::half_edges::{BOUNDARY, HalfEdges, next, prev};
use super::mesh::circumcentre;
use super::patch::Patch;
use super::planar::Planar;
use crate::predicates::{is_in_circle, is_left_turn};
use crate::space::snap;

/// When a triangle is to be refined, and where that ends.
#[derive(Clone, Copy)]
pub(crate) struct Refining<'a> {
    /// A triangle is thin whose circumradius is more than this many times its shortest side; 1.42 at least for the proof, less ends as well in practice.
    pub aspect: f64,
    /// No segment is halved to less than this. New vertices inside are no nearer to others than these are already, so that is enough to end it.
    pub floor: f64,
    /// Vertices are added up to so many in all.
    pub max_vertices: usize,
    /// Whether all segments are looked at at first; otherwise those around new vertices alone.
    pub halves_all: bool,
    /// Segments longer than this are halved in any case.
    pub longest: f64,
    /// Whether new vertices come no farther from the shortest side than makes its triangle good (off-centres:
    /// Üngör, "Off-centers: A new type of Steiner points for computing size-optimal quality-guaranteed
    /// Delaunay triangulations", Computational Geometry 42(2), 2009), so that there are fewer.
    pub is_sparing: bool,
    /// The largest circumradius around a place, where that is limited.
    pub largest: Option<&'a (dyn Fn(DVec2) -> f64 + Sync)>,
}

/// A triangulation to which points are added.
pub(crate) struct Refinement {
    pub half_edges: HalfEdges,
    pub positions: Vec<DVec2>,
    /// The segment of the input on which a half-edge of the boundary lies, or of a line in its direction, by its ends.
    pub segments: HashMap<[u32; 2], u32>,
    /// Whether some of them lie inside.
    has_lines: bool,
}

/// Where a walk ends.
enum Found {
    Triangle(u32),
    Edge(u32),
    /// Behind a segment's half-edge.
    Behind(u32),
    Nowhere,
}

/// Off-centres are a little nearer than they might be: so their triangles are good for sure.
const OFF_CENTRE: f64 = 0.95;

/// How high above its shortest side, in lengths of that, an isosceles triangle is whose circumradius is
/// `aspect` of them.
fn off_centre(aspect: f64) -> f64 {
    let sin = 0.5 / aspect;
    0.5 * (1.0 + (1.0 - sin * sin).sqrt()) / sin
}

/// More steps than a walk ever takes.
const MAX_STEPS: usize = 10_000;

impl Refinement {
    /// Refines a triangulation; `segments` tells for each half-edge of its boundary, and of lines, by its ends, on which segment of the input it lies.
    pub fn run(planar: Planar, segments: HashMap<[u32; 2], u32>, refining: Refining) -> Self {
        let n_boundary = planar.half_edges.twin.iter().filter(|&&twin| twin == BOUNDARY).count();
        let has_lines = segments.len() > n_boundary;
        let mut refinement = Self { half_edges: planar.half_edges, positions: planar.positions, segments, has_lines };
        refinement.legalize((0..refinement.half_edges.origin.len() as u32).collect());
        let n_suspects = if refining.halves_all { refinement.half_edges.origin.len() as u32 } else { 0 };
        let mut encroached: Vec<u32> = (0..n_suspects).collect();
        let mut thin: VecDeque<u32> = VecDeque::new();
        thin.extend(0..refinement.half_edges.n_triangles() as u32);
        while refinement.positions.len() < refining.max_vertices {
            if let Some(h) = encroached.pop() {
                if refinement.is_to_be_halved(h, refining)
                    && let Some(v) = refinement.halve(h)
                {
                    refinement.look_around(v, &mut encroached, &mut thin);
                }
            } else if let Some(t) = thin.pop_front() {
                if let Some(centre) = refinement.centre_if_thin(t, refining)
                    && let Some(v) = refinement.add(t, centre, refining.floor)
                {
                    thin.push_back(t);
                    refinement.look_around(v, &mut encroached, &mut thin);
                }
            } else {
                break;
            }
        }
        refinement
    }

    fn at(&self, v: u32) -> DVec2 {
        self.positions[v as usize]
    }

    fn ends(&self, h: u32) -> [DVec2; 2] {
        [self.half_edges.origin[h as usize], self.half_edges.target(h)].map(|v| self.at(v))
    }

    fn apex(&self, h: u32) -> DVec2 {
        self.at(self.half_edges.origin[prev(h) as usize])
    }

    /// Whether a segment's half-edge is too long, or has its apex in its diametral circle.
    fn is_to_be_halved(&self, h: u32, refining: Refining) -> bool {
        let is_unwanted = || self.length(h) > refining.longest || self.is_in_diametral_circle(h, self.apex(h));
        self.is_segment(h) && self.is_long(h, refining.floor) && is_unwanted()
    }

    fn length(&self, h: u32) -> f64 {
        let [a, b] = self.ends(h);
        a.distance(b)
    }

    /// Whether a half-edge lies on the boundary or a line.
    fn is_segment(&self, h: u32) -> bool {
        let [from, to] = [self.half_edges.origin[h as usize], self.half_edges.target(h)];
        let is_line = || self.segments.contains_key(&[from, to]) || self.segments.contains_key(&[to, from]);
        self.half_edges.is_boundary(h) || self.has_lines && is_line()
    }

    fn is_in_diametral_circle(&self, h: u32, p: DVec2) -> bool {
        let [a, b] = self.ends(h);
        (a - p).dot(b - p) < 0.0
    }

    /// Whether the halves are not below the floor.
    fn is_long(&self, h: u32, floor: f64) -> bool {
        self.length(h) >= 2.0 * floor
    }

    /// The circumcentre of a triangle, if it is thin.
    fn centre_if_thin(&self, t: u32, refining: Refining) -> Option<DVec2> {
        let [a, b, c] = self.half_edges.triangle(t as usize).map(|v| self.at(v));
        let sides = [(a, b), (b, c), (c, a)];
        let (from, to) = sides.into_iter().min_by(|p, q| p.0.distance_squared(p.1).total_cmp(&q.0.distance_squared(q.1)))?;
        let shortest = from.distance_squared(to);
        let centre = circumcentre(b - a, c - a);
        let is_large = refining.largest.is_some_and(|largest| centre.length() > largest((a + b + c) / 3.0));
        let is_thin = centre.length_squared() > refining.aspect * refining.aspect * shortest;
        if !(is_thin || is_large) {
            return None;
        }
        let middle = 0.5 * (from + to);
        let (way, most) = (a + centre - middle, OFF_CENTRE * off_centre(refining.aspect) * shortest.sqrt());
        let is_far = refining.is_sparing && is_thin && way.length() > most;
        Some(if is_far { middle + way * (most / way.length()) } else { a + centre })
    }

    /// Adds `p`, looked for from triangle `t` on, or halves a segment instead. The new vertex; `None` where neither can be.
    fn add(&mut self, t: u32, p: DVec2, floor: f64) -> Option<u32> {
        let p = snap(p);
        let (at, edge) = match self.locate(t, p) {
            Found::Triangle(t) => (t, None),
            Found::Edge(h) => (h / 3, Some(h)),
            Found::Behind(h) => return self.is_long(h, floor).then(|| self.halve(h)).flatten(),
            Found::Nowhere => return None,
        };
        if let Some(h) = self.segment_around(at, p) {
            return self.is_long(h, floor).then(|| self.halve(h)).flatten();
        }
        match edge {
            None => self.split_triangle(at, p),
            Some(h) => self.split_edge(h, p),
        }
    }

    /// A segment's half-edge with `p` in its diametral circle, of those around all triangles whose circumcircles hold it.
    fn segment_around(&self, t: u32, p: DVec2) -> Option<u32> {
        let mut seen = vec![t];
        let mut k = 0;
        while k < seen.len() {
            for h in 3 * seen[k]..3 * seen[k] + 3 {
                let twin = self.half_edges.twin[h as usize];
                if self.is_segment(h) {
                    if self.is_in_diametral_circle(h, p) {
                        return Some(h);
                    }
                } else if !seen.contains(&(twin / 3)) {
                    let [a, b, c] = self.half_edges.triangle(twin as usize / 3).map(|v| self.at(v));
                    if is_in_circle(b - a, c - a, p - a) {
                        seen.push(twin / 3);
                    }
                }
            }
            k += 1;
        }
        None
    }

    /// Walks from triangle `t` to `p`.
    fn locate(&self, t: u32, p: DVec2) -> Found {
        let mut t = t;
        'walk: for step in 0..MAX_STEPS as u32 {
            let mut on = None;
            for k in 0..3 {
                // Not always the same side first: walks so do not go in circles.
                let h = 3 * t + (k + step) % 3;
                let [a, b] = self.ends(h);
                if is_left_turn(p - a, b - a) {
                    if self.is_segment(h) {
                        return Found::Behind(h);
                    }
                    t = self.half_edges.twin[h as usize] / 3;
                    continue 'walk;
                }
                if !is_left_turn(b - a, p - a) {
                    on = Some(h);
                }
            }
            return on.map_or(Found::Triangle(t), Found::Edge);
        }
        Found::Nowhere
    }

    /// Puts a vertex into the middle of a segment's half-edge.
    fn halve(&mut self, h: u32) -> Option<u32> {
        let [a, b] = self.ends(h);
        self.split_edge(h, snap(0.5 * (a + b)))
    }

    /// Three triangles for one.
    fn split_triangle(&mut self, t: u32, p: DVec2) -> Option<u32> {
        let corners = self.half_edges.triangle(t as usize);
        let is_inside = (0..3).all(|k| self.is_upright([corners[k], corners[(k + 1) % 3]], p));
        if !is_inside {
            return None;
        }
        let v = self.positions.len() as u32;
        self.positions.push(p);
        let [_, second, third] = [0, 1, 2].map(|k| self.half_edges.twin[3 * t as usize + k]);
        let HalfEdges { origin, twin } = &mut self.half_edges;
        let n = origin.len() as u32;
        // (a b v) stays, (b c v) and (c a v) come.
        origin[3 * t as usize + 2] = v;
        origin.extend([corners[1], corners[2], v, corners[2], corners[0], v]);
        twin.extend([second, n + 5, 3 * t + 1, third, 3 * t + 2, n + 1]);
        (twin[3 * t as usize + 1], twin[3 * t as usize + 2]) = (n + 2, n + 4);
        for (across, edge) in [(second, n), (third, n + 3)] {
            if across != BOUNDARY {
                twin[across as usize] = edge;
            }
        }
        self.legalize(vec![3 * t, n, n + 3]);
        Some(v)
    }

    /// Two triangles for each at an edge.
    fn split_edge(&mut self, h: u32, p: DVec2) -> Option<u32> {
        let other = self.half_edges.twin[h as usize];
        let sides = if other == BOUNDARY { vec![h] } else { vec![h, other] };
        let is_inside = sides.iter().all(|&side| {
            let [a, b] = [self.half_edges.origin[side as usize], self.half_edges.target(side)];
            let c = self.half_edges.origin[prev(side) as usize];
            self.is_upright([b, c], p) && self.is_upright([c, a], p)
        });
        if !is_inside {
            return None;
        }
        let v = self.positions.len() as u32;
        self.positions.push(p);
        let ends = [self.half_edges.origin[h as usize], self.half_edges.target(h)];
        for [from, to] in [ends, [ends[1], ends[0]]] {
            if let Some(segment) = self.segments.remove(&[from, to]) {
                self.segments.insert([from, v], segment);
                self.segments.insert([v, to], segment);
            }
        }
        let HalfEdges { origin, twin } = &mut self.half_edges;
        let n = origin.len() as u32;
        let mut suspects = Vec::new();
        // (a b c) becomes (a v c), and (v b c) comes.
        for (&side, new) in sides.iter().zip([n, n + 3]) {
            let (b, c) = (origin[next(side) as usize], origin[prev(side) as usize]);
            let across = twin[next(side) as usize];
            origin.extend([v, b, c]);
            twin.extend([BOUNDARY, across, next(side)]);
            origin[next(side) as usize] = v;
            twin[next(side) as usize] = new + 2;
            if across != BOUNDARY {
                twin[across as usize] = new + 1;
            }
            suspects.extend([prev(side), new + 1]);
        }
        if let [side, across] = sides[..] {
            // Of each pair of halves that of the one side leaves where that of the other arrives.
            for (one, two) in [(side, n + 3), (n, across)] {
                (twin[one as usize], twin[two as usize]) = (two, one);
            }
        }
        self.legalize(suspects);
        Some(v)
    }

    /// Whether `p` lies to the left of an edge.
    fn is_upright(&self, ends: [u32; 2], p: DVec2) -> bool {
        let [a, b] = ends.map(|v| self.at(v));
        is_left_turn(b - a, p - a)
    }

    fn is_illegal(&self, h: u32) -> bool {
        let twin = self.half_edges.twin[h as usize];
        if self.is_segment(h) {
            return false;
        }
        let from = self.at(self.half_edges.origin[h as usize]);
        let [q, r, s] = [self.at(self.half_edges.target(h)), self.apex(h), self.apex(twin)].map(|p| p - from);
        is_in_circle(q, r, s)
    }

    /// Lawson's flips.
    fn legalize(&mut self, mut suspects: Vec<u32>) {
        while let Some(h) = suspects.pop() {
            if self.is_illegal(h) {
                let t = self.half_edges.twin[h as usize];
                Patch::whole(&mut self.half_edges).flip(h);
                suspects.extend([h, t, next(h), next(t)]);
            }
        }
    }

    /// Puts the triangles around a vertex that has just been added on the lists. Flips take no triangle away from it, so it is a corner of the last one.
    fn look_around(&self, v: u32, encroached: &mut Vec<u32>, thin: &mut VecDeque<u32>) {
        let n = self.half_edges.origin.len() as u32;
        let Some(first) = (n - 3..n).find(|&h| self.half_edges.origin[h as usize] == v) else { return };
        for h in self.half_edges.around(first) {
            thin.push_back(h / 3);
            let t = 3 * (h / 3);
            encroached.extend((t..t + 3).filter(|&side| self.is_segment(side)));
        }
    }
}
