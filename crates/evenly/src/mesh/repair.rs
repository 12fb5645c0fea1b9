//! Where points cannot come to rest there are too many or too few of them: some are taken away or added, far from each other, and the others find new places.

mod changes;

use std::collections::HashMap;

use glam::DVec2;

use self::changes::Change;
use super::aim::Aim;
use super::state::State;
use crate::geometry::spacing::triangle_count;
use crate::space::snap;
use crate::triangulation::{Bonds, LiveMesh, Track, Triangulation, circumcentre, prev};

/// Edges of the boundary that are longer than this many spacings are better halved.
const LONG: f64 = 1.3;
/// And nearer to an end than by this part of them no point comes onto them.
const LEAST_SHARE: f64 = 0.2;
/// Changes keep so many spacings from each other.
const APART: f64 = 4.0;
/// No more changes at a time.
const MOST: usize = 4000;

/// Adds and removes points where triangles are not as they are to be; `None` where there is nothing to change. Edges on rails for which `may_halve` is false stay whole.
pub(super) fn repair(mesh: &LiveMesh, corners: Vec<u32>, aim: &Aim, may_halve: impl Fn(u32) -> bool) -> Option<State> {
    let view = View::new(mesh)?;
    let faults = (0..view.triangulation.half_edges.n_triangles()).filter_map(|t| view.fault(t, aim, &may_halve));
    let faults = apart(faults.collect());
    if faults.is_empty() {
        return None;
    }
    let state = State::of(mesh, corners)?;
    Some(state.changed(faults.into_iter().map(|fault| fault.change)))
}

/// A place where something is wrong, and what mends it.
struct Fault {
    /// How wrong.
    badness: f64,
    at: DVec2,
    spacing: f64,
    change: Change,
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

/// A mesh, to be looked at.
struct View<'a> {
    mesh: &'a LiveMesh,
    triangulation: Triangulation,
    outgoing: Vec<u32>,
    source: &'a [u32],
    bonds: Bonds,
    /// The edges on rails by their points.
    edges: HashMap<[u32; 2], usize>,
}

impl<'a> View<'a> {
    fn new(mesh: &'a LiveMesh) -> Option<Self> {
        let (bonds, source) = mesh.bonds()?;
        let triangulation = mesh.triangulation();
        let outgoing = triangulation.half_edges.outgoing(triangulation.positions.len());
        let edges = bonds.edges.iter().map(|edge| edge.ends).zip(0..).collect();
        Some(Self { mesh, triangulation, outgoing, source, bonds, edges })
    }

    fn at(&self, v: u32) -> DVec2 {
        self.triangulation.positions[v as usize]
    }

    fn places(&self, t: usize) -> [DVec2; 3] {
        self.triangulation.half_edges.triangle(t).map(|v| self.at(v))
    }

    /// The wanted spacing in a triangle.
    fn spacing(&self, t: usize) -> f64 {
        self.triangulation.half_edges.triangle(t).into_iter().map(|v| self.mesh.local_spacing(v)).sum::<f64>() / 3.0
    }

    /// The ends of a half-edge.
    fn ends(&self, h: u32) -> [u32; 2] {
        [self.triangulation.half_edges.origin[h as usize], self.triangulation.half_edges.target(h)]
    }

    fn length(&self, h: u32) -> f64 {
        let [a, b] = self.ends(h);
        self.at(a).distance(self.at(b))
    }

    fn track(&self, v: u32) -> Track {
        self.bonds.tracks[self.source[v as usize] as usize]
    }

    /// What is wrong with a triangle, if anything is and can be changed.
    fn fault(&self, t: usize, aim: &Aim, may_halve: impl Fn(u32) -> bool) -> Option<Fault> {
        let places = self.places(t);
        let badness = aim.badness(places);
        if badness == 0.0 {
            return None;
        }
        let spacing = self.spacing(t);
        let (removal, addition) = (self.removal(t), self.addition(t, may_halve));
        let change = match addition {
            // As many as before, but one on the boundary: that settles it, whether there are too many or not.
            Some(Change::Land(..)) if self.length(self.longest(t)) > LONG * spacing => addition,
            _ if self.is_crowded(t) => removal.or(addition),
            _ => addition.or(removal),
        };
        Some(Fault { badness, at: (places[0] + places[1] + places[2]) / 3.0, spacing, change: change? })
    }

    /// Whether the triangles around a triangle's corners are smaller than wanted, on average.
    fn is_crowded(&self, t: usize) -> bool {
        let half_edges = &self.triangulation.half_edges;
        let around = half_edges.triangle(t).into_iter().flat_map(|v| half_edges.around(self.outgoing[v as usize])).map(|h| h as usize / 3);
        let share = |t: usize| {
            let [a, b, c] = self.places(t);
            triangle_count(0.5 * (b - a).perp_dot(c - a), self.spacing(t))
        };
        around.map(|t| share(t) - 1.0).sum::<f64>() < 0.0
    }

    fn longest(&self, t: usize) -> u32 {
        let sides = [1, 2].map(|k| 3 * t as u32 + k);
        sides.into_iter().fold(3 * t as u32, |longest, h| if self.length(h) > self.length(longest) { h } else { longest })
    }

    fn shortest(&self, t: usize) -> u32 {
        let sides = [1, 2].map(|k| 3 * t as u32 + k);
        sides.into_iter().fold(3 * t as u32, |shortest, h| if self.length(h) < self.length(shortest) { h } else { shortest })
    }

    /// An end of the shortest side goes, rather one inside than one on a rail.
    fn removal(&self, t: usize) -> Option<Change> {
        let ends = self.ends(self.shortest(t));
        let free = ends.into_iter().find(|&v| self.track(v) == Track::Free);
        let gone = free.or_else(|| ends.into_iter().find(|&v| self.track(v) != Track::Fixed))?;
        Some(Change::Remove(self.source[gone as usize]))
    }

    /// A point comes onto the longest side, if that lies on the boundary or a line or the triangle is obtuse, or else into the middle.
    fn addition(&self, t: usize, may_halve: impl Fn(u32) -> bool) -> Option<Change> {
        let longest = self.longest(t);
        let [from, to] = self.ends(longest);
        let apex = self.triangulation.half_edges.origin[prev(longest) as usize];
        let (start, end, top) = (self.at(from), self.at(to), self.at(apex));
        let is_obtuse = (start - top).dot(end - top) < 0.0;
        let points = [from, to, apex].map(|v| self.source[v as usize]);
        let edge = self.edges.get(&[points[0], points[1]]).or_else(|| self.edges.get(&[points[1], points[0]]));
        if let Some(&edge) = edge {
            let is_landing = is_obtuse && self.track(apex) == Track::Free;
            let share = if is_landing { (top - start).dot(end - start) / (end - start).length_squared() } else { 0.5 };
            let place = snap(start + share.clamp(LEAST_SHARE, 1.0 - LEAST_SHARE) * (end - start));
            let change = if is_landing { Change::Land(points[2], edge, place) } else { Change::Halve(edge, place) };
            return may_halve(self.bonds.edges[edge].rail).then_some(change);
        }
        let [a, b, c] = self.places(t);
        let place = if is_obtuse { 0.5 * (start + end) } else { a + circumcentre(b - a, c - a) };
        Some(Change::Add(snap(place), self.bonds.hints[points[0] as usize]))
    }
}
