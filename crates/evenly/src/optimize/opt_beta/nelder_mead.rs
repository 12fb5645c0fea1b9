//! Nelder and Mead's simplex method in the plane, for a given number of steps.
//!
//! "A Simplex Method for Function Minimization", The Computer Journal 7(4), 1965, doi 10.1093/comjnl/7.4.308, with its coefficients: reflection 1,
//! expansion 2, contraction and shrinkage 1/2.

use glam::DVec2;

/// A corner of the simplex, and the value there.
type Corner = (DVec2, f64);

/// The best place that is found from a simplex at `start`, `start + (side, 0)` and `start + (0, side)`, and the value there.
pub(super) fn minimize(mut value: impl FnMut(DVec2) -> f64, start: DVec2, side: f64, n_steps: usize) -> (DVec2, f64) {
    let mut at = |place: DVec2| -> Corner { (place, value(place)) };
    let mut simplex = [at(start), at(start + DVec2::new(side, 0.0)), at(start + DVec2::new(0.0, side))];
    for _ in 0..n_steps {
        simplex.sort_by(|a, b| a.1.total_cmp(&b.1));
        let [best, middle, worst] = simplex;
        let centre = 0.5 * (best.0 + middle.0);
        let away = centre - worst.0;
        let reflected = at(centre + away);
        simplex[2] = if reflected.1 < best.1 {
            better(at(centre + 2.0 * away), reflected)
        } else if reflected.1 < middle.1 {
            reflected
        } else {
            let outer = better(reflected, worst);
            let contracted = at(0.5 * (centre + outer.0));
            if contracted.1 < outer.1 {
                contracted
            } else {
                simplex[1] = at(0.5 * (best.0 + middle.0));
                at(0.5 * (best.0 + worst.0))
            }
        };
    }
    simplex.into_iter().reduce(better).unwrap_or((start, f64::INFINITY))
}

/// The first, unless the second is better.
fn better(a: Corner, b: Corner) -> Corner {
    if b.1 < a.1 { b } else { a }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bowl_leads_to_its_bottom() {
        let bowl = |p: DVec2| (p.x - 0.3).powi(2) + 2.0 * (p.y + 0.2).powi(2);
        let (place, value) = minimize(bowl, DVec2::ZERO, 0.1, 60);
        assert!(place.distance(DVec2::new(0.3, -0.2)) < 1e-6 && value < 1e-12);
    }

    #[test]
    fn no_step_makes_it_worse() {
        let rough = |p: DVec2| (7.0 * p.x).sin() + (9.0 * p.y).cos() + p.length_squared();
        let mut last = rough(DVec2::ZERO);
        for n_steps in 0..20 {
            let (_, value) = minimize(rough, DVec2::ZERO, 0.1, n_steps);
            assert!(value <= last);
            last = value;
        }
    }
}
