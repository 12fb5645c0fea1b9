//! Rows: the first vertices beside creases and boundaries, one across from each gap between points there.
//!
//! Where a crease runs straight, three triangles of 60 degrees fill the half turn at each of its points; four have 45 and two 90, outside of what the targets ask for. So beside a crease
//! vertices come one to a gap, and a start that has them so keeps them; one by chance has others at every third point, which only pairs of them can mend.

use std::collections::HashMap;

use glam::{DVec3, I64Vec3};

use super::draft::Draft;
use crate::surface::Place;

/// How far a row is from its crease, in spacings.
const HEIGHT: f64 = 0.84;
/// Between gaps of these lengths, in spacings.
const GAPS: [f64; 2] = [0.9, 1.4];
/// No vertex of a row is nearer to another one, or to a point on a crease, in spacings.
const NEAREST: f64 = 0.87;
/// A row that comes out nearer to its crease than this part of its height has no room.
const LEAST_HEIGHT: f64 = 0.8;

/// A gap between two points on a crease.
pub(super) struct Gap {
    /// The edge of the surface on which its middle lies.
    pub edge: [u32; 2],
    pub middle: DVec3,
    pub length: f64,
}

/// Places of rows on both sides of gaps, where they have room, and points on creases are pinned already.
pub(super) fn rows(draft: &Draft, gaps: &[Gap], spacing: f64) -> Vec<(Place, f64)> {
    let Draft { surface, features, .. } = draft;
    let mesh = &surface.half_edges;
    let creases = (0..mesh.origin.len() as u32).filter(|&h| features.is_crease[h as usize]);
    let by_ends: HashMap<[u32; 2], u32> = creases.map(|h| ([mesh.origin[h as usize], mesh.target(h)], h)).collect();
    let mut near = Near::new(NEAREST * spacing);
    let pinned = (0..draft.vertices.len() as u32).filter(|&v| draft.vertices[v as usize].is_pinned);
    pinned.for_each(|v| near.put(draft.at(v)));

    let mut rows = Vec::new();
    let height = HEIGHT * spacing;
    for gap in gaps.iter().filter(|gap| (GAPS[0]..GAPS[1]).contains(&(gap.length / spacing))) {
        let [a, b] = gap.edge;
        for h in [[a, b], [b, a]].into_iter().filter_map(|ends| by_ends.get(&ends).copied()) {
            let face = h / 3;
            let along = surface.points[mesh.target(h) as usize] - surface.points[mesh.origin[h as usize] as usize];
            let inward = surface.normals[face as usize].cross(along).normalize_or_zero();
            let place = surface.project(features, face, gap.middle + height * inward);
            if place.at.distance(gap.middle) >= LEAST_HEIGHT * height && near.is_clear(place.at) {
                near.put(place.at);
                rows.push((place, 0.0));
            }
        }
    }
    rows
}

/// Which places are nearer to another than a distance.
struct Near {
    distance: f64,
    cells: HashMap<I64Vec3, Vec<DVec3>>,
}

impl Near {
    fn new(distance: f64) -> Self {
        Self { distance, cells: HashMap::new() }
    }

    fn cell(&self, at: DVec3) -> I64Vec3 {
        (at / self.distance).floor().as_i64vec3()
    }

    fn put(&mut self, at: DVec3) {
        self.cells.entry(self.cell(at)).or_default().push(at);
    }

    fn is_clear(&self, at: DVec3) -> bool {
        let cell = self.cell(at);
        let steps = || -1..=1;
        let around = steps().flat_map(move |x| steps().flat_map(move |y| steps().map(move |z| cell + I64Vec3::new(x, y, z))));
        around.filter_map(|cell| self.cells.get(&cell)).flatten().all(|other| other.distance(at) >= self.distance)
    }
}
