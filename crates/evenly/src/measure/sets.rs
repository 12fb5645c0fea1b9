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
    let Some(first) = sets.first() else { return Err(Error::Degenerate("there are no sets of points".into())) };
    for points in sets {
        let (n, m) = (points.n_points() as f64, first.n_points() as f64);
        if points.n_points() == 0 {
            return Err(Error::Degenerate("there are no points".into()));
        }
        if points.space() != first.space() {
            return Err(Error::Degenerate(format!("sets on {} and on {} have no mean spectrum", first.space(), points.space())));
        }
        if n > MOST_APART * m || m > MOST_APART * n {
            return Err(Error::Degenerate(format!("sets of {m} and of {n} points have no mean spectrum: look at each by itself")));
        }
    }
    Ok(())
}
