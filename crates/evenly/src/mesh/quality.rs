//! What a mesh is worth.

use std::collections::HashSet;

use serde::Serialize;

use super::Mesh;
use crate::measure::SizeErrors;

/// What [`mesh_quality`] finds. Angles are NaN where there is no triangle.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeshQuality {
    /// How many vertices there are.
    pub n_vertices: usize,
    /// How many triangles.
    pub n_triangles: usize,
    /// How many edges on the boundary.
    pub n_boundary_edges: usize,
    /// Smallest angle.
    pub min_angle_deg: f64,
    /// Largest angle.
    pub max_angle_deg: f64,
    /// Mean of the triangles' smallest angles.
    pub mean_min_angle_deg: f64,
    /// Triangles with an angle above 90 degrees, by more than rounding.
    pub obtuse_triangles: usize,
    /// Largest ratio of a triangle's circumradius to its shortest side: the smallest angle is asin(1 / (2 ratio)).
    pub radius_edge: f64,
    /// Largest circumradius over shortest edge, of all triangles: beta, as far as the spacing is the same everywhere.
    pub beta: f64,
    /// Mean of twice the inradius over the circumradius; 1 for equilateral triangles.
    pub triangle_quality: f64,
    /// Shortest and longest edge, in input units.
    pub min_edge: f64,
    /// Longest edge.
    pub max_edge: f64,
    /// The area of all triangles, in input units squared.
    pub area: f64,
    /// How long edges are beside what is wanted; `None` where the mesh does not know.
    #[serde(flatten)]
    pub size_errors: Option<SizeErrors>,
}

/// Each edge once: from its triangle in which it runs upwards, or from the only one that it has.
fn size_errors(mesh: &Mesh) -> Option<SizeErrors> {
    if mesh.sizes.len() != mesh.vertices.len() {
        return None;
    }
    let is_on_boundary: HashSet<[usize; 2]> = mesh.edges.iter().map(|edge| edge.ends).collect();
    let sides = mesh.triangles.iter().flat_map(|t| [0, 1, 2].map(|k| [t[k], t[(k + 1) % 3]]));
    let edges = sides.filter(|&[a, b]| a < b || is_on_boundary.contains(&[a, b]));
    SizeErrors::of(edges.map(|ends| {
        let [p, q] = ends.map(|v| mesh.vertices[v]);
        (libm::hypot(p[0] - q[0], p[1] - q[1]), ends.map(|v| mesh.sizes[v]))
    }))
}

/// Measures a mesh.
pub fn mesh_quality(mesh: &Mesh) -> MeshQuality {
    let mut quality = MeshQuality {
        n_vertices: mesh.vertices.len(),
        n_triangles: mesh.triangles.len(),
        n_boundary_edges: mesh.edges.iter().filter(|edge| matches!(edge.kind, super::EdgeKind::Boundary { .. })).count(),
        min_angle_deg: f64::INFINITY,
        max_angle_deg: f64::NEG_INFINITY,
        mean_min_angle_deg: 0.0,
        obtuse_triangles: 0,
        radius_edge: 0.0,
        beta: 0.0,
        triangle_quality: 0.0,
        min_edge: f64::INFINITY,
        max_edge: 0.0,
        area: 0.0,
        size_errors: size_errors(mesh),
    };
    let mut max_radius = 0f64;
    for t in 0..mesh.triangles.len() {
        let shape = mesh.shape(t);
        let [least, most] = shape.extreme_angles_deg();
        let shortest = shape.shortest();
        let radius = shortest / (2.0 * libm::sin(least.to_radians()));
        quality.min_angle_deg = quality.min_angle_deg.min(least);
        quality.max_angle_deg = quality.max_angle_deg.max(most);
        quality.mean_min_angle_deg += least;
        quality.obtuse_triangles += usize::from(shape.is_obtuse());
        quality.radius_edge = quality.radius_edge.max(radius / shortest);
        max_radius = max_radius.max(radius);
        quality.min_edge = quality.min_edge.min(shortest);
        quality.max_edge = quality.max_edge.max(shape.longest());
        quality.triangle_quality += shape.radius_ratio();
        quality.area += shape.area;
    }
    let n = mesh.triangles.len() as f64;
    quality.mean_min_angle_deg /= n;
    quality.triangle_quality /= n;
    quality.beta = max_radius / quality.min_edge;
    if mesh.triangles.is_empty() {
        (quality.min_angle_deg, quality.max_angle_deg) = (f64::NAN, f64::NAN);
    }
    quality
}
