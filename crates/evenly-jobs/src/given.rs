//! Points as they are given: in their domain, those that stay first, and what they follow.

use std::collections::HashSet;

use evenly::{Density, PointSet, Space};

use crate::error::Error;
use crate::message::Message;
use crate::resource::{Pixels, Positions, Resource, Resources, called};
use crate::space::{Domain, Metric, Place};

/// The density; uniform if none is given.
pub(crate) fn density_of(density: Option<&Resource<Pixels>>, resources: &mut dyn Resources) -> Result<Density, Error> {
    density.map_or(Ok(Density::uniform()), |density| density.get(resources))
}

/// The points that stay; none, if none are given.
pub(crate) fn fixed_of(fixed: Option<&Resource<Positions>>, space: &Space, resources: &mut dyn Resources) -> Result<PointSet, Error> {
    let positions = fixed.map_or(Ok(Vec::new()), |fixed| fixed.get(resources))?;
    let n_fixed = positions.len();
    let points = PointSet::new(space, positions).and_then(|points| points.with_fixed(n_fixed));
    points.map_err(|error| Error::of(error, called(fixed), &[("n_fixed", "fixed")]))
}

/// Points in a domain, and what was done to it and to them: those outside of a torus are wrapped into it.
///
/// # Errors
/// As [`Resources::positions`] and [`PointSet::new`]; points outside of a domain that nobody has named.
pub fn positioned(
    points: &Resource<Positions>,
    domain: Option<&Domain>,
    resources: &mut dyn Resources,
) -> Result<(PointSet, Vec<Message>), Error> {
    let positions = points.get(resources)?;
    let carried = resources.extent(points.called());
    let Place { space, is_assumed, mut notes } = Domain::place(domain, carried, resources)?;
    let n_outside = positions.iter().filter(|p| is_outside(&space, p)).count();
    let [lie, were] =
        if n_outside == 1 { ["1 point lies".to_owned(), "was".into()] } else { [format!("{n_outside} points lie"), "were".into()] };
    let is_finite = positions.iter().flatten().all(|x| x.is_finite());
    if n_outside > 0 && is_assumed && is_finite {
        let bound = |of: fn(f64, f64) -> f64| [0, 1].map(|axis| positions.iter().map(|p| p[axis]).reduce(of).unwrap_or(0.0));
        let ([x, y], [right, top]) = (bound(f64::min), bound(f64::max));
        let outside = format!("{}: {lie} outside the {} {space}, which was assumed; ", points.called(), space.kind());
        let span = Message::from(format!("{outside}they span ({x}, {y}) to ({right}, {top}): give their "));
        return Err(span.name("size").text(", and ").name("origin").text(" where that is not 0,0").into());
    }
    let set = PointSet::new(&space, positions).map_err(|error| Error::of(error, points.called(), &[]))?;
    if n_outside > 0 {
        let note = Message::from(format!("{lie} outside the torus {space} and {were} wrapped into it; are ")).name("size").text(" and ");
        notes.push(note.name("origin").text(" right?"));
    }
    Ok((set, notes))
}

fn is_outside(space: &Space, p: &[f64; 2]) -> bool {
    let (origin, size) = (space.origin(), space.size());
    (0..2).any(|axis| p[axis] < origin[axis] || p[axis] > origin[axis] + size[axis])
}

/// Points that stay, and after them the others that do not share a place with one.
pub(crate) fn joined(fixed: &PointSet, points: PointSet) -> Result<PointSet, Error> {
    if fixed.n_points() == 0 {
        return Ok(points);
    }
    let bits = |p: &[f64; 2]| p.map(|x| (x + 0.0).to_bits());
    let taken: HashSet<[u64; 2]> = fixed.positions().iter().map(bits).collect();
    let others = points.positions().iter().filter(|p| !taken.contains(&bits(p)));
    let all = fixed.positions().iter().chain(others).copied().collect();
    Ok(PointSet::new(points.space(), all)?.with_fixed(fixed.n_points())?)
}

/// The points as distances count, and as they were given if that differs.
pub(crate) fn measured_in(metric: Metric, points: PointSet) -> Result<(PointSet, Option<PointSet>), Error> {
    match metric {
        Metric::Input => Ok((points, None)),
        Metric::Unit => Ok((points.in_unit_square()?, Some(points))),
    }
}
