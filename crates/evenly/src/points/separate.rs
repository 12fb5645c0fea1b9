//! Points that no triangulation can tell apart are moved apart: coincident ones, and sets that all lie on one line.

use glam::DVec2;

use super::bins::Bins;
use super::order::hilbert_order;
use super::random::Random;
use super::uniform::Uniform;
use crate::predicates::are_collinear;
use crate::space::{Domain, Space};

/// What had to be separated.
pub(crate) struct Separated {
    /// The points' Hilbert order, now that each has a place of its own.
    pub order: Vec<u32>,
    pub coincident_points: usize,
    pub was_collinear: bool,
}

/// How far points are moved at first, in hexagonal spacings.
const JITTER: f64 = 1e-3;

/// Points so near to a line, in spacings, are as good as on it, and crowded with so many in a spacing.
const NEAR_LINE: f64 = 0.1;
const CROWDED: f64 = 2.0;

/// So often another place is tried for a point that is too near to another.
const PARTINGS: usize = 20;

/// Gives every point a place of its own by a deterministic jitter, and spreads collinear points over a bounded domain.
///
/// `spacing` is the hexagonal spacing in normalised units. The first `n_fixed` points, of which no two coincide, and all others stay where they are.
pub(crate) fn separate(domain: &Domain, positions: &mut [DVec2], n_fixed: usize, spacing: f64) -> Separated {
    let was_collinear = !domain.is_periodic && are_collinear(positions);
    if was_collinear {
        let mut random = Random::new(0, 6);
        for p in &mut positions[n_fixed..] {
            *p = jitter(domain, *p, JITTER * spacing, &mut random);
        }
    }
    let (order, coincident_points) = make_distinct(domain, positions, n_fixed, spacing);
    Separated { order, coincident_points, was_collinear }
}

/// Puts points of a polygon that nearly lie on one line, of more than fit on it, anywhere in the polygon; the
/// first `n_fixed` stay. From a line the way to an even spread is longer than any run.
pub(crate) fn leave_line(space: &Space, positions: &mut [DVec2], n_fixed: usize, spacing: f64) -> bool {
    let is_left = space.region().is_some() && nearly_fill_a_line(positions, spacing);
    if is_left {
        let uniform = Uniform::new(space);
        let mut random = Random::new(0, 13);
        positions[n_fixed..].iter_mut().for_each(|p| *p = uniform.place(&mut random));
    }
    is_left
}

fn nearly_fill_a_line(points: &[DVec2], spacing: f64) -> bool {
    let [first, ..] = *points else { return false };
    let far = points.iter().copied().fold(first, |far, p| if p.distance_squared(first) > far.distance_squared(first) { p } else { far });
    let along = (far - first).normalize_or_zero();
    let is_near = |p: DVec2| (p - first).perp_dot(along).abs() <= NEAR_LINE * spacing;
    points.len() as f64 > CROWDED * (1.0 + first.distance(far) / spacing) && points.iter().all(|&p| is_near(p))
}

/// Gives every point a place of its own; returns the Hilbert order, and how many points had none.
pub(crate) fn make_distinct(domain: &Domain, positions: &mut [DVec2], n_fixed: usize, spacing: f64) -> (Vec<u32>, usize) {
    let mut random = Random::new(0, 2);
    let mut coincident_points = None;
    let mut amount = JITTER * spacing;
    loop {
        let order = hilbert_order(positions, domain.size);
        let doubles = coincident(positions, &order, n_fixed);
        let coincident_points = *coincident_points.get_or_insert(doubles.len());
        if doubles.is_empty() {
            return (order, coincident_points);
        }
        for index in doubles {
            positions[index] = jitter(domain, positions[index], amount, &mut random);
        }
        amount *= 2.0;
    }
}

/// Moves points away, by half a spacing or so, that are nearer than this part of it to one before them; those that stay do.
pub(crate) fn part(domain: &Domain, positions: &mut [DVec2], is_fixed: impl Fn(usize) -> bool, nearest: f64, spacing: f64) {
    let mut random = Random::new(0, 9);
    let mut bins = Bins::new(domain, nearest * spacing);
    let (fixed, free): (Vec<usize>, Vec<usize>) = (0..positions.len()).partition(|&k| is_fixed(k));
    fixed.into_iter().for_each(|k| bins.push(positions[k]));
    for k in free {
        for _ in 0..PARTINGS {
            let at = positions[k];
            if bins.near(at).all(|(_, way)| way.length() >= nearest * spacing || !domain.sees(at, at + way)) {
                break;
            }
            positions[k] = jitter(domain, at, 0.5 * spacing, &mut random);
        }
        bins.push(positions[k]);
    }
}

fn jitter(domain: &Domain, p: DVec2, amount: f64, random: &mut Random) -> DVec2 {
    let x = random.signed();
    domain.walk(p, p + amount * DVec2::new(x, random.signed()))
}

/// All points but one at each place that is taken more than once: but the first there, or the fixed one.
fn coincident(positions: &[DVec2], order: &[u32], n_fixed: usize) -> Vec<usize> {
    let pairs = order.windows(2).map(|pair| [pair[0] as usize, pair[1] as usize]);
    let doubles = pairs.filter(|&[earlier, later]| positions[earlier] == positions[later]);
    doubles.map(|[earlier, later]| if later < n_fixed { earlier } else { later }).collect()
}
