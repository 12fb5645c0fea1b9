//! Several sets that are looked at as one.

use crate::error::Error;
use crate::points::PointSet;

/// The side of a square with one point, in input units.
pub(super) fn mean_spacing(points: &PointSet) -> f64 {
    let [width, height] = points.space().size();
    (width / points.n_points() as f64).sqrt() * height.sqrt()
}

/// Checks that there are sets, that none is empty, and that domains and numbers of points agree well enough for a mean.
pub(super) fn require_alike(sets: &[PointSet]) -> Result<(), Error> {
    /// Sets whose number is a matter of chance differ by a hundredth or two.
    const MOST_APART: f64 = 1.1;
    let refuse = |why: String| Err(Error::Degenerate(why));
    let Some(first) = sets.first() else { return refuse("there are no sets of points".into()) };
    if let Some(other) = sets.iter().find(|points| points.space() != first.space()) {
        return refuse(format!("sets on {} and on {} have no mean spectrum", first.space(), other.space()));
    }
    if first.space().region().is_some() {
        return refuse("in a polygon there is no spectrum: its boundary has one of its own; take the points of a rectangle inside".into());
    }
    let counts = || sets.iter().map(PointSet::n_points);
    let (least, most) = (counts().min().unwrap_or_default(), counts().max().unwrap_or_default());
    if least == 0 {
        return refuse("there are no points".into());
    }
    if most as f64 > MOST_APART * least as f64 {
        return refuse(format!("sets of {least} and of {most} points have no mean spectrum: look at each by itself"));
    }
    Ok(())
}
