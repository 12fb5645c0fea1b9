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
    /// How many edges on the border.
    pub n_border_edges: usize,
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

/// An angle counts as obtuse above this.
const OBTUSE_DEG: f64 = 90.0 + 1e-6;

/// A triangle's angles in degrees, at its corners.
pub(super) fn angles_deg(corners: [[f64; 2]; 3]) -> [f64; 3] {
    let way = |a: [f64; 2], b: [f64; 2]| [b[0] - a[0], b[1] - a[1]];
    [0, 1, 2].map(|k| {
        let (u, v) = (way(corners[k], corners[(k + 1) % 3]), way(corners[k], corners[(k + 2) % 3]));
        (u[0] * v[1] - u[1] * v[0]).atan2(u[0] * v[0] + u[1] * v[1]).to_degrees()
    })
}

/// Each edge once: from its triangle in which it runs upwards, or from the only one that it has.
fn size_errors(mesh: &Mesh) -> Option<SizeErrors> {
    if mesh.sizes.len() != mesh.vertices.len() {
        return None;
    }
    let is_on_border: HashSet<[usize; 2]> = mesh.edges.iter().map(|edge| edge.ends).collect();
    let sides = mesh.triangles.iter().flat_map(|t| [0, 1, 2].map(|k| [t[k], t[(k + 1) % 3]]));
    let edges = sides.filter(|&[a, b]| a < b || is_on_border.contains(&[a, b]));
    SizeErrors::of(edges.map(|ends| {
        let [p, q] = ends.map(|v| mesh.vertices[v]);
        ((p[0] - q[0]).hypot(p[1] - q[1]), ends.map(|v| mesh.sizes[v]))
    }))
}

/// Measures a mesh.
pub fn mesh_quality(mesh: &Mesh) -> MeshQuality {
    let mut quality = MeshQuality {
        n_vertices: mesh.vertices.len(),
        n_triangles: mesh.triangles.len(),
        n_border_edges: mesh.edges.iter().filter(|edge| matches!(edge.kind, super::EdgeKind::Border { .. })).count(),
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
    for t in &mesh.triangles {
        let corners = t.map(|v| mesh.vertices[v]);
        let angles = angles_deg(corners);
        let [least, most] = [angles.into_iter().fold(f64::INFINITY, f64::min), angles.into_iter().fold(f64::NEG_INFINITY, f64::max)];
        let sides = [0, 1, 2].map(|k| {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            (a[0] - b[0]).hypot(a[1] - b[1])
        });
        let shortest = sides.into_iter().fold(f64::INFINITY, f64::min);
        let radius = shortest / (2.0 * least.to_radians().sin());
        quality.min_angle_deg = quality.min_angle_deg.min(least);
        quality.max_angle_deg = quality.max_angle_deg.max(most);
        quality.mean_min_angle_deg += least;
        quality.obtuse_triangles += usize::from(most > OBTUSE_DEG);
        quality.radius_edge = quality.radius_edge.max(radius / shortest);
        max_radius = max_radius.max(radius);
        quality.min_edge = quality.min_edge.min(shortest);
        quality.max_edge = sides.into_iter().fold(quality.max_edge, f64::max);
        // 2 r / R = 8 sin(A/2) sin(B/2) sin(C/2).
        quality.triangle_quality += 8.0 * angles.into_iter().map(|angle| (0.5 * angle.to_radians()).sin()).product::<f64>();
        let [a, b, c] = corners;
        quality.area += 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
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
