//! The shape of triangles.

use glam::DVec2;

use crate::error::Error;
use crate::geometry::triangle::Shape;
use crate::triangulation::{BOUNDARY, HalfEdges, LiveMesh, Triangulation, clipped, triangles_seen};

/// Shapes of some triangles, summed up.
#[derive(Clone)]
pub(super) struct Shapes {
    n_triangles: usize,
    n_obtuse: usize,
    angle_squares: f64,
    qualities: f64,
    pub area: f64,
    min_angle_deg: f64,
    max_angle_deg: f64,
}

impl Shapes {
    const NONE: Self =
        Self { n_triangles: 0, n_obtuse: 0, angle_squares: 0.0, qualities: 0.0, area: 0.0, min_angle_deg: 180.0, max_angle_deg: 0.0 };

    /// Adds the triangle (0, u, v).
    fn add(&mut self, u: DVec2, v: DVec2) {
        let shape = Shape::of_plane([DVec2::ZERO, u, v]);
        for angle in shape.angles_deg {
            self.angle_squares += (angle - 60.0) * (angle - 60.0);
            self.min_angle_deg = self.min_angle_deg.min(angle);
            self.max_angle_deg = self.max_angle_deg.max(angle);
        }
        self.qualities += shape.radius_ratio();
        self.n_triangles += 1;
        self.n_obtuse += usize::from(shape.is_obtuse());
        self.area += shape.area;
    }

    pub fn angle_rms_deg(&self) -> f64 {
        (self.angle_squares / (3.0 * self.n_triangles as f64)).sqrt()
    }

    /// NaN if there are none.
    pub fn min_angle_deg(&self) -> f64 {
        if self.n_triangles == 0 { f64::NAN } else { self.min_angle_deg }
    }

    /// NaN if there are none.
    pub fn max_angle_deg(&self) -> f64 {
        if self.n_triangles == 0 { f64::NAN } else { self.max_angle_deg }
    }

    pub fn quality(&self) -> f64 {
        self.qualities / self.n_triangles as f64
    }

    pub fn obtuse_fraction(&self) -> f64 {
        self.n_obtuse as f64 / self.n_triangles as f64
    }
}

pub(super) struct TriangleMeasures {
    pub all: Shapes,
    /// Triangles with a corner on the boundary.
    pub boundary: Shapes,
    pub interior: Shapes,
    pub isolated_points: usize,
}

/// The shapes of the triangles whose circumcentre lies in the domain; in a polygon of those that are seen in a mesh of the same points.
pub(super) fn measure(triangulation: &Triangulation, live: Option<&mut LiveMesh>) -> Result<TriangleMeasures, Error> {
    let (mut boundary, mut interior, mut all) = (Shapes::NONE, Shapes::NONE, Shapes::NONE);
    let clipped = match live {
        Some(live) if triangulation.domain.boundary.is_some() => triangles_seen(live)?,
        _ => clipped(triangulation)?,
    };
    let n_vertices = triangulation.positions.len();
    let is_boundary = is_on_boundary(&clipped, n_vertices);
    let mut is_isolated = vec![true; n_vertices];
    for corners in clipped.triangles() {
        let (u, v) = triangulation.spokes(corners);
        all.add(u, v);
        let part = if corners.iter().any(|&v| is_boundary[v as usize]) { &mut boundary } else { &mut interior };
        part.add(u, v);
        corners.iter().for_each(|&v| is_isolated[v as usize] = false);
    }
    let isolated_points = is_isolated.into_iter().filter(|&is| is).count();
    Ok(TriangleMeasures { all, boundary, interior, isolated_points })
}

/// Marks the vertices on the boundary of a triangulation.
fn is_on_boundary(half_edges: &HalfEdges, n_vertices: usize) -> Vec<bool> {
    let mut marks = vec![false; n_vertices];
    for h in (0..half_edges.origin.len()).filter(|&h| half_edges.twin[h] == BOUNDARY) {
        marks[half_edges.origin[h] as usize] = true;
        marks[half_edges.target(h as u32) as usize] = true;
    }
    marks
}
