//! A frame around a bounded domain: four vertices so far outside that no cell within the domain reaches them.
//!
//! With them the triangulation's boundary never moves, however the points do, and every point is an inner vertex: the part of its Voronoi cell
//! that lies in the domain is that of the points alone. No set of points is degenerate then, not even one on a line.

use glam::DVec2;

use super::delaunay::hull;
use super::mesh::Triangulation;
use crate::error::Error;
use crate::space::Domain;

/// How far from the domain's centre the frame's vertices stand. The longer side is shorter than 2, so that no place inside is farther from
/// a point than 2.83, or nearer to the frame than 3.5.
const DISTANCE: f64 = 5.0;

/// The directions from the domain's centre in which they stand.
pub(super) const FRAME: [DVec2; 4] = [DVec2::NEG_Y, DVec2::X, DVec2::Y, DVec2::NEG_X];

/// Triangulates distinct points of a bounded domain, in Hilbert order, and the frame's four vertices after them.
pub(super) fn framed(domain: &Domain, mut points: Vec<DVec2>, order: Vec<u32>) -> Result<Triangulation, Error> {
    let centre = domain.land(0.5 * domain.size);
    points.extend(FRAME.map(|direction| centre + DISTANCE * direction));
    hull(domain, points, order)
}
