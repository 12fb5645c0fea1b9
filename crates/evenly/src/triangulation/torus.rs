//! The exact Delaunay triangulation on a torus: one of the plane, of the points and a halo of copies, cut out and glued.
//!
//! A triangle is taken from the place where its smallest vertex is no copy. If these triangles fit together at the seam, use every
//! point, satisfy Euler's formula and are all turned the right way, they triangulate the torus, however they were found; Lawson's
//! flips, decided by exact predicates, then make them Delaunay. So the halo and the plane's triangulation need no trust. Where
//! they do not fit, the halo grows, up to a whole period, where every triangle at an original point is present: a
//! Delaunay edge spans at most one period along each axis, since a chord of an empty circle is no longer than a period.
//!
//! Where edges are so long that the shortest image of one is not unique (few points, big voids), the result is that of a finite
//! cover: the torus laid side by side with itself. Where even exact triangles do not fit, because cocircular points were cut
//! differently on the two sides of the seam, all points are jittered by a few grid units.

use glam::{DVec2, IVec2};
use rayon::prelude::*;

use super::half_edges::{BOUNDARY, HalfEdges, smallest};
use super::mesh::Triangulation;
use super::plane;
use crate::error::Error;
use crate::points::Random;
use crate::predicates::is_left_turn;
use crate::space::{Domain, GRID};

/// The halo's first width, in mean spacings: enough for a million random points.
const HALO: f64 = 5.0;
/// The smallest ratio of a period to the longest edge: less than 1/2 after two triangles join in a flip.
const PERIOD_TO_EDGE: f64 = 4.0;
/// Jitters tried before giving up, each twice as wide as the one before.
const MAX_JITTERS: u32 = 12;

/// Delaunay-triangulates distinct points of the periodic `domain`, given in Hilbert order.
pub(super) fn delaunay(domain: &Domain, points: &[DVec2], order: Vec<u32>) -> Result<Triangulation, Error> {
    let mut base = points.to_vec();
    let mut halo = HALO * (domain.area() / points.len() as f64).sqrt();
    let mut is_exact = false;
    let mut n_jitters = 0;
    loop {
        let is_whole_period = halo >= domain.size.max_element();
        if let Some((half_edges, copies)) = glue(domain, &base, DVec2::splat(halo).min(domain.size), is_exact) {
            let positions = cover(domain, &base, copies);
            let mut triangulation = Triangulation { half_edges, positions, domain: domain.covered(copies), copies, order };
            triangulation.legalize();
            return Ok(triangulation);
        }
        if !is_whole_period {
            halo *= 3.0;
        } else if !is_exact {
            is_exact = true;
        } else if n_jitters < MAX_JITTERS {
            base = jittered(domain, points, n_jitters);
            n_jitters += 1;
        } else {
            return Err(Error::Degenerate("the points are too degenerate to triangulate on a torus".into()));
        }
    }
}

/// The points of all copies of the base domain.
pub(crate) fn cover(domain: &Domain, base: &[DVec2], copies: [u32; 2]) -> Vec<DVec2> {
    let shifts = (0..copies[1]).flat_map(|j| (0..copies[0]).map(move |i| DVec2::new(f64::from(i), f64::from(j))));
    shifts.flat_map(|shift| base.iter().map(move |&p| p + shift * domain.size)).collect()
}

fn jittered(domain: &Domain, points: &[DVec2], attempt: u32) -> Vec<DVec2> {
    let mut random = Random::new(u64::from(attempt), 3);
    let amount = GRID * f64::from(16u32 << attempt);
    let mut move_one = |p: DVec2| {
        let x = random.signed();
        domain.land(p + amount * DVec2::new(x, random.signed()))
    };
    points.iter().map(|&p| move_one(p)).collect()
}

/// Triangulates the plane around the domain, exactly if asked, and joins what lies on the two sides of the seam; on a cover where edges are
/// long. `None` where the triangles do not fit together: the halo is too narrow, or the triangulation not exact enough.
fn glue(domain: &Domain, points: &[DVec2], halo: DVec2, is_exact: bool) -> Option<(HalfEdges, [u32; 2])> {
    let n = points.len() as u32;
    let copies = halo_copies(domain, points, halo);
    let base = |v: u32| if v < n { v } else { copies[(v - n) as usize].base };
    let shift = |v: u32| if v < n { IVec2::ZERO } else { copies[(v - n) as usize].shift };
    let place = |points: &[DVec2], v: u32| points[base(v) as usize] + shift(v).as_dvec2() * domain.size;
    let position = |v: u32| place(points, v);
    let all = 0..n + copies.len() as u32;
    let plane = if is_exact {
        // A jitter may have brought points together; the next one will not.
        plane::delaunay(all.map(position)).ok()?
    } else {
        let shaken = plane::shaken(domain, points);
        plane::nearly_delaunay(all.map(|v| place(&shaken, v)))
    };

    // A triangle is ours where its smallest vertex is no copy.
    let mut ours = plane.filtered(|_, corners| {
        let first = first_corner(corners.map(base));
        (corners[first] < n).then_some(first)
    });
    drop(plane);
    // The torus has as many edges as vertices and triangles together: F = 2 V.
    if ours.n_triangles() != 2 * points.len() {
        return None;
    }
    let shape = |corners: &[u32]| {
        let [a, b, c] = [corners[0], corners[1], corners[2]].map(position);
        let extent = (b - a).abs().max((c - a).abs()).max((c - b).abs());
        (extent, is_left_turn(b - a, c - a))
    };
    let joined = |a: (DVec2, bool), b: (DVec2, bool)| (a.0.max(b.0), a.1 && b.1);
    let (extent, are_turned_right) = ours.origin.par_chunks_exact(3).map(shape).reduce(|| (DVec2::ZERO, true), joined);
    if !are_turned_right {
        return None;
    }
    let n_copies = (extent * PERIOD_TO_EDGE / domain.size).ceil().max(DVec2::ONE).as_uvec2().to_array();
    if n_copies == [1, 1] {
        ours.origin.iter_mut().for_each(|v| *v = base(*v));
    } else {
        ours = unrolled(&ours, n, n_copies, |v| (base(v), shift(v)));
    }
    close(&mut ours).then_some((ours, n_copies))
}

/// The corner with which a triangle begins: that of its smallest vertex, or, where two are copies of one, of the smallest sequence.
fn first_corner(base: [u32; 3]) -> usize {
    let turned = |k: usize| [base[k], base[(k + 1) % 3], base[(k + 2) % 3]];
    let first = smallest(base);
    if base.iter().filter(|&&v| v == base[first]).count() == 1 { first } else { (0..3).min_by_key(|&k| turned(k)).unwrap_or(first) }
}

/// The triangles of a cover, not joined yet: each of `ours` in every copy of the domain.
fn unrolled(ours: &HalfEdges, n: u32, copies: [u32; 2], place: impl Fn(u32) -> (u32, IVec2)) -> HalfEdges {
    let size = IVec2::new(copies[0] as i32, copies[1] as i32);
    let mut origin = Vec::with_capacity(ours.origin.len() * (copies[0] * copies[1]) as usize);
    for at in (0..size.y).flat_map(|y| (0..size.x).map(move |x| IVec2::new(x, y))) {
        origin.extend(ours.origin.iter().map(|&v| {
            let (base, shift) = place(v);
            let copy = (at + shift).rem_euclid(size);
            base + n * (copy.x + size.x * copy.y) as u32
        }));
    }
    let twin = vec![BOUNDARY; origin.len()];
    HalfEdges { origin, twin }.filtered(|_, t| Some(smallest(t)))
}

/// Joins boundaries that have the same ends; false if some boundary is left.
fn close(mesh: &mut HalfEdges) -> bool {
    let mut seam: Vec<(u32, u32, u32)> = (0..mesh.origin.len() as u32)
        .filter(|&h| mesh.is_boundary(h))
        .map(|h| {
            let (u, v) = (mesh.origin[h as usize], mesh.target(h));
            (u.min(v), u.max(v), h)
        })
        .collect();
    seam.sort_unstable();
    seam.chunks(2).all(|pair| {
        let &[(u, v, h), (w, x, t)] = pair else { return false };
        mesh.twin[h as usize] = t;
        mesh.twin[t as usize] = h;
        (u, v) == (w, x) && mesh.origin[h as usize] == mesh.target(t)
    })
}

/// A copy of a point in the halo.
struct Copy {
    base: u32,
    /// By how many periods along each axis.
    shift: IVec2,
}

/// The copies of points in the halo around the domain.
fn halo_copies(domain: &Domain, points: &[DVec2], halo: DVec2) -> Vec<Copy> {
    let (low, high) = (-halo, domain.size + halo);
    let mut copies = Vec::new();
    for (base, &p) in (0..).zip(points) {
        if p.cmpgt(halo).all() && p.cmplt(domain.size - halo).all() {
            continue;
        }
        for shift in (-1..=1).flat_map(|y| (-1..=1).map(move |x| IVec2::new(x, y))) {
            let q = p + shift.as_dvec2() * domain.size;
            if shift != IVec2::ZERO && q.cmpge(low).all() && q.cmple(high).all() {
                copies.push(Copy { base, shift });
            }
        }
    }
    copies
}
