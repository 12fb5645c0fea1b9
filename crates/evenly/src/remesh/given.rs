//! Given points: each becomes a vertex of the draft, where it lies on the surface.

use std::collections::BTreeMap;

use glam::DVec3;
use rayon::prelude::*;

use super::draft::Draft;
use crate::error::Error;
use crate::surface::{Facets, Place, Surface, morton};
use crate::triangulation::{BOUNDARY, next};

/// What is so near to an edge, as a part of the triangle's height, lies on it.
const ON_EDGE: f64 = 1e-8;

/// The nearest places of a surface to points, and how far these are from them.
pub(super) fn places(surface: &Surface, points: &[DVec3]) -> Vec<(Place, f64)> {
    let solid: Vec<u32> = (0..surface.n_triangles() as u32).filter(|&t| surface.normals[t as usize] != DVec3::ZERO).collect();
    let facets = Facets::new(solid.iter().map(|&t| surface.corners(t as usize)).collect());
    let place = |&p: &DVec3| {
        let place = surface.nearest_on(facets.nearest(p).map_or(0, |(k, _)| solid[k]), p);
        (place, place.at.distance(p))
    };
    points.par_iter().map(place).collect()
}

/// Of places that lie on edges the edge, by its ends in order, and how far along it from the first; of one at a vertex that twice.
pub(super) fn on_edges(surface: &Surface, places: &[(Place, f64)]) -> BTreeMap<[u32; 2], Vec<f64>> {
    let mut all: BTreeMap<[u32; 2], Vec<f64>> = BTreeMap::new();
    for (Place { face, weights, .. }, _) in places {
        let corners = surface.half_edges.triangle(*face as usize);
        if let Some(k) = (0..3).find(|&k| weights[k] >= 1.0 - ON_EDGE) {
            all.entry([corners[k]; 2]).or_default().push(0.0);
            continue;
        }
        let Some(k) = (0..3).find(|&k| weights[k] <= ON_EDGE) else { continue };
        let [(a, _), (b, along)] = [(k + 1) % 3, (k + 2) % 3].map(|k| (corners[k], weights[k]));
        all.entry([a.min(b), a.max(b)]).or_default().push(if a < b { along } else { 1.0 - along });
    }
    all
}

/// Puts a vertex at each place.
///
/// # Errors
/// [`Error::InvalidParameter`] for two points in one place.
pub(super) fn put_all(draft: &mut Draft, places: &[(Place, f64)]) -> Result<(), Error> {
    // Those of a triangle one after the other, and each near to the one before.
    let mut order: Vec<usize> = (0..places.len()).collect();
    order.sort_by_cached_key(|&k| (places[k].0.face, morton(places[k].0.at)));
    // A triangle of the draft in each of the surface: there the search begins.
    let mut begin: BTreeMap<u32, u32> = draft.hosts.iter().copied().zip(0..).collect();
    let mut point_at: BTreeMap<u32, usize> = BTreeMap::new();
    for k in order {
        let place = places[k].0;
        let t = locate(draft, begin[&place.face], place.at);
        begin.insert(place.face, t);
        let v = put(draft, t, place);
        if let Some(other) = point_at.insert(v, k) {
            let value = format!("such that the nearest places of the surface to points {} and {} are one", other.min(k), other.max(k));
            return Err(Error::InvalidParameter { name: "points", value, expected: "points whose places differ" });
        }
        draft.vertices[v as usize].is_given = !draft.is_loose(v);
    }
    Ok(())
}

/// How many vertices are given, or stay in any case.
pub(super) fn n_kept(draft: &Draft) -> usize {
    draft.vertices.iter().filter(|vertex| vertex.is_pinned || vertex.is_given).count()
}

/// The triangle of the draft that holds a place, found by walking from another of the same host.
fn locate(draft: &Draft, begin: u32, at: DVec3) -> u32 {
    let host = draft.hosts[begin as usize];
    let mut t = begin;
    for _ in 0..draft.mesh.n_triangles() {
        let is_outside = |&h: &u32| {
            let twin = draft.mesh.twin[h as usize];
            twin != BOUNDARY && draft.hosts[twin as usize / 3] == host && side(draft, h, at) < 0.0
        };
        match (3 * t..3 * t + 3).find(is_outside) {
            Some(h) => t = draft.mesh.twin[h as usize] / 3,
            None => break,
        }
    }
    t
}

/// Twice the area of the triangle that a half-edge and a place of its host make; below zero to its right.
fn side(draft: &Draft, h: u32, at: DVec3) -> f64 {
    let [from, to] = [draft.mesh.origin[h as usize], draft.mesh.target(h)].map(|v| draft.at(v));
    (to - from).cross(at - from).dot(draft.surface.normals[draft.hosts[h as usize / 3] as usize])
}

/// Puts a vertex into a triangle, on its edge, or takes its corner. Then the triangles around are made Delaunay as far as they have the same host, which keeps searches short.
fn put(draft: &mut Draft, t: u32, place: Place) -> u32 {
    // By the edges, the areas that make the place's weights.
    let areas = [0, 1, 2].map(|k| side(draft, 3 * t + k, place.at));
    let least = ON_EDGE * areas.iter().sum::<f64>();
    let v = match areas.map(|area| area > least) {
        [true, true, true] => draft.insert(t, place),
        [false, true, true] => draft.split_at(3 * t, place),
        [true, false, true] => draft.split_at(3 * t + 1, place),
        [true, true, false] => draft.split_at(3 * t + 2, place),
        // The weight of a corner is that of the edge across.
        [_, false, false] => return draft.mesh.origin[3 * t as usize + 2],
        [false, _, false] => return draft.mesh.origin[3 * t as usize],
        [false, false, _] => return draft.mesh.origin[3 * t as usize + 1],
    };
    let mut suspects: Vec<u32> = draft.mesh.around(draft.outgoing[v as usize]).map(next).collect();
    draft.legalize_within(&mut suspects, |_, _| {});
    v
}
