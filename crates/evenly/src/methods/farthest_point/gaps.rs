//! The gaps between points, and the largest of them, while points are taken out and put in elsewhere.

use glam::DVec2;

use super::tournament::Tournament;
use crate::error::Error;
use crate::triangulation::{LiveMesh, StarBuffer, Territory, Transplant};

/// A place that is as far from all points as any place around it.
pub(super) struct Gap {
    place: DVec2,
    /// A triangle near there.
    triangle: u32,
    /// The squared distance to the points around.
    squared: f64,
}

/// The mesh, and the sizes of its gaps: circumcircles of triangles, and in a rectangle the places on walls that are farthest from the vertices there.
pub(super) struct Gaps {
    pub mesh: LiveMesh,
    /// First the triangles, then, in a rectangle, the points.
    sizes: Tournament,
    /// What has changed since the sizes were entered, and no less than the largest that is there now.
    outdated: Vec<u32>,
    bound: f64,
    work: Transplant,
    buffer: StarBuffer,
    /// The gaps, and the points, where a point has been taken out.
    around: Vec<u32>,
    /// How often the mesh was rebuilt.
    pub n_rebuilt: usize,
}

/// No gap.
const NONE: f64 = -1.0;
/// A point that moves no farther than this part of the spacing stays in its own gap.
const NEAR: f64 = 0.2;

impl Gaps {
    pub fn new(mesh: LiveMesh) -> Self {
        let mut gaps = Self {
            sizes: Tournament::new(vec![NONE]),
            outdated: Vec::new(),
            bound: NONE,
            mesh,
            work: Transplant::default(),
            buffer: StarBuffer::default(),
            around: Vec::new(),
            n_rebuilt: 0,
        };
        gaps.measure_all();
        gaps
    }

    /// Moves a point to the largest gap that is there without it, of all or of those around it; returns how far it went. On a way through its own
    /// gap it goes `relaxation` times as far, if that brings it no nearer to another point than it was.
    pub fn move_to_farthest(&mut self, point: u32, is_local: bool, relaxation: f64) -> Result<f64, Error> {
        if self.mesh.is_fixed(point) {
            return Ok(0.0);
        }
        let from = self.mesh.position(point);
        self.mesh.take_out(point, &mut self.work);
        if !self.mesh.is_torn() {
            let own = self.largest_around(point);
            let gap = if is_local || own.squared >= self.bound { own } else { self.largest_of_all(point) };
            let place = if gap.squared > 0.0 { self.relaxed(from, gap.place, relaxation) } else { from };
            self.mesh.put_in(point, place, gap.triangle, &mut self.work);
            self.note_changes();
        }
        self.mend()?;
        Ok(self.mesh.domain().spoke(from, self.mesh.position(point)).length())
    }

    /// The smallest distance of two points, in spacings.
    pub fn smallest_distance(&mut self) -> Result<f64, Error> {
        self.mesh.legalize();
        self.mend()?;
        Ok(self.mesh.distances()?.smallest)
    }

    /// Where the mesh is torn, it is rebuilt, and all gaps are measured.
    fn mend(&mut self) -> Result<(), Error> {
        if self.mesh.mend()? {
            self.n_rebuilt += 1;
            self.work = Transplant::default();
            self.measure_all();
        }
        Ok(())
    }

    fn measure_all(&mut self) {
        let n_triangles = self.mesh.n_triangles() as u32;
        let n_at_walls = if self.mesh.domain().is_periodic { 0 } else { self.mesh.n_points() as u32 };
        let sizes: Vec<f64> = (0..n_triangles + n_at_walls).map(|index| self.gap(index).squared).collect();
        self.sizes = Tournament::new(sizes);
        self.bound = self.sizes.best().1;
        self.outdated.clear();
    }

    /// The gap of a triangle, or of a point at a wall.
    fn gap(&mut self, index: u32) -> Gap {
        let n_triangles = self.mesh.n_triangles() as u32;
        if index >= n_triangles {
            return self.wall_gap(index - n_triangles);
        }
        let domain = self.mesh.domain();
        let (place, squared) = self.mesh.circumcircle(index);
        let is_gap = !self.work.is_free(index) && (domain.is_periodic || domain.contains(place));
        Gap { place, triangle: index, squared: if is_gap { squared } else { NONE } }
    }

    /// The farthest place on a wall that is nearest to `v`.
    fn wall_gap(&mut self, v: u32) -> Gap {
        // With everything free, nothing lies outside.
        let _ = self.mesh.read(v, Territory::EVERYTHING, &mut self.buffer);
        let StarBuffer { star, spokes, .. } = &self.buffer;
        let corner = |k: usize| {
            let [a, b] = star.centre(k);
            a * spokes[k].way + b * spokes[star.after(k)].way
        };
        let at = self.mesh.position(v);
        let domain = self.mesh.domain();
        if domain.boundary.is_some() {
            // Of what is seen, the farthest place.
            let farthest = self.buffer.sight.outline.iter().copied().max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
            let place = domain.walk(at, at + farthest.unwrap_or_default());
            // Who is hidden from here may be near to there.
            let others = self.buffer.near.iter().map(|&other| self.mesh.position(other).distance_squared(place));
            let squared = if place == at { NONE } else { others.fold(place.distance_squared(at), f64::min) };
            return Gap { place, triangle: self.mesh.triangle_at(v), squared };
        }
        let on_walls = (0..star.n_spokes()).filter(|&k| star.is_mirror[k] || star.is_mirror[star.after(k)]).map(corner);
        let farthest = on_walls.max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
        let (place, squared) = farthest.map_or((DVec2::ZERO, NONE), |corner| (corner, corner.length_squared()));
        Gap { place: at + place, triangle: self.mesh.triangle_at(v), squared }
    }

    /// The largest of the gaps where `missing` has been taken out.
    fn largest_around(&mut self, missing: u32) -> Gap {
        self.list_around(Some(missing));
        let mut largest = Gap { place: DVec2::ZERO, triangle: 0, squared: NONE };
        for k in 0..self.around.len() {
            let gap = self.gap(self.around[k]);
            if gap.squared > largest.squared {
                largest = gap;
            }
        }
        largest
    }

    /// The largest of all gaps while `missing` is out.
    fn largest_of_all(&mut self, missing: u32) -> Gap {
        self.outdated.extend(&self.around);
        self.forget_doubles();
        let missing = self.mesh.n_triangles() as u32 + missing;
        if !self.mesh.domain().is_periodic {
            self.sizes.set(missing as usize, NONE);
        }
        for k in 0..self.outdated.len() {
            let index = self.outdated[k];
            if index != missing {
                let size = self.gap(index).squared;
                self.sizes.set(index as usize, size);
            }
        }
        self.outdated.clear();
        let (best, size) = self.sizes.best();
        self.bound = size;
        self.gap(best as u32)
    }

    /// Lists the gaps that have changed.
    fn list_around(&mut self, missing: Option<u32>) {
        let Self { mesh, work, around, .. } = self;
        work.changed.sort_unstable();
        work.changed.dedup();
        around.clear();
        around.extend(&work.changed);
        if !mesh.domain().is_periodic {
            let n_triangles = mesh.n_triangles() as u32;
            let in_mesh = work.changed.iter().filter(|&&triangle| !work.is_free(triangle));
            // Of the corners, not the frame's.
            let points =
                in_mesh.flat_map(|&triangle| mesh.corners(triangle)).filter(|&v| (v as usize) < mesh.n_points() && Some(v) != missing);
            around.extend(points.map(|v| n_triangles + v));
            around[work.changed.len()..].sort_unstable();
            around.dedup();
        }
    }

    /// After a move: what has changed is outdated.
    fn note_changes(&mut self) {
        self.list_around(None);
        for k in 0..self.around.len() {
            self.bound = self.bound.max(self.gap(self.around[k]).squared);
        }
        self.outdated.extend(&self.around);
        self.work.changed.clear();
        if self.outdated.len() > 8 * self.mesh.n_triangles() {
            self.forget_doubles();
        }
    }

    fn forget_doubles(&mut self) {
        self.outdated.sort_unstable();
        self.outdated.dedup();
    }

    /// A place `relaxation` times as far as `to`, if that is near, and no nearer to another point than `from` was.
    fn relaxed(&self, from: DVec2, to: DVec2, relaxation: f64) -> DVec2 {
        let domain = self.mesh.domain();
        let way = domain.spoke(from, to);
        if way.length() > NEAR * self.mesh.spacing() {
            return to;
        }
        let in_mesh = || self.work.changed.iter().filter(|&&triangle| !self.work.is_free(triangle));
        let nearest = |place: DVec2| {
            let corners = in_mesh().flat_map(|&triangle| self.mesh.corners(triangle));
            corners.map(|v| domain.spoke(place, self.mesh.position(v)).length_squared()).fold(f64::INFINITY, f64::min)
        };
        let beyond = domain.walk(from, from + relaxation * way);
        if nearest(beyond) >= nearest(from) { beyond } else { to }
    }
}
