//! How far two surfaces are from each other, as Metro measures it: from many places of one to the nearest of the other.
//!
//! Cignoni, Rocchini and Scopigno, "Metro: Measuring Error on Simplified Surfaces", Computer Graphics Forum 17(2), 1998, doi 10.1111/1467-8659.00236.
//! Places are spread over each triangle by a low-discrepancy sequence, with one seed for all, and all vertices count for the largest distance.

use glam::DVec3;
use rayon::prelude::*;
use serde::Serialize;

use super::Surface;
use super::bvh::{Bounds, Bvh};
use super::walk::nearest_in_triangle;

/// Places on each surface, and on each triangle, at least.
const PLACES: f64 = 50_000.0;
const PLACES_A_TRIANGLE: usize = 3;
/// Triangles, or vertices, that one thread looks at in turn: fixed, so that the bits do not depend on the threads.
const CHUNK: usize = 128;

/// Distances between a surface and a reference, in input units.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SurfaceDistance {
    /// Root mean square, from the surface to the reference.
    pub rms_to_reference: f64,
    /// The largest, from the surface to the reference.
    pub max_to_reference: f64,
    /// Root mean square, from the reference to the surface.
    pub rms_from_reference: f64,
    /// The largest, from the reference to the surface: large where parts of the reference are not reached.
    pub max_from_reference: f64,
    /// Triangles of the surface that face the other way than the reference does there.
    pub flipped_triangles: usize,
    /// The place on the reference from which it is so far.
    pub farthest_place: [f64; 3],
    /// The larger of both root mean squares, as a part of the reference's diagonal.
    pub rms: f64,
    /// The Hausdorff distance, the larger of both largest, as a part of the reference's diagonal.
    pub hausdorff: f64,
}

/// Measures both ways.
pub fn surface_distance(surface: &Surface, reference: &Surface) -> SurfaceDistance {
    let Way { rms: rms_to_reference, farthest: max_to_reference, .. } = one_way(surface, reference);
    let Way { rms: rms_from_reference, farthest: max_from_reference, place } = one_way(reference, surface);
    let diagonal = reference.diagonal();
    SurfaceDistance {
        rms_to_reference,
        max_to_reference,
        rms_from_reference,
        max_from_reference,
        flipped_triangles: flipped_triangles(surface, reference),
        farthest_place: place,
        rms: rms_to_reference.max(rms_from_reference) / diagonal,
        hausdorff: max_to_reference.max(max_from_reference) / diagonal,
    }
}

/// Triangles among which the nearest to a place is found.
pub(crate) struct Facets {
    corners: Vec<[DVec3; 3]>,
    tree: Bvh,
}

impl Facets {
    pub fn new(corners: Vec<[DVec3; 3]>) -> Self {
        let bounds: Vec<Bounds> = corners.iter().map(|corners| Bounds::of(corners)).collect();
        Self { tree: Bvh::new(&bounds), corners }
    }

    /// The nearest triangle, and how far it is.
    pub fn nearest(&self, p: DVec3) -> Option<(usize, f64)> {
        let distance_squared = |t: u32| self.distance_squared(t, p);
        self.tree.nearest(p, f64::INFINITY, distance_squared).map(|(t, distance)| (t as usize, distance.sqrt()))
    }

    /// The square of the distance to the nearest triangle, which then replaces the guess: found soon where the guess is near.
    fn nearest_squared(&self, p: DVec3, guess: &mut u32) -> f64 {
        let most = self.distance_squared(*guess, p);
        let nearer = self.tree.nearest(p, most, |t| self.distance_squared(t, p));
        *guess = nearer.map_or(*guess, |(t, _)| t);
        nearer.map_or(most, |(_, squared)| squared)
    }

    fn distance_squared(&self, t: u32, p: DVec3) -> f64 {
        nearest_in_triangle(self.corners[t as usize], p).0.distance_squared(p)
    }
}

/// What is found on the way from one surface to another.
struct Way {
    /// The root mean square of the distances, weighted by area.
    rms: f64,
    farthest: f64,
    /// Where it is so far.
    place: [f64; 3],
}

fn one_way(from: &Surface, to: &Surface) -> Way {
    let facets = Facets::new((0..to.n_triangles()).map(|t| to.corners(t)).collect());
    let distance_squared = |p: DVec3, guess: &mut u32| facets.nearest_squared(to.frame.inward(from.frame.outward(p)), guess);
    let density = PLACES / from.inner_area();
    let of_triangle = |guess: &mut u32, t: usize| {
        let [a, b, c] = from.corners(t);
        let area = 0.5 * (b - a).cross(c - a).length();
        let n = ((area * density).ceil() as usize).max(PLACES_A_TRIANGLE);
        let places = (0..n).map(|k| {
            let [u, v] = quasi_random(k);
            let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            a + u * (b - a) + v * (c - a)
        });
        // The sum of the squares, and the largest of them with its place.
        let (sum, most) = places.fold((0.0, (-1.0, DVec3::ZERO)), |(sum, most), p| {
            let distance = distance_squared(p, guess);
            (sum + distance, if distance > most.0 { (distance, p) } else { most })
        });
        (area, sum / n as f64 * area, most)
    };
    let n = from.n_triangles();
    let of_chunk = |chunk: usize| {
        let mut guess = 0;
        (CHUNK * chunk..n.min(CHUNK * (chunk + 1))).map(|t| of_triangle(&mut guess, t)).collect::<Vec<_>>()
    };
    let triangles: Vec<(f64, f64, (f64, DVec3))> = (0..n.div_ceil(CHUNK)).into_par_iter().flat_map_iter(of_chunk).collect();
    let of_points = |points: &[DVec3]| {
        let mut guess = 0;
        points.iter().map(|&p| (distance_squared(p, &mut guess), p)).collect::<Vec<_>>()
    };
    let vertices: Vec<(f64, DVec3)> = from.points.par_chunks(CHUNK).flat_map_iter(of_points).collect();
    let (area, sum) = triangles.iter().fold((0.0, 0.0), |(area, sum), t| (area + t.0, sum + t.1));
    let all = vertices.into_iter().chain(triangles.into_iter().map(|t| t.2));
    let (farthest, place) = all.fold((0.0, DVec3::ZERO), |best, other| if other.0 > best.0 { other } else { best });
    let outward = |squared: f64| to.frame.length_outward(squared.sqrt());
    Way { rms: outward(sum / area), farthest: outward(farthest), place: from.frame.outward(place) }
}

fn flipped_triangles(surface: &Surface, reference: &Surface) -> usize {
    let facets = Facets::new((0..reference.n_triangles()).map(|t| reference.corners(t)).collect());
    let is_flipped = |&t: &usize| {
        let [a, b, c] = surface.corners(t);
        let middle = reference.frame.inward(surface.frame.outward((a + b + c) / 3.0));
        facets.nearest(middle).is_some_and(|(nearest, _)| reference.normals[nearest].dot(surface.normals[t]) < 0.0)
    };
    (0..surface.n_triangles()).into_par_iter().filter(is_flipped).count()
}

/// The k-th place of a sequence that fills the unit square evenly (Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018).
pub(super) fn quasi_random(k: usize) -> [f64; 2] {
    const PLASTIC: f64 = 1.324_717_957_244_746;
    let at = |step: f64| (0.5 + (k + 1) as f64 * step).fract();
    [at(1.0 / PLASTIC), at(1.0 / (PLASTIC * PLASTIC))]
}
