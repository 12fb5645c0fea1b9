//! [`measure_each`]: what each point adds to the measures, so that what is wrong can be found.

use serde::Serialize;

use super::distinct::Distinct;
use super::sight::{Seen, look};
use super::star::{StarMeasures, StarReader};
use super::weighted::weigh;
use crate::error::Error;
use crate::points::PointSet;

/// What one point has around it. Lengths in hexagonal spacings, the area in mean capacities; by the density, where that varies.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PointMeasures {
    /// Distance to the nearest other point; infinite where none is seen.
    pub nearest: f64,
    /// Distance from the farthest place of its Voronoi cell to the nearest point.
    pub reach: f64,
    /// Area of its Voronoi cell; in a polygon of several parts in the mean of its part.
    pub capacity: f64,
    /// Whether that cell stays clear of a polygon's boundary. True in other domains.
    pub is_inner: bool,
}

/// Measures each point of a set of at least three, not all on one line, in the order of the points. Points that share a place share a cell.
///
/// # Errors
/// As [`measure`](super::measure).
pub fn measure_each(points: &PointSet) -> Result<Vec<PointMeasures>, Error> {
    let distinct = Distinct::triangulate(points)?;
    let Distinct { triangulation, is_shared, vertex_of, .. } = &distinct;
    let (domain, n_distinct) = (distinct.domain(), triangulation.n_base());
    let (mean_capacity, spacing) = (domain.area() / n_distinct as f64, domain.hex_spacing(points.n_points()));
    let of = |star: &StarMeasures, is_inner: bool| PointMeasures {
        nearest: star.nearest / spacing,
        reach: star.reach / spacing,
        capacity: star.capacity / mean_capacity,
        is_inner,
    };
    let measured = if let Some(field) = points.field(&domain) {
        weigh(&mut distinct.live(Some(field))?.in_units_of(spacing), &domain, spacing)?
    } else if domain.boundary.is_some() {
        let seen = |seen: Seen| of(&seen.measures(), seen.is_inner);
        look(&mut distinct.live(None)?, 0.0, seen)?
    } else {
        let outgoing = triangulation.half_edges.outgoing(triangulation.positions.len());
        let mut reader = StarReader::new(triangulation, &outgoing);
        (0..n_distinct).map(|vertex| of(&reader.read(vertex), true)).collect()
    };
    let alone = measured
        .iter()
        .zip(is_shared)
        .map(|(&each, &is_shared)| PointMeasures { nearest: if is_shared { 0.0 } else { each.nearest }, ..each });
    let alone: Vec<PointMeasures> = alone.collect();
    Ok(vertex_of.iter().map(|&vertex| alone[vertex as usize]).collect())
}
