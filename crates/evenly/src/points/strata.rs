//! Pieces of a polygon along the Hilbert curve: runs of them with equal areas are what a jittered grid has as cells.

use glam::DVec2;

use super::order::hilbert_order;
use super::random::Random;
use super::uniform::{area, place_in};
use crate::space::{Domain, Region};

/// The largest piece, in areas of a point.
const LARGEST: f64 = 0.5;

/// One place in each of `n_points` strata.
pub(super) fn places(region: &Region, domain: &Domain, n_points: usize, random: &mut Random) -> Vec<DVec2> {
    let total: f64 = region.triangles().iter().map(area).sum();
    let mut pieces = Vec::new();
    // Part by part, so that each has as many points as it should, to within one.
    for part in region.parts() {
        let mut of_part = Vec::new();
        part.iter().for_each(|&triangle| cut(triangle, LARGEST * total / n_points as f64, &mut of_part));
        let centres: Vec<DVec2> = of_part.iter().map(|[a, b, c]| (a + b + c) / 3.0).collect();
        pieces.extend(hilbert_order(&centres, domain.size).into_iter().map(|k| of_part[k as usize]));
    }
    let total: f64 = pieces.iter().map(area).sum();
    let mut along = pieces.iter();
    let (mut passed, mut piece) = (0.0, along.next());
    let mut places = Vec::with_capacity(n_points);
    for k in 0..n_points {
        let at = (k as f64 + random.unit()) / n_points as f64 * total;
        while let Some(here) = piece
            && passed + area(here) < at
        {
            let Some(after) = along.next() else { break };
            passed += area(here);
            piece = Some(after);
        }
        places.extend(piece.map(|piece| place_in(piece, domain, random)));
    }
    places
}

/// Halves a triangle along its longest side until it is small.
fn cut(triangle: [DVec2; 3], largest: f64, pieces: &mut Vec<[DVec2; 3]>) {
    if area(&triangle) <= largest {
        pieces.push(triangle);
        return;
    }
    let side = |k: usize| triangle[(k + 1) % 3].distance_squared(triangle[(k + 2) % 3]);
    let k = (0..3).max_by(|&a, &b| side(a).total_cmp(&side(b))).unwrap_or(0);
    let [apex, from, to] = [triangle[k], triangle[(k + 1) % 3], triangle[(k + 2) % 3]];
    let middle = 0.5 * (from + to);
    cut([apex, from, middle], largest, pieces);
    cut([apex, middle, to], largest, pieces);
}
