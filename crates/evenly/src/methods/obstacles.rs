//! What stands in the way of targets: islands too small for them, boundaries, fixed points, gaps in a
//! density.

use super::prepare::triangulated;
use super::targets::{ROUNDING, Targets};
use crate::error::Error;
use crate::measure::{PointMeasures, measure_each};
use crate::points::PointSet;
use crate::run::{Outcome, Report, RunContext};
use crate::space::{Boundary, Space};
use crate::star::Senses;
use crate::triangulation::{LiveMesh, StarBuffer};

/// What keeps a point from its targets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Obstacle {
    /// It lies on an island with less than the area of one point.
    Island,
    /// It, or a neighbour, is fixed.
    FixedPoint,
    /// The boundary of a polygon cuts its cell.
    Boundary,
    /// Its cell reaches into a gap in the density.
    Gap,
    /// None of these.
    Others,
}

/// In the order in which they are told.
const ALL: [(Obstacle, &str); 5] = [
    (Obstacle::Island, " on islands with less than the area of one point"),
    (Obstacle::FixedPoint, " at fixed points"),
    (Obstacle::Boundary, " at the boundary"),
    (Obstacle::Gap, " at gaps in the density"),
    (Obstacle::Others, " elsewhere"),
];

/// The method that has no other target than the smallest distance.
const FARTHEST_POINT: &str = "farthest-point";
/// A side of a cell this much thinner than the cell itself lies in a gap.
const THIN: f64 = 0.01;

/// Says in the report what stands in the way where a run has ended without its targets.
pub(super) fn conclude(points: &PointSet, targets: &dyn Targets, report: &mut Report) {
    report.note_limit();
    if matches!(report.outcome, Outcome::Forced | Outcome::IterationLimit) {
        // Points that cannot be measured have no places to tell of.
        report.notes.extend(obstacle_notes(points, targets, report.method).unwrap_or_default());
    }
}

/// How many points miss their targets, what is in their way and where the worst of each kind is.
fn obstacle_notes(points: &PointSet, targets: &dyn Targets, method: &str) -> Result<Vec<String>, Error> {
    let mut notes: Vec<String> = islands(points.space(), points.n_points()).into_iter().collect();
    let each = measure_each(points)?;
    let misses: Vec<f64> = each.iter().map(|point| targets.miss(point)).collect();
    let obstacles = obstacles(points)?;
    let is_free = obstacles.iter().all(|&obstacle| obstacle == Obstacle::Others);
    for (kind, place) in ALL {
        let missing = (0..each.len()).filter(|&k| obstacles[k] == kind && misses[k] > ROUNDING);
        let Some(worst) = missing.clone().max_by(|&a, &b| misses[a].total_cmp(&misses[b])) else { continue };
        let PointMeasures { nearest, reach, capacity, .. } = each[worst];
        let [x, y] = points.positions()[worst];
        let n = missing.count();
        let place = if is_free { "" } else { place };
        let which = if n == 1 { format!("1 point{place} misses") } else { format!("{n} points{place} miss") };
        notes.push(format!(
            "{which} a target; the worst is point {worst} at ({x}, {y}): nearest {nearest:.3}, reach {reach:.3}, capacity {capacity:.3}"
        ));
        if kind == Obstacle::FixedPoint && points.density().is_uniform() && method != FARTHEST_POINT {
            notes.push(format!("the method {FARTHEST_POINT} makes the smallest distance as large as the fixed points allow"));
        }
    }
    Ok(notes)
}

/// For each point the first obstacle that applies.
fn obstacles(points: &PointSet) -> Result<Vec<Obstacle>, Error> {
    let n_points = points.n_points();
    let mut found = vec![Obstacle::Others; n_points];
    let mut scratch = Report::new("", n_points);
    let Some((domain, mut mesh)) = triangulated(points, &mut scratch, &mut RunContext::default())? else { return Ok(found) };
    let least = domain.area() / n_points as f64;
    let senses = Senses { mass: true, ..Senses::default() };
    let seen = mesh.look(senses, |mesh, v, buffer| first_of(mesh, v, buffer, least))?;
    for (point, obstacle) in mesh.into_order().into_iter().zip(seen) {
        found[point as usize] = obstacle;
    }
    Ok(found)
}

fn first_of(mesh: &LiveMesh, v: u32, StarBuffer { star, spokes, sight, .. }: &StarBuffer, least_area: f64) -> Obstacle {
    let part_area = |boundary: &Boundary| boundary.part_areas()[boundary.part_of(mesh.position(v))];
    let densest = star.metric.sides.iter().copied().fold(0.0, f64::max);
    if mesh.boundary().is_some_and(|boundary| part_area(boundary) < least_area) {
        Obstacle::Island
    } else if mesh.is_at_fixed(v, spokes) {
        Obstacle::FixedPoint
    } else if !sight.outline.is_empty() {
        Obstacle::Boundary
    } else if star.metric.sides.iter().any(|&side| side < THIN * densest) {
        Obstacle::Gap
    } else {
        Obstacle::Others
    }
}

/// How many islands have less than the area of one point, and where the largest of them is.
fn islands(space: &Space, n_points: usize) -> Option<String> {
    let (region, domain) = (space.region()?, space.domain());
    let boundary = domain.boundary.as_ref()?;
    let least = domain.area() / n_points as f64;
    let areas = boundary.part_areas();
    let small = || (0..areas.len()).filter(|&part| areas[part] < least);
    let largest = small().max_by(|&a, &b| areas[a].total_cmp(&areas[b]))?;
    let [a, b, c] = *region.parts().nth(largest)?.first()?;
    let [x, y] = domain.restore((a + b + c) / 3.0);
    let n = small().count();
    let which = if n == 1 { "1 island has".into() } else { format!("{n} islands have") };
    Some(format!("{which} less than the area of one point, where targets may not hold; the largest is at ({x}, {y})"))
}
