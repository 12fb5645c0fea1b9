//! Corners that nearly meet become one, and those that nearly lie on a segment lie on it: so no edge of
//! a mesh is shorter than it may be.

use std::collections::HashMap;

use glam::DVec2;

use super::{Polygon, Shape, counted, rounded};
use crate::error::Error;
use crate::space::{SegmentTree, nearest};

impl Polygon {
    /// The polygon with corners joined that are nearer to each other, or to a segment, than a distance in
    /// input units. [`Self::repairs`] tells how many.
    ///
    /// # Errors
    /// [`Error::InvalidPolygon`] where nothing is left.
    pub fn welded(&self, distance: f64) -> Result<Self, Error> {
        let domain = self.domain();
        let reach = distance / domain.restore_length(1.0);
        let stands_for = joined(&self.corners, reach);
        let on_segments = self.corners_on_segments(&stands_for, reach);
        let n_joined = (0..).zip(&stands_for).filter(|&(k, &other)| k != other).count();
        let n_on_segments: usize = on_segments.values().map(Vec::len).sum();
        if n_joined + n_on_segments == 0 {
            return Ok(self.clone());
        }
        let mut segment = 0;
        let ring = |ring: &Vec<[f64; 2]>| {
            let mut welded = Vec::new();
            for _ in ring {
                let from = stands_for[self.boundary[segment as usize][0] as usize];
                let between = on_segments.get(&segment).map(Vec::as_slice).unwrap_or_default();
                welded.extend([from].iter().chain(between).map(|&v| self.given[v as usize]));
                segment += 1;
            }
            welded
        };
        let rings = self.rings.iter().map(ring).collect();
        let mut welded = Self::of_shapes(&[Shape { rings, ..Shape::default() }])?;
        let told = format!(
            "{} than {} to another or to a segment: welded",
            counted(n_joined + n_on_segments, "corner is nearer", "corners are nearer"),
            rounded(distance)
        );
        welded.repairs = self.repairs.iter().cloned().chain([told]).collect();
        Ok(welded)
    }

    /// The corners that nearly lie on each segment, from its start to its end.
    fn corners_on_segments(&self, stands_for: &[u32], reach: f64) -> HashMap<u32, Vec<u32>> {
        let ends: Vec<[DVec2; 2]> = self.boundary.iter().map(|ends| ends.map(|v| self.corners[v as usize])).collect();
        let tree = SegmentTree::new(&ends);
        let mut on_segments: HashMap<u32, Vec<u32>> = HashMap::new();
        for v in (0..self.corners.len() as u32).filter(|&v| stands_for[v as usize] == v) {
            let p = self.corners[v as usize];
            let is_near = |low: DVec2, high: DVec2| p.distance(p.clamp(low, high)) < reach;
            tree.find(is_near, |ends, segment| {
                let is_its_own = self.boundary[segment as usize].iter().any(|&end| stands_for[end as usize] == v);
                if !is_its_own && p.distance(nearest(p, ends)) < reach {
                    on_segments.entry(segment).or_default().push(v);
                }
                false
            });
        }
        for (&segment, corners) in &mut on_segments {
            let [from, to] = ends[segment as usize];
            let along = |v: u32| (self.corners[v as usize] - from).dot(to - from);
            corners.sort_by(|&a, &b| along(a).total_cmp(&along(b)).then(a.cmp(&b)));
        }
        on_segments
    }
}

/// For each corner the first of those to which it is joined.
fn joined(corners: &[DVec2], reach: f64) -> Vec<u32> {
    let cell = |p: DVec2| [p.x, p.y].map(|x| (x / reach).floor());
    let mut stands_for: Vec<u32> = (0..corners.len() as u32).collect();
    let mut by_cell: HashMap<[u64; 2], Vec<u32>> = HashMap::new();
    for (v, &p) in (0u32..).zip(corners) {
        let around = [-1.0, 0.0, 1.0].map(|dy| [-1.0, 0.0, 1.0].map(|dx| [cell(p)[0] + dx, cell(p)[1] + dy]));
        let near = around.as_flattened().iter().filter_map(|cell| by_cell.get(&cell.map(|x| (x + 0.0).to_bits()))).flatten();
        let first = near.copied().filter(|&other| corners[other as usize].distance(p) < reach).min();
        match first {
            Some(first) => stands_for[v as usize] = first,
            None => by_cell.entry(cell(p).map(|x| (x + 0.0).to_bits())).or_default().push(v),
        }
    }
    stands_for
}
