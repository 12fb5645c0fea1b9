//! What every optimiser begins with: points that a triangulation can tell apart, in the order in which they lie.

use glam::DVec2;

use crate::density::Field;
use crate::error::Error;
use crate::points::{PointSet, leave_line, make_distinct, separate};
use crate::run::{Phase, Report, RunContext};
use crate::space::Domain;
use crate::triangulation::LiveMesh;

/// Distinct points in normalised coordinates.
pub(super) struct Prepared {
    pub domain: Domain,
    /// The hexagonal spacing.
    pub spacing: f64,
    /// Along the Hilbert curve.
    pub positions: Vec<DVec2>,
    /// The caller's index of each.
    pub order: Vec<u32>,
    /// The density, where it varies.
    pub field: Option<Field>,
}

/// Separates what coincides or lies on one line, and says so in the report; `None` for fewer than three points, which stay.
///
/// # Errors
/// [`Error::TooFine`] where f64 cannot tell the points apart.
pub(super) fn prepare(points: &PointSet, report: &mut Report, run: &mut RunContext) -> Result<Option<Prepared>, Error> {
    points.space().require_resolution(points.n_points().max(1))?;
    if points.n_points() < 3 {
        report.notes.push("fewer than three points: nothing to optimise, they come back as they are".into());
        return Ok(None);
    }
    if points.n_fixed() == points.n_points() {
        report.notes.push("all points stay where they are: nothing to optimise".into());
        return Ok(None);
    }
    run.enter(Phase::Separate);
    let (domain, mut positions) = points.normalized();
    let spacing = domain.hex_spacing(positions.len());
    let has_left_line = leave_line(points.space(), &mut positions, points.n_fixed(), spacing);
    let separated = separate(&domain, &mut positions, points.n_fixed(), spacing);
    report.coincident_points = separated.coincident_points;
    report.was_collinear = separated.was_collinear || has_left_line;
    let order = separated.order;
    let positions = order.iter().map(|&index| positions[index as usize]).collect();
    let field = points.field(&domain);
    Ok(Some(Prepared { domain, spacing, positions, order, field }))
}

/// Distinct points, and a mesh of them that is ready for moves; `None` for fewer than three points, which stay.
///
/// # Errors
/// As [`prepare`]; [`Error::Degenerate`] where they cannot be triangulated.
pub(super) fn triangulated(points: &PointSet, report: &mut Report, run: &mut RunContext) -> Result<Option<(Domain, LiveMesh)>, Error> {
    let Some(Prepared { domain, spacing, positions, order, field }) = prepare(points, report, run)? else { return Ok(None) };
    run.enter(Phase::Triangulate);
    let mesh = LiveMesh::new(&domain, field, positions, order, spacing)?.with_fixed(points.n_fixed());
    report.triangulations = 1;
    run.enter(Phase::Optimize);
    Ok(Some((domain, mesh)))
}

/// # Errors
/// [`Error::InvalidParameter`] where the density varies.
pub(super) fn require_uniform(points: &PointSet) -> Result<(), Error> {
    if !points.density().is_uniform() {
        let expected = "uniform for opt-beta, cvt and farthest-point, which go by distances alone";
        return Err(Error::InvalidParameter { name: "density", value: "varying".into(), expected });
    }
    Ok(())
}

/// # Errors
/// [`Error::InvalidParameter`] for no iterations.
pub(super) fn validate_iterations(iterations: usize) -> Result<(), Error> {
    if iterations == 0 {
        return Err(Error::InvalidParameter { name: "iterations", value: "0".into(), expected: "1 or more" });
    }
    Ok(())
}

/// Moves apart what rounding to input units has brought together: points much nearer than the spacing.
pub(super) fn keep_distinct(points: &mut PointSet) {
    let (domain, mut positions) = points.normalized();
    let spacing = domain.hex_spacing(positions.len());
    // By more than rounding can take back.
    let resolution = points.space().resolution() * spacing / points.hex_spacing();
    let (_, coincident_points) = make_distinct(&domain, &mut positions, points.n_fixed(), spacing.max(1e4 * resolution));
    if coincident_points > 0 {
        let all: Vec<u32> = (0..positions.len() as u32).collect();
        points.place(&domain, &all, &positions);
    }
}
