//! What the points of a polygon see: of their neighbours, and of their cells.

use glam::DVec2;
use rayon::prelude::*;

use super::star::StarMeasures;
use crate::error::Error;
use crate::star::Senses;
use crate::triangulation::{LiveMesh, MIRROR, StarBuffer, Territory, part_shares};

/// So many points are looked at together for the largest reach.
const CHUNK: usize = 64;

/// What one point sees, everything relative to it.
pub(super) struct Seen<'a> {
    /// The ways to its neighbours, counter-clockwise.
    pub spokes: &'a [DVec2],
    /// The corners of its cell, counter-clockwise.
    pub cell: &'a [DVec2],
    /// The distance of the cell's farthest place from the nearest point that sees it, or more.
    pub reach: f64,
    /// Whether the cell stays clear of the boundary.
    pub is_inner: bool,
    /// The mean capacity of all over that of the part in which it lies.
    pub share: f64,
}

impl Seen<'_> {
    /// The same in numbers; the capacity relative to the mean of the part.
    pub fn measures(&self) -> StarMeasures {
        let star = StarMeasures::of(self.spokes, self.cell, self.is_inner);
        StarMeasures { reach: self.reach, capacity: self.share * star.capacity, ..star }
    }
}

/// Looks at what each point of a mesh sees. Up to `floor` its reach may be more than it is.
pub(super) fn look<T: Send>(mesh: &mut LiveMesh, floor: f64, look: impl Fn(Seen) -> T + Sync) -> Result<Vec<T>, Error> {
    let shares = mesh.boundary().map_or_else(Vec::new, |boundary| part_shares(boundary, &mesh.points(), None));
    mesh.look(Senses::default(), |mesh, v, StarBuffer { star, spokes, sight, near, .. }| {
        let ways: Vec<DVec2> = spokes.iter().filter(|spoke| spoke.vertex != MIRROR).map(|spoke| spoke.way).collect();
        let is_inner = sight.outline.is_empty();
        let squared = if is_inner {
            let centre = |k: usize| {
                let [along_u, along_v] = star.centre(k);
                along_u * spokes[k].way + along_v * spokes[star.after(k)].way
            };
            sight.outline.extend((0..star.n_spokes()).map(centre));
            sight.outline.iter().map(|corner| corner.length_squared()).fold(0.0, f64::max)
        } else {
            mesh.reach_of_seeing(v, near, &sight.outline, floor * floor)
        };
        let share = shares.get(v as usize).copied().unwrap_or(1.0);
        let seen = look(Seen { spokes: &ways, cell: &sight.outline, reach: squared.sqrt(), is_inner, share });
        sight.outline.clear();
        seen
    })
}

/// The largest reach of all points, of each of which it is known that it is no more than this.
pub(super) fn largest_reach(mesh: &LiveMesh, bounds: &[f64]) -> f64 {
    let mut order: Vec<u32> = (0..bounds.len() as u32).collect();
    order.sort_by(|&a, &b| bounds[b as usize].total_cmp(&bounds[a as usize]));
    let mut largest = 0.0;
    for vertices in order.chunks(CHUNK) {
        if bounds[vertices[0] as usize] <= largest {
            break;
        }
        let reaches = vertices.par_iter().map_init(StarBuffer::default, |buffer, &v| {
            // With everything free, nothing lies outside.
            let _ = mesh.read(v, Territory::EVERYTHING, buffer);
            let StarBuffer { sight, near, .. } = buffer;
            if sight.outline.is_empty() {
                bounds[v as usize]
            } else {
                mesh.reach_of_seeing(v, near, &sight.outline, largest * largest).sqrt()
            }
        });
        largest = reaches.collect::<Vec<f64>>().into_iter().fold(largest, f64::max);
    }
    largest
}
