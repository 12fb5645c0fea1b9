//! A set of points, ready to be summed to waves.

use crate::points::PointSet;

/// A pair with what belongs to the domain's shorter side first, which has the fewer frequencies.
pub(super) fn by_short_side<T>(half: [usize; 2], [x, y]: [T; 2]) -> [T; 2] {
    if half[0] <= half[1] { [x, y] } else { [y, x] }
}

/// One set, ready to be summed to waves; x is along the domain's shorter side.
pub(super) struct Waves {
    /// Places in the domain as shares of its sides, in [0, 1].
    pub x: Vec<f64>,
    pub y: Vec<f64>,
    /// What each point counts: 1 on a torus, less near a rectangle's boundary.
    pub weight: Vec<f64>,
    pub half: [usize; 2],
    has_window: bool,
}

impl Waves {
    /// `half` is that of the domain's sides.
    pub fn new(points: &PointSet, half: [usize; 2]) -> Self {
        let (domain, positions) = points.normalized();
        let has_window = !domain.is_periodic;
        let share = |axis: usize| positions.iter().map(|p| p[axis] / domain.size[axis]).collect();
        let [x, y]: [Vec<f64>; 2] = by_short_side(half, [share(0), share(1)]);
        let window = |t: f64| libm::sin(std::f64::consts::PI * t).powi(2);
        let weight = x.iter().zip(&y).map(|(&x, &y)| if has_window { window(x) * window(y) } else { 1.0 }).collect();
        Self { x, y, weight, half: by_short_side(half, half), has_window }
    }

    /// What white noise has, on average: n times the mean square of the window.
    pub fn white_power(&self) -> f64 {
        let share = if self.has_window { (3.0f64 / 8.0).powi(2) } else { 1.0 };
        share * self.x.len() as f64
    }

    /// What the mean density alone would sum to, seen through the window; real. On a torus nothing is taken off: the power at 0 is n.
    pub fn of_density(&self, a: usize, b: i64) -> f64 {
        let wave = |k: u64| [0.5, -0.25].get(k as usize).copied().unwrap_or(0.0);
        if self.has_window { self.x.len() as f64 * wave(a as u64) * wave(b.unsigned_abs()) } else { 0.0 }
    }
}
