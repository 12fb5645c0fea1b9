//! [`Neighbours`]: places on a surface, and which of them are near a place, by ways along the surface.

use glam::DVec3;

use super::walk::{Place, nearest_in_triangle};
use super::{Surface, morton};
use crate::triangulation::BOUNDARY;

/// A place, and the normal of its triangle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spot {
    pub face: u32,
    at: DVec3,
    normal: DVec3,
}

impl Spot {
    pub fn new(surface: &Surface, place: &Place) -> Self {
        Self { face: place.face, at: place.at, normal: surface.normals[place.face as usize] }
    }

    /// About how long the way along the surface is, from the chord and both normals: exact in planes, and on fine spheres (Bowers, Wang, Wei and Maletz, "Parallel Poisson
    /// Disk Sampling with Spectrum Analysis on Surfaces", ACM Transactions on Graphics 29(6), 2010, doi 10.1145/1866158.1866188).
    pub fn distance(&self, other: &Self) -> f64 {
        const ALIKE: f64 = 1e-6;
        let chord = other.at - self.at;
        let length = chord.length();
        if length == 0.0 {
            return 0.0;
        }
        let [c, d] = [self.normal, other.normal].map(|normal| (normal.dot(chord) / length).clamp(-1.0, 1.0));
        if (c - d).abs() < ALIKE { length / (1.0 - c * c).max(ALIKE).sqrt() } else { length * (libm::asin(c) - libm::asin(d)) / (c - d) }
    }
}

/// So many spots lie side by side in a run.
const RUN: usize = 16;

/// Spots of one triangle, and a ball that holds them.
struct Run {
    begin: usize,
    end: usize,
    centre: DVec3,
    radius: f64,
}

/// Places by the triangles in which they lie.
pub(super) struct Neighbours<'a> {
    surface: &'a Surface,
    pub spots: &'a [Spot],
    /// The spots in the order of their triangles, and along a curve in each.
    order: Vec<u32>,
    runs: Vec<Run>,
    /// Where the runs of each triangle begin.
    begin: Vec<usize>,
}

/// What a search has seen: room that is used again.
pub(super) struct Seen {
    round: u32,
    rounds: Vec<u32>,
    stack: Vec<u32>,
}

impl Seen {
    pub fn new(surface: &Surface) -> Self {
        Self { round: 0, rounds: vec![0; surface.n_triangles()], stack: Vec::new() }
    }
}

impl<'a> Neighbours<'a> {
    pub fn new(surface: &'a Surface, spots: &'a [Spot]) -> Self {
        let spot = |&spot: &u32| &spots[spot as usize];
        let mut order: Vec<u32> = (0..spots.len() as u32).collect();
        order.sort_by_cached_key(|k| (spot(k).face, morton(spot(k).at)));
        let mut runs = Vec::new();
        let mut begin = Vec::with_capacity(surface.n_triangles() + 1);
        let mut next = 0;
        for face in 0..surface.n_triangles() as u32 {
            begin.push(runs.len());
            let end = next + order[next..].partition_point(|k| spot(k).face == face);
            while next < end {
                let members = &order[next..end.min(next + RUN)];
                let centre = members.iter().map(|k| spot(k).at).sum::<DVec3>() / members.len() as f64;
                let radius = members.iter().map(|k| spot(k).at.distance(centre)).fold(0.0, f64::max);
                runs.push(Run { begin: next, end: next + members.len(), centre, radius });
                next += members.len();
            }
        }
        begin.push(runs.len());
        Self { surface, spots, order, runs, begin }
    }

    /// Shows the number of each place nearer than `reach`, and how far it is; itself too, if it is among them. Only what hangs together within the ball of that radius is near.
    pub fn visit(&self, from: &Spot, reach: f64, seen: &mut Seen, mut show: impl FnMut(usize, f64)) {
        self.search(from, reach, seen, |k, distance| {
            show(k, distance);
            reach
        });
    }

    /// The same with a reach that shrinks: what is shown answers how far is near from then on.
    pub fn search(&self, from: &Spot, mut reach: f64, seen: &mut Seen, mut show: impl FnMut(usize, f64) -> f64) {
        seen.round += 1;
        seen.rounds[from.face as usize] = seen.round;
        seen.stack.push(from.face);
        while let Some(face) = seen.stack.pop() {
            let runs = &self.runs[self.begin[face as usize]..self.begin[face as usize + 1]];
            for run in runs {
                if run.centre.distance(from.at) >= reach + run.radius {
                    continue;
                }
                for &spot in &self.order[run.begin..run.end] {
                    let distance = from.distance(&self.spots[spot as usize]);
                    if distance < reach {
                        reach = show(spot as usize, distance);
                    }
                }
            }
            for h in 3 * face..3 * face + 3 {
                let twin = self.surface.half_edges.twin[h as usize];
                if twin == BOUNDARY || seen.rounds[twin as usize / 3] == seen.round {
                    continue;
                }
                seen.rounds[twin as usize / 3] = seen.round;
                let (nearest, _) = nearest_in_triangle(self.surface.corners(twin as usize / 3), from.at);
                if nearest.distance_squared(from.at) < reach * reach {
                    seen.stack.push(twin / 3);
                }
            }
        }
    }
}
