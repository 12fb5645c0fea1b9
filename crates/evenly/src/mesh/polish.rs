//! The last bad triangles: their vertices try places nearby, and stay where the triangles around are better. No edge is flipped.

use glam::DVec2;

use super::aim::Aim;
use super::settled::Settled;
use crate::points::Random;
use crate::space::snap;
use crate::triangulation::{HalfEdges, Track, next, prev};

/// Rounds over what is bad, and places that each vertex tries in one.
const ROUNDS: usize = 60;
const TRIES: usize = 6;
/// How far away these are at first and in the last round, in spacings.
const FARTHEST: f64 = 0.15;
const NEAREST: f64 = 0.002;
/// No triangle becomes flatter than this, in squares of spacings, twice its area.
const LEAST_AREA: f64 = 1e-6;

/// Makes bad triangles better.
pub(super) fn polish(settled: &mut Settled, rails: &[[DVec2; 2]], aim: &Aim, seed: u64) {
    let mut random = Random::new(seed, 12);
    let half_edges = &settled.triangulation.half_edges;
    let outgoing = half_edges.outgoing(settled.tracks.len());
    for round in 0..ROUNDS {
        let positions = &mut settled.triangulation.positions;
        let bad: Vec<[u32; 3]> = half_edges.triangles().filter(|t| aim.badness(t.map(|v| positions[v as usize])) > 0.0).collect();
        if bad.is_empty() {
            break;
        }
        // Whoever is next to a bad triangle may give way.
        let mut movers: Vec<u32> = bad.iter().flatten().flat_map(|&v| ring(half_edges, outgoing[v as usize]).flatten()).collect();
        movers.sort_unstable();
        movers.dedup();
        let reach = FARTHEST * libm::pow(NEAREST / FARTHEST, round as f64 / (ROUNDS - 1) as f64);
        for v in movers {
            let from = positions[v as usize];
            let least_area = LEAST_AREA * settled.sizes[v as usize].powi(2);
            let cost = |p: DVec2, positions: &[DVec2]| -> f64 {
                ring(half_edges, outgoing[v as usize])
                    .map(|rim| rim.map(|other| positions[other as usize]))
                    .map(|[a, b]| if (a - p).perp_dot(b - p) > least_area { aim.badness([p, a, b]) } else { f64::INFINITY })
                    .sum()
            };
            let mut least = cost(from, positions);
            for _ in 0..TRIES {
                let by = reach * settled.sizes[v as usize] * DVec2::new(random.signed(), random.signed());
                let at = positions[v as usize];
                let place = match settled.tracks[v as usize] {
                    Track::Free => snap(at + by),
                    Track::Rail(rail) => {
                        let [start, end] = rails[rail as usize];
                        let way = end - start;
                        snap(start + way * ((at + by - start).dot(way) / way.length_squared()).clamp(0.0, 1.0))
                    }
                    Track::Fixed => continue,
                };
                let found = cost(place, positions);
                if found < least {
                    (least, positions[v as usize]) = (found, place);
                }
            }
        }
    }
}

/// For each triangle around a vertex, which `outgoing` leaves, the ends of the side across.
fn ring(half_edges: &HalfEdges, outgoing: u32) -> impl Iterator<Item = [u32; 2]> {
    half_edges.around(outgoing).map(|h| [half_edges.origin[next(h) as usize], half_edges.origin[prev(h) as usize]])
}
