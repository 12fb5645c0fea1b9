//! Nelder and Mead's simplex method in the plane or along a line, for a given number of steps.
//!
//! "A Simplex Method for Function Minimization", The Computer Journal 7(4), 1965, doi 10.1093/comjnl/7.4.308, with its coefficients: reflection 1,
//! expansion 2, contraction and shrinkage 1/2.

use glam::DVec2;

/// A corner of the simplex, and the value there.
type Corner = (DVec2, f64);

/// The best place that is found from a simplex with these corners, and the value there: from three in the plane they span, from two on the line.
pub(super) fn minimize<const N: usize>(mut value: impl FnMut(DVec2) -> f64, corners: [DVec2; N], n_steps: usize) -> Corner {
    let mut at = |place: DVec2| -> Corner { (place, value(place)) };
    let mut simplex = corners.map(&mut at);
    for _ in 0..n_steps {
        simplex.sort_by(|a, b| a.1.total_cmp(&b.1));
        let (best, next_to_worst, worst) = (simplex[0], simplex[N - 2], simplex[N - 1]);
        let others = simplex[..N - 1].iter().map(|corner| corner.0).sum::<DVec2>();
        let centre = others / (N - 1) as f64;
        let away = centre - worst.0;
        let reflected = at(centre + away);
        simplex[N - 1] = if reflected.1 < best.1 {
            better(at(centre + 2.0 * away), reflected)
        } else if reflected.1 < next_to_worst.1 {
            reflected
        } else {
            let outer = better(reflected, worst);
            let contracted = at(0.5 * (centre + outer.0));
            if contracted.1 < outer.1 {
                contracted
            } else {
                simplex[1..N - 1].iter_mut().for_each(|corner| *corner = at(0.5 * (best.0 + corner.0)));
                at(0.5 * (best.0 + worst.0))
            }
        };
    }
    simplex.into_iter().reduce(better).unwrap_or((DVec2::ZERO, f64::INFINITY))
}

/// The first, unless the second is better.
fn better(a: Corner, b: Corner) -> Corner {
    if b.1 < a.1 { b } else { a }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle(side: f64) -> [DVec2; 3] {
        [DVec2::ZERO, DVec2::new(side, 0.0), DVec2::new(0.0, side)]
    }

    #[test]
    fn two_corners_stay_on_their_line() {
        let bowl = |p: DVec2| (p.x - 0.3).powi(2) + 2.0 * (p.y + 0.2).powi(2);
        let direction = DVec2::from_angle(0.7);
        let (place, _) = minimize(bowl, [DVec2::ZERO, 0.1 * direction], 60);
        // Where the bowl's slope is across the line.
        let least = (0.3 * direction.x - 0.4 * direction.y) / (direction.x.powi(2) + 2.0 * direction.y.powi(2));
        assert!(place.distance(least * direction) < 1e-6, "{place}");
    }

    #[test]
    fn a_bowl_leads_to_its_bottom() {
        let bowl = |p: DVec2| (p.x - 0.3).powi(2) + 2.0 * (p.y + 0.2).powi(2);
        let (place, value) = minimize(bowl, triangle(0.1), 60);
        assert!(place.distance(DVec2::new(0.3, -0.2)) < 1e-6 && value < 1e-12);
    }

    #[test]
    fn no_step_makes_it_worse() {
        let rough = |p: DVec2| (7.0 * p.x).sin() + (9.0 * p.y).cos() + p.length_squared();
        let mut last = rough(DVec2::ZERO);
        for n_steps in 0..20 {
            let (_, value) = minimize(rough, triangle(0.1), n_steps);
            assert!(value <= last);
            last = value;
        }
    }
}
