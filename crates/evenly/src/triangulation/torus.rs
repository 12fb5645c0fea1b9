//! The exact Delaunay triangulation on a torus: one of the plane, of the points and a halo of copies, cut out and glued.
//!
//! A triangle is taken from the place where its smallest vertex is no copy. If these triangles fit together at the seam, use every
//! point, satisfy Euler's formula and are all turned the right way, they triangulate the torus, however they were found; Lawson's
//! flips, decided by exact predicates, then make them Delaunay. So the halo and the plane's triangulation need no trust. Where
//! they do not fit, the halo grows, up to a whole period, where every triangle at an original point is present: a
//! Delaunay edge spans at most one period along each axis, since a chord of an empty circle is no longer than a period.
//!
//! Where edges are so long that the shortest image of one is not unique (few points, big voids), a finite cover is triangulated
//! instead: the torus laid side by side with itself. Where even exact triangles do not fit, because cocircular points were cut
//! differently on the two sides of the seam, all points are jittered by a few grid units.

use glam::{DVec2, IVec2};
use rayon::prelude::*;

use super::half_edges::{HalfEdges, smallest};
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

/// Why a triangulation of the plane could not be glued.
enum Misfit {
    /// The halo is too narrow, or the triangulation not exact enough.
    Seam,
    /// The extent of the longest edge along each axis.
    EdgesTooLong(DVec2),
}

/// Delaunay-triangulates distinct points of the periodic `domain`, given in Hilbert order.
pub(super) fn delaunay(domain: &Domain, points: &[DVec2], order: Vec<u32>) -> Result<Triangulation, Error> {
    let mut base = points.to_vec();
    let mut copies = [1, 1];
    let mut halo = HALO * (domain.area() / points.len() as f64).sqrt();
    let mut is_exact = false;
    let mut n_jitters = 0;
    loop {
        let covered = domain.covered(copies);
        let positions = cover(domain, &base, copies);
        let is_whole_period = halo >= covered.size.max_element();
        match glue(&covered, &positions, DVec2::splat(halo).min(covered.size), is_exact) {
            Ok(half_edges) => {
                let mut triangulation = Triangulation { half_edges, positions, domain: covered, copies, order };
                triangulation.legalize();
                return Ok(triangulation);
            }
            Err(Misfit::EdgesTooLong(extent)) => {
                let needed = (extent * PERIOD_TO_EDGE / domain.size).ceil();
                copies = [copies[0].max(needed.x as u32), copies[1].max(needed.y as u32)];
            }
            Err(Misfit::Seam) if !is_whole_period => halo *= 3.0,
            Err(Misfit::Seam) if !is_exact => is_exact = true,
            Err(Misfit::Seam) if n_jitters < MAX_JITTERS => {
                base = jittered(domain, points, n_jitters);
                n_jitters += 1;
            }
            Err(Misfit::Seam) => {
                return Err(Error::Degenerate("the points are too degenerate to triangulate on a torus".into()));
            }
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

/// Triangulates the plane around the domain, exactly if asked, and joins what lies on the two sides of the seam.
fn glue(domain: &Domain, points: &[DVec2], halo: DVec2, is_exact: bool) -> Result<HalfEdges, Misfit> {
    let n = points.len() as u32;
    let copies = halo_copies(domain, points, halo);
    let position = |v: u32| if v < n { points[v as usize] } else { copies[(v - n) as usize].0 };
    let base = |v: u32| if v < n { v } else { copies[(v - n) as usize].1 };
    let all = points.iter().copied().chain(copies.iter().map(|c| c.0));
    // A jitter may have brought points together; the next one will not.
    let plane = if is_exact { plane::delaunay(all).map_err(|_| Misfit::Seam)? } else { plane::nearly_delaunay(all) };

    // A triangle is ours where its smallest vertex is no copy.
    let mut ours = plane.filtered(|corners| {
        let first = smallest(corners.map(base));
        (corners[first] < n).then_some(first)
    });
    drop(plane);
    let shape = |corners: &[u32]| {
        let [a, b, c] = [corners[0], corners[1], corners[2]].map(position);
        let extent = (b - a).abs().max((c - a).abs()).max((c - b).abs());
        (extent, is_left_turn(b - a, c - a))
    };
    let joined = |a: (DVec2, bool), b: (DVec2, bool)| (a.0.max(b.0), a.1 && b.1);
    let (extent, are_turned_right) = ours.origin.par_chunks_exact(3).map(shape).reduce(|| (DVec2::ZERO, true), joined);
    for v in &mut ours.origin {
        *v = base(*v);
    }
    // The torus has as many edges as vertices and triangles together: F = 2 V.
    let fits = are_turned_right && ours.n_triangles() == 2 * points.len() && close(&mut ours);
    let is_too_long = (extent * PERIOD_TO_EDGE).cmpgt(domain.size).any();
    match (fits, is_too_long) {
        (true, false) => Ok(ours),
        (false, true) if halo != domain.size => Err(Misfit::Seam),
        (_, true) => Err(Misfit::EdgesTooLong(extent)),
        (false, false) => Err(Misfit::Seam),
    }
}

/// Joins borders that have the same ends; false if some border is left.
fn close(mesh: &mut HalfEdges) -> bool {
    let mut seam: Vec<(u32, u32, u32)> = (0..mesh.origin.len() as u32)
        .filter(|&h| mesh.is_border(h))
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

/// The copies of points in the halo around the domain, with the points that they are copies of.
fn halo_copies(domain: &Domain, points: &[DVec2], halo: DVec2) -> Vec<(DVec2, u32)> {
    let (low, high) = (-halo, domain.size + halo);
    let mut copies = Vec::new();
    for (i, &p) in points.iter().enumerate() {
        if p.cmpgt(halo).all() && p.cmplt(domain.size - halo).all() {
            continue;
        }
        for shift in (-1..=1).flat_map(|y| (-1..=1).map(move |x| IVec2::new(x, y))) {
            let q = p + shift.as_dvec2() * domain.size;
            if shift != IVec2::ZERO && q.cmpge(low).all() && q.cmple(high).all() {
                copies.push((q, i as u32));
            }
        }
    }
    copies
}
