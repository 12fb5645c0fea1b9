//! The start of a remeshing: exactly n vertices on the surface, with its topology and along its features.

use glam::DVec3;

use super::chains::pin_chains;
use super::draft::Draft;
use super::eliminate::{eliminate, subdivide};
use super::given::{n_kept, put_all};
use super::live::{Start, Vertex};
use crate::error::Error;
use crate::surface::{Features, Surface};

/// The spacing of so many vertices on a surface: the edge of equilateral triangles, two for each.
pub(super) fn spacing(surface: &Surface, n_points: usize) -> f64 {
    (2.0 * surface.inner_area() / (3f64.sqrt() * n_points as f64)).sqrt()
}

/// Splits and collapses edges of the surface until exactly so many vertices are left; of given points, if there are any.
///
/// # Errors
/// [`Error::InvalidParameter`] for fewer points than the features and the topology need, and two given points in one place.
pub(super) fn start(
    surface: &Surface,
    features: &Features,
    sizes: &[f64],
    n_points: usize,
    given: &[DVec3],
    seed: u64,
) -> Result<Start, Error> {
    let spacing = spacing(surface, n_points);
    let mut draft = Draft::new(surface, features, sizes);
    let too_few = |least: usize| Error::InvalidParameter {
        name: "n_points",
        value: format!("{n_points} where no fewer than {least} are possible"),
        expected: "as many as the mesh's shape and its features need; without features fewer do",
    };
    // 1. Points along creases and borders.
    pin_chains(&mut draft, spacing, n_points).map_err(too_few)?;
    features.tips.iter().for_each(|&v| draft.pin(v));
    // 2. Vertices to choose from.
    if given.is_empty() {
        subdivide(&mut draft, spacing, n_points, seed);
    } else {
        put_all(&mut draft, given, n_points)?;
        // All others go first.
        let n_kept = n_kept(&draft);
        eliminate(&mut draft, n_kept, seed);
        draft.keeps_given = false;
    }
    // 3. As many as are wanted.
    let is_reached = eliminate(&mut draft, n_points, seed);
    if !is_reached {
        return Err(too_few(draft.n_live));
    }
    Ok(finished(&draft))
}

/// What is left, vertices that are near to each other in space near to each other in memory.
fn finished(draft: &Draft) -> Start {
    let mut order: Vec<u32> = (0..draft.vertices.len() as u32).filter(|&v| draft.is_live(v)).collect();
    order.sort_by_cached_key(|&v| (morton(draft.at(v)), v));
    let half_edges = draft.compact(&order);
    let vertices: Vec<Vertex> = { order.iter() }
        .map(|&v| {
            let vertex = &draft.vertices[v as usize];
            let place = vertex.place;
            Vertex { at: place.at, normal: vertex.normal, size: vertex.size, face: place.face, weights: place.weights }
        })
        .collect();
    let fixed = order.iter().map(|&v| draft.vertices[v as usize].is_pinned).collect();
    let mut number = vec![0; draft.vertices.len()];
    order.iter().zip(0..).for_each(|(&v, new)| number[v as usize] = new);
    let is_bond = |h: &usize| draft.mesh.origin[*h] != u32::MAX && draft.is_crease[*h];
    let mut bonds: Vec<[u32; 2]> = (0..draft.mesh.origin.len())
        .filter(is_bond)
        .map(|h| {
            let [a, b] = [draft.mesh.origin[h], draft.mesh.target(h as u32)].map(|v| number[v as usize]);
            [a.min(b), a.max(b)]
        })
        .collect();
    bonds.sort_unstable();
    bonds.dedup();
    let n_given = order.iter().filter(|&&v| draft.vertices[v as usize].is_given).count();
    Start { half_edges, vertices, fixed, bonds, n_given }
}

/// Where a place lies on Morton's curve through the box from -2 to 2.
fn morton(p: DVec3) -> u64 {
    const BITS: u32 = 21;
    let cells = ((p + 2.0) * f64::from(1u32 << (BITS - 2))).to_array().map(|x| (x.max(0.0) as u64).min((1 << BITS) - 1));
    (0..BITS).fold(0, |code, bit| code | (0..3).fold(0, |bits, axis| bits | (cells[axis] >> bit & 1) << (3 * bit + axis as u32)))
}
