//! What a surface mesh is worth: the columns of Table 2 of Ahmed et al. (2017, doi 10.1109/TVCG.2016.2641963), and a certificate for its angles.

use serde::Serialize;

use super::Surface;
use crate::geometry::spacing::triangle_side;
use crate::geometry::triangle::Shape;
use crate::measure::SizeErrors;
use crate::triangulation::{BOUNDARY, prev};

/// Measures of a mesh's triangles, by chords; lengths in input units.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SurfaceQuality {
    /// How many vertices.
    pub n_vertices: usize,
    /// How many triangles.
    pub n_triangles: usize,
    /// How many connected parts.
    pub n_components: usize,
    /// How many edges with one triangle.
    pub n_boundary_edges: usize,
    /// Vertices less edges plus triangles.
    pub euler_characteristic: i64,
    /// The sum of the triangles' areas.
    pub area: f64,
    /// The least quality of a triangle, 6 S / (sqrt(3) p h) with its area S, half its perimeter p and its longest edge h: 1 if it is equilateral (Frey and Borouchaki 1999).
    pub min_quality: f64,
    /// The mean of the same.
    pub mean_quality: f64,
    /// The smallest angle.
    pub min_angle_deg: f64,
    /// The largest angle.
    pub max_angle_deg: f64,
    /// The mean of the triangles' smallest angles.
    pub mean_min_angle_deg: f64,
    /// The root mean square of the angles' differences from 60 degrees.
    pub angle_rms_deg: f64,
    /// The part of the triangles with an angle below 30 degrees.
    pub thin_fraction: f64,
    /// Triangles with an angle above 90 degrees.
    pub obtuse_triangles: usize,
    /// The part of all that they are.
    pub obtuse_fraction: f64,
    /// The part of the vertices inside with 5, 6 or 7 neighbours (V567).
    pub valence_567_fraction: f64,
    /// The part with 6.
    pub valence_6_fraction: f64,
    /// The shortest edge.
    pub min_edge: f64,
    /// The longest edge.
    pub max_edge: f64,
    /// The largest circumradius.
    pub max_circumradius: f64,
    /// The largest circumradius over the shortest edge.
    pub beta: f64,
    /// The edge of equilateral triangles, as many, with the same area: 1 for the two that follow.
    pub spacing: f64,
    /// The shortest edge, relative to the spacing (r_f).
    pub min_distance: f64,
    /// The largest circumradius, relative to the spacing (r_c).
    pub coverage_radius: f64,
    /// How long edges are beside what is wanted, by the vertices' attribute `edge_length`; `None` where there is none.
    #[serde(flatten)]
    pub size_errors: Option<SizeErrors>,
}

/// A triangle whose angles are not certified.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CertificateBreach {
    /// Its number in the given mesh.
    pub triangle: usize,
    /// Its middle, in input units.
    pub at: [f64; 3],
    /// Its smallest angle.
    pub min_angle_deg: f64,
    /// Its largest angle.
    pub max_angle_deg: f64,
}

/// The attribute that tells the wanted length of edges at each vertex.
pub(crate) const SIZE: &str = "edge_length";

/// Angles that are off by less than this are as they should be.
const ROUNDING_DEG: f64 = 1e-6;

/// Measures a surface's triangles as they are.
pub fn surface_quality(surface: &Surface) -> SurfaceQuality {
    let n_triangles = surface.n_triangles();
    let n = n_triangles as f64;
    let mut quality = SurfaceQuality {
        n_vertices: surface.n_vertices(),
        n_triangles,
        n_components: surface.n_components(),
        n_boundary_edges: surface.n_boundary_edges(),
        euler_characteristic: surface.euler_characteristic(),
        area: surface.area(),
        min_quality: f64::INFINITY,
        mean_quality: 0.0,
        min_angle_deg: 180.0,
        max_angle_deg: 0.0,
        mean_min_angle_deg: 0.0,
        angle_rms_deg: 0.0,
        thin_fraction: 0.0,
        obtuse_triangles: 0,
        obtuse_fraction: 0.0,
        valence_567_fraction: 0.0,
        valence_6_fraction: 0.0,
        min_edge: f64::INFINITY,
        max_edge: 0.0,
        max_circumradius: 0.0,
        beta: 0.0,
        spacing: 0.0,
        min_distance: 0.0,
        coverage_radius: 0.0,
        size_errors: size_errors(surface),
    };
    let (mut thin, mut squares) = (0, 0.0);
    for t in 0..n_triangles {
        let shape = Shape::of_space(surface.corners(t));
        let q = shape.quality();
        let [least, largest] = shape.extreme_angles_deg();
        quality.min_quality = quality.min_quality.min(q);
        quality.mean_quality += q / n;
        quality.min_angle_deg = quality.min_angle_deg.min(least);
        quality.max_angle_deg = quality.max_angle_deg.max(largest);
        quality.mean_min_angle_deg += least / n;
        squares += shape.angles_deg.iter().map(|angle| (angle - 60.0).powi(2)).sum::<f64>();
        thin += usize::from(least < 30.0);
        quality.obtuse_triangles += usize::from(shape.is_obtuse());
        quality.min_edge = quality.min_edge.min(shape.shortest());
        quality.max_edge = quality.max_edge.max(shape.longest());
        quality.max_circumradius = quality.max_circumradius.max(shape.circumradius());
    }
    quality.angle_rms_deg = (squares / (3.0 * n)).sqrt();
    quality.thin_fraction = thin as f64 / n;
    quality.obtuse_fraction = quality.obtuse_triangles as f64 / n;
    [quality.valence_567_fraction, quality.valence_6_fraction] = valences(surface);
    quality.beta = quality.max_circumradius / quality.min_edge;
    let spacing = triangle_side(surface.inner_area(), n);
    quality.min_distance = quality.min_edge / spacing;
    quality.coverage_radius = quality.max_circumradius / spacing;
    quality.spacing = surface.frame.length_outward(spacing);
    quality.min_edge = surface.frame.length_outward(quality.min_edge);
    quality.max_edge = surface.frame.length_outward(quality.max_edge);
    quality.max_circumradius = surface.frame.length_outward(quality.max_circumradius);
    quality
}

/// The triangles with an angle outside of what a smallest distance and a coverage radius imply, `beta` being the second over the first: each edge at least as long as the one
/// and each circumradius at most as large as the other make all sines at least 1 / (2 beta), and the largest angle at most 180 degrees less twice the smallest. None for a
/// mesh that keeps both, with one pair for all or another for each triangle.
pub fn certificate(surface: &Surface, beta: f64) -> Vec<CertificateBreach> {
    let least = libm::asin((0.5 / beta).min(1.0)).to_degrees();
    let most = 180.0 - 2.0 * least;
    let breach = |t: usize| {
        let corners = surface.corners(t);
        let [min_angle_deg, max_angle_deg] = Shape::of_space(corners).extreme_angles_deg();
        let is_certified = min_angle_deg >= least - ROUNDING_DEG && max_angle_deg <= most + ROUNDING_DEG;
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        (!is_certified).then(|| CertificateBreach {
            triangle: surface.faces[t],
            at: surface.frame.outward(middle),
            min_angle_deg,
            max_angle_deg,
        })
    };
    (0..surface.n_triangles()).filter_map(breach).collect()
}

/// The ends of each edge once: from its first half-edge.
pub(super) fn edges(surface: &Surface) -> impl Iterator<Item = [usize; 2]> {
    let mesh = &surface.half_edges;
    let first = (0..mesh.origin.len() as u32).filter(|&h| mesh.twin[h as usize] > h);
    first.map(|h| [mesh.origin[h as usize], mesh.target(h)].map(|v| v as usize))
}

fn size_errors(surface: &Surface) -> Option<SizeErrors> {
    let attribute = surface.attributes().iter().find(|attribute| attribute.name == SIZE)?;
    let sizes = surface.of_given(&attribute.values);
    SizeErrors::of(edges(surface).map(|ends| {
        let [a, b] = ends.map(|v| surface.points[v]);
        (surface.frame.length_outward(a.distance(b)), ends.map(|v| sizes[v]))
    }))
}

/// The parts of the vertices inside that have 5 to 7, and 6 neighbours.
fn valences(surface: &Surface) -> [f64; 2] {
    let mesh = &surface.half_edges;
    let mut valence = vec![0u32; surface.n_vertices()];
    let mut is_inside = vec![true; surface.n_vertices()];
    for h in 0..mesh.origin.len() as u32 {
        valence[mesh.origin[h as usize] as usize] += 1;
        if mesh.twin[h as usize] == BOUNDARY || mesh.twin[prev(h) as usize] == BOUNDARY {
            is_inside[mesh.origin[h as usize] as usize] = false;
        }
    }
    let inside: Vec<u32> = valence.into_iter().zip(is_inside).filter(|&(n, is_inside)| n > 0 && is_inside).map(|(n, _)| n).collect();
    let part = |is: &dyn Fn(u32) -> bool| inside.iter().filter(|&&n| is(n)).count() as f64 / inside.len().max(1) as f64;
    [part(&|n| (5..=7).contains(&n)), part(&|n| n == 6)]
}
