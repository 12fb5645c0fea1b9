//! The first points inside: one at random in each of so many pieces of equal mass, where mass counts the
//! points that the spacing asks for. Points on segments have their share of it: next to them comes none.

use glam::DVec2;

use crate::geometry::spacing::hexagonal_count;
use crate::points::Random;
use crate::predicates::is_left_turn;
use crate::space::{SegmentTree, snap};
use crate::triangulation::Sizing;

/// Points, and the triangle of the sizing in which each lies.
#[derive(Debug, Default)]
pub(super) struct Scattered {
    pub points: Vec<DVec2>,
    pub hints: Vec<u32>,
}

/// A triangle, and the spacings at its corners.
type Piece = [(DVec2, f64); 3];

/// How much a piece counts: the points a hexagonal lattice has there.
fn mass(piece: &Piece) -> f64 {
    let [(a, of_a), (b, of_b), (c, of_c)] = *piece;
    let size = (of_a + of_b + of_c) / 3.0;
    hexagonal_count(0.5 * (b - a).perp_dot(c - a), size)
}

/// Pieces are no larger than this many points, far from segments and near them.
const LARGEST: f64 = 0.25;
const LARGEST_NEAR: f64 = 0.04;
/// Nearer to a segment than this, in spacings, comes no point; up to the next distance there are more
/// than elsewhere, by so much that along a straight segment the points on it make up for what is missing:
/// they stand for a strip of half a row, which is `sqrt(3) / 4` wide.
const NEAREST: f64 = 0.5;
const NEAR: f64 = 0.9;
const DENSER: f64 = (NEAR - 0.433_012_701_892_219_3) / (NEAR - NEAREST);
/// Points keep off the sides of their piece by this part of it.
const MARGIN: f64 = 0.02;

/// No more than the mass, found at once.
pub(super) fn least_mass(sizing: &Sizing) -> f64 {
    let of = |t: usize| {
        let piece = whole(sizing, t);
        let coarsest = piece.iter().map(|&(_, size)| size).fold(0.0, f64::max);
        mass(&piece.map(|(corner, _)| (corner, coarsest)))
    };
    (0..sizing.half_edges.n_triangles()).map(of).sum()
}

/// The mass of all pieces, cut small: that of a triangle depends on how finely it is looked at.
pub(super) fn total_mass(sizing: &Sizing) -> f64 {
    let mut total = 0.0;
    for t in 0..sizing.half_edges.n_triangles() {
        cut(whole(sizing, t), LARGEST, &mut |piece| total += mass(piece));
    }
    total
}

/// Scatters points over the sizing's domain, between segments on which points stand already.
pub(super) fn scatter(sizing: &Sizing, segments: &SegmentTree, random: &mut Random) -> Scattered {
    let mut scattered = Scattered::default();
    // A point comes where the mass passes the next whole number and a random part of one.
    let (mut passed, mut next) = (0.0, random.unit());
    for t in 0..sizing.half_edges.n_triangles() {
        let mut add = |piece: &Piece, weight: f64| {
            passed += weight * mass(piece);
            if passed > next {
                let k = next.floor();
                next = k + 1.0 + random.unit();
                let p = within(piece, random);
                let [a, b, c] = sizing.half_edges.triangle(t).map(|v| sizing.positions[v as usize]);
                let is_inside = [(a, b), (b, c), (c, a)].into_iter().all(|(from, to)| is_left_turn(to - from, p - from));
                if is_inside {
                    scattered.points.push(p);
                    scattered.hints.push(t as u32);
                }
            }
        };
        cut(whole(sizing, t), LARGEST, &mut |piece| {
            if distance(piece, segments) > NEAR + 0.5 {
                add(piece, 1.0);
                return;
            }
            cut(*piece, LARGEST_NEAR, &mut |piece| match distance(piece, segments) {
                near if near < NEAREST => {}
                near if near < NEAR => add(piece, DENSER),
                _ => add(piece, 1.0),
            });
        });
    }
    scattered
}

/// How far the middle of a piece is from the nearest segment, in spacings, if that is near.
fn distance(piece: &Piece, segments: &SegmentTree) -> f64 {
    let (sum, of_all) = piece.iter().fold((DVec2::ZERO, 0.0), |(sum, of_all), &(corner, size)| (sum + corner, of_all + size));
    let spacing = of_all / 3.0;
    segments.distance(sum / 3.0, (NEAR + 1.0) * spacing) / spacing
}

fn whole(sizing: &Sizing, t: usize) -> Piece {
    sizing.half_edges.triangle(t).map(|v| (sizing.positions[v as usize], sizing.sizes[v as usize]))
}

/// Halves a piece along its longest side until it is small.
fn cut(piece: Piece, largest: f64, visit: &mut impl FnMut(&Piece)) {
    if mass(&piece) <= largest {
        visit(&piece);
        return;
    }
    let side = |k: usize| piece[(k + 1) % 3].0.distance_squared(piece[(k + 2) % 3].0);
    let k = (0..3).max_by(|&a, &b| side(a).total_cmp(&side(b))).unwrap_or(0);
    let [apex, from, to] = [piece[k], piece[(k + 1) % 3], piece[(k + 2) % 3]];
    let middle = (0.5 * (from.0 + to.0), 0.5 * (from.1 + to.1));
    cut([apex, from, middle], largest, visit);
    cut([apex, middle, to], largest, visit);
}

/// A random place in a piece.
fn within(piece: &Piece, random: &mut Random) -> DVec2 {
    let (mut s, mut t) = (random.unit(), random.unit());
    if s + t > 1.0 {
        (s, t) = (1.0 - s, 1.0 - t);
    }
    let [a, b, c] = piece.map(|(corner, _)| corner);
    let p = a + s * (b - a) + t * (c - a);
    snap(p + MARGIN * ((a + b + c) / 3.0 - p))
}
