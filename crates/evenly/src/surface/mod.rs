//! Triangle meshes in space: a [`Surface`] is one that has been checked, with all that is asked of it: its features, the way along it, distances, sizes.

mod bvh;
mod clean;
mod crossings;
mod distance;
mod distribution;
mod feature_size;
mod features;
mod flatten;
mod manifold;
mod missed;
mod morton;
mod neighbours;
mod poisson_disk;
mod quality;
mod sizing;
mod stitch;
mod triangle_mesh;
mod walk;
mod weld;

use glam::DVec3;

pub use crossings::self_intersections;
pub(crate) use distance::Facets;
pub use distance::{SurfaceDistance, surface_distance};
pub use distribution::{SurfaceMeasures, measure_on_surface, surface_spectrum};
pub(crate) use features::{Chain, Features};
pub use missed::{MissedLengths, missed_lengths};
pub(crate) use morton::morton;
pub(crate) use poisson_disk::{poisson_disk, white};
pub(crate) use quality::SIZE;
pub use quality::{CertificateBreach, SurfaceQuality, certificate, surface_quality};
pub(crate) use sizing::weighted_area;
pub use sizing::{SurfaceSizing, expected_vertices, surface_sizes};
pub use triangle_mesh::{Attribute, TriangleMesh};
pub(crate) use walk::Place;

use self::clean::clean;
use self::flatten::mend_flat;
use self::manifold::{manifold, split_fans};
use self::stitch::stitch;
use crate::error::Error;
use crate::triangulation::{BOUNDARY, HalfEdges, prev};

/// An oriented manifold of triangles, closed or with boundaries, of any genus and in any number of parts.
///
/// Inside it lies around the origin, scaled by a power of two, so that neither an offset nor the units cost digits.
#[derive(Debug, Clone)]
pub struct Surface {
    pub(crate) frame: Frame,
    pub(crate) points: Vec<DVec3>,
    pub(crate) half_edges: HalfEdges,
    /// Of the triangles; zero for one without area.
    pub(crate) normals: Vec<DVec3>,
    /// For each vertex the given one.
    sources: Vec<usize>,
    /// For each triangle the given one.
    pub(crate) faces: Vec<usize>,
    /// How many vertices the given mesh has.
    n_given: usize,
    attributes: Vec<Attribute>,
    notes: Vec<String>,
}

/// Added and taken away again, it leaves multiples of 2^-52.
const ROUND: f64 = 1.5;

/// How input units are turned into those inside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Frame {
    centre: DVec3,
    /// A power of two.
    scale: f64,
}

impl Frame {
    fn around(points: impl Iterator<Item = DVec3> + Clone) -> Self {
        let low = points.clone().fold(DVec3::INFINITY, DVec3::min);
        let high = points.fold(DVec3::NEG_INFINITY, DVec3::max);
        // Halves, so that the sum does not overflow.
        let (centre, half) = (0.5 * low + 0.5 * high, 0.5 * high - 0.5 * low);
        let longest = half.max_element();
        Self { centre, scale: if longest > 0.0 { 2f64.powi(libm::ilogb(longest).clamp(-1020, 1020)) } else { 1.0 } }
    }

    /// Rounded to what numbers of order 1 tell, so that no two places are too near for reckoning.
    pub fn inward(&self, p: [f64; 3]) -> DVec3 {
        ((DVec3::from(p) - self.centre) / self.scale + ROUND) - ROUND
    }

    pub fn outward(&self, p: DVec3) -> [f64; 3] {
        (p * self.scale + self.centre).to_array()
    }

    pub fn length_outward(&self, length: f64) -> f64 {
        length * self.scale
    }

    pub fn length_inward(&self, length: f64) -> f64 {
        length / self.scale
    }
}

impl Surface {
    /// Checks a mesh. Positions are welded, faces dropped that have two corners in one place or are there twice, and vertices split at which parts touch; what was done
    /// [`notes`](Self::notes) say.
    ///
    /// # Errors
    /// [`Error::InvalidMesh`] for coordinates that are not finite, corners that do not exist, no triangle at all, edges with more than two triangles, and
    /// neighbours that do not agree on which side is outside.
    ///
    /// # Example
    /// ```
    /// use evenly::{Surface, TriangleMesh};
    ///
    /// let vertices = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    /// let triangles = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    /// let surface = Surface::new(&TriangleMesh { vertices, triangles, attributes: Vec::new() })?;
    /// assert!(surface.is_closed() && surface.euler_characteristic() == 2);
    /// # Ok::<(), evenly::Error>(())
    /// ```
    pub fn new(mesh: &TriangleMesh) -> Result<Self, Error> {
        Self::checked(mesh, false)
    }

    /// The same, with repair: triangles are turned where neighbours run the other way, a closed part of which some were turned so that its
    /// volume is positive; cracks at vertices that lie on an open edge are closed, sheets that touch along an edge are separated, and what cannot be told apart
    /// is cut open there.
    ///
    /// # Errors
    /// As [`new`](Self::new), but for what is repaired.
    pub fn repaired(mesh: &TriangleMesh) -> Result<Self, Error> {
        Self::checked(mesh, true)
    }

    fn checked(mesh: &TriangleMesh, is_repaired: bool) -> Result<Self, Error> {
        if let Some((v, p)) = mesh.vertices.iter().enumerate().find(|(_, p)| !p.iter().all(|x| x.is_finite())) {
            return Err(Error::InvalidMesh(format!("vertex {v} is ({}, {}, {}), which is not finite", p[0], p[1], p[2])));
        }
        let frame = Frame::around(mesh.vertices.iter().map(|&p| p.into()));
        let places: Vec<DVec3> = mesh.vertices.iter().map(|&p| frame.inward(p)).collect();
        let mut clean = clean(mesh, &places)?;
        let points: Vec<DVec3> = clean.sources.iter().map(|&v| places[v]).collect();
        let n_stitched = if is_repaired { stitch(&mut clean, &points) } else { 0 };
        let (mut half_edges, made_notes) = manifold(&clean, &points, is_repaired)?;
        let mut notes = std::mem::take(&mut clean.notes);
        if n_stitched > 0 {
            notes.push(format!("{n_stitched} vertices on the open edge of another triangle were joined to it"));
        }
        notes.extend(made_notes);
        let n_flat = mend_flat(&mut half_edges, &mut clean.faces, &points);
        if n_flat > 0 {
            notes.push(format!("{n_flat} triangles without area were mended by flips, or dropped at a boundary"));
        }
        let vertices = split_fans(&mut half_edges, points.len());
        if vertices.len() > points.len() {
            notes.push(format!("{} vertices at which parts touch were split", vertices.len() - points.len()));
        }
        let points: Vec<DVec3> = vertices.iter().map(|&v| points[v as usize]).collect();
        let sources = vertices.iter().map(|&v| clean.sources[v as usize]).collect();
        let mut surface = Self {
            frame,
            points,
            half_edges,
            normals: Vec::new(),
            sources,
            faces: clean.faces,
            n_given: mesh.vertices.len(),
            attributes: mesh.attributes.clone(),
            notes,
        };
        if surface.inner_area() == 0.0 {
            return Err(Error::InvalidMesh("no triangle of the mesh has an area".into()));
        }
        surface.normals = (0..surface.n_triangles()).map(|t| surface.normal(t).normalize_or_zero()).collect();
        Ok(surface)
    }

    /// What was done to the mesh that was given, in plain words.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// How many vertices there are, split ones counted by their parts.
    pub fn n_vertices(&self) -> usize {
        self.points.len()
    }

    /// How many triangles.
    pub fn n_triangles(&self) -> usize {
        self.half_edges.n_triangles()
    }

    /// How many edges have a triangle on one side only.
    pub fn n_boundary_edges(&self) -> usize {
        self.half_edges.twin.iter().filter(|&&twin| twin == BOUNDARY).count()
    }

    /// Whether there is no boundary.
    pub fn is_closed(&self) -> bool {
        self.n_boundary_edges() == 0
    }

    /// Vertices less edges plus triangles: 2 for a sphere, 2 less for each handle, 1 less for each hole.
    pub fn euler_characteristic(&self) -> i64 {
        let n_edges = (self.half_edges.origin.len() + self.n_boundary_edges()) / 2;
        let n_used = self.half_edges.outgoing(self.n_vertices()).iter().filter(|&&h| h != BOUNDARY).count();
        n_used as i64 - n_edges as i64 + self.n_triangles() as i64
    }

    /// How many connected parts there are.
    pub fn n_components(&self) -> usize {
        let mut seen = vec![false; self.n_triangles()];
        let mut n = 0;
        for seed in 0..seen.len() {
            if seen[seed] {
                continue;
            }
            n += 1;
            seen[seed] = true;
            let mut stack = vec![seed];
            while let Some(t) = stack.pop() {
                for h in 3 * t..3 * t + 3 {
                    let twin = self.half_edges.twin[h];
                    if twin != BOUNDARY && !std::mem::replace(&mut seen[twin as usize / 3], true) {
                        stack.push(twin as usize / 3);
                    }
                }
            }
        }
        n
    }

    /// The area, in the square of input units.
    pub fn area(&self) -> f64 {
        let unit = self.frame.length_outward(1.0);
        self.inner_area() * unit * unit
    }

    /// The length of the bounding box's diagonal, in input units.
    pub fn diagonal(&self) -> f64 {
        let low = self.points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = self.points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
        self.frame.length_outward((high - low).length())
    }

    pub(crate) fn inner_area(&self) -> f64 {
        (0..self.n_triangles()).map(|t| 0.5 * self.normal(t).length()).sum()
    }

    #[inline]
    pub(crate) fn corners(&self, t: usize) -> [DVec3; 3] {
        let [a, b, c] = self.half_edges.triangle(t);
        [self.points[a as usize], self.points[b as usize], self.points[c as usize]]
    }

    /// Twice the area long.
    fn normal(&self, t: usize) -> DVec3 {
        let [a, b, c] = self.corners(t);
        (b - a).cross(c - a)
    }

    /// The angle of a half-edge's triangle at its origin.
    fn angle(&self, h: u32) -> f64 {
        let origin = |h: u32| self.points[self.half_edges.origin[h as usize] as usize];
        let at = origin(h);
        let (u, v) = (self.points[self.half_edges.target(h) as usize] - at, origin(prev(h)) - at);
        libm::atan2(u.cross(v).length(), u.dot(v))
    }

    /// An attribute of the given mesh at a place of a triangle.
    pub(crate) fn attribute(&self, attribute: &Attribute, t: usize, weights: [f64; 3]) -> f64 {
        let values = self.half_edges.triangle(t).map(|v| attribute.values[self.sources[v as usize]]);
        values.iter().zip(weights).map(|(value, weight)| value * weight).sum()
    }

    pub(crate) fn attributes(&self) -> &[Attribute] {
        &self.attributes
    }

    /// The mesh as it is now.
    pub fn to_mesh(&self) -> TriangleMesh {
        TriangleMesh {
            vertices: self.points.iter().map(|&p| self.frame.outward(p)).collect(),
            triangles: self.half_edges.triangles().map(|t| t.map(|v| v as usize)).collect(),
            attributes: { self.attributes.iter() }
                .map(|Attribute { name, values }| Attribute { name: name.clone(), values: self.of_given(values) })
                .collect(),
        }
    }

    /// Numbers of the given mesh' vertices as those of the surface's.
    fn of_given(&self, given: &[f64]) -> Vec<f64> {
        self.sources.iter().map(|&v| given[v]).collect()
    }
}
