//! [`Aim`]: what points are moved to, and what makes a triangle bad.

use glam::DVec2;

use crate::methods::{PushPull, PushPullParams, angle_bounds_deg};

/// What a mesh is to be.
#[derive(Debug, Clone, Copy)]
pub(super) struct Aim {
    /// The shortest sides and the largest circumradii that points move to, in local spacings.
    pub distance: Option<f64>,
    pub radius: Option<f64>,
    pub relaxation: f64,
    /// A triangle is bad with an angle whose cosine is more than this.
    most_cosine: f64,
    /// And with one whose cosine is less than that.
    least_cosine: f64,
}

/// Angles that are good enough, in degrees: smaller and larger ones are repaired.
const GOOD_DEG: [f64; 2] = [35.5, 109.0];
/// The same where no triangle is to be obtuse; rounding leaves a right angle what it is.
const NON_OBTUSE_DEG: [f64; 2] = [40.0, 90.0 + 1e-7];

impl Aim {
    /// Angles of 42 to 95 degrees where nothing is in the way.
    pub fn plain() -> Self {
        Self::new(0.87, 0.645, 1.1, GOOD_DEG)
    }

    /// What a method's targets imply.
    pub fn of(targets: &PushPullParams, is_non_obtuse: bool) -> Self {
        let &PushPullParams { min_distance, coverage_radius, relaxation, .. } = targets;
        let plain = Self::plain();
        // The usual lengths are more than what is good enough.
        let is_usual = (min_distance, coverage_radius) == (plain.distance, plain.radius);
        let of_beta =
            min_distance.filter(|_| !is_usual).zip(coverage_radius).and_then(|(distance, radius)| angle_bounds_deg(radius / distance));
        let [least, most] = of_beta.map_or(GOOD_DEG, |[least, most]| [least.max(GOOD_DEG[0]), most.min(GOOD_DEG[1])]);
        let good = if is_non_obtuse { [least.max(NON_OBTUSE_DEG[0]), most.min(NON_OBTUSE_DEG[1])] } else { [least, most] };
        Self { distance: min_distance, radius: coverage_radius, ..Self::new(0.0, 0.0, relaxation, good) }
    }

    /// What is easier, where that cannot be reached.
    pub fn loosened(self) -> Self {
        Self {
            distance: self.distance.map(|d| d.min(0.81)),
            radius: self.radius.map(|r| r.max(0.69)),
            relaxation: self.relaxation.min(1.0),
            ..self
        }
    }

    /// No obtuse triangles.
    pub fn non_obtuse() -> Self {
        Self::new(0.90, 0.63, 1.15, NON_OBTUSE_DEG)
    }

    fn new(distance: f64, radius: f64, relaxation: f64, [least, most]: [f64; 2]) -> Self {
        Self {
            distance: Some(distance),
            radius: Some(radius),
            relaxation,
            most_cosine: libm::cos(least.to_radians()),
            least_cosine: libm::cos(most.to_radians()),
        }
    }

    /// What moves points there; with a tolerance, cells are made alike too.
    pub fn rule(&self, capacity_tolerance: Option<f64>) -> PushPull {
        let &Self { distance, radius, relaxation, .. } = self;
        PushPull { min_distance: distance, coverage_radius: radius, capacity_tolerance, relaxation }
    }

    /// How bad a triangle is; 0 if it is good.
    pub fn badness(&self, corners: [DVec2; 3]) -> f64 {
        cosines(corners).into_iter().map(|cosine| (cosine - self.most_cosine).max(self.least_cosine - cosine).max(0.0)).sum()
    }
}

/// The cosines of a triangle's angles.
pub(super) fn cosines([a, b, c]: [DVec2; 3]) -> [f64; 3] {
    let cosine = |at: DVec2, one: DVec2, other: DVec2| {
        (one - at).dot(other - at) / ((one - at).length() * (other - at).length()).max(f64::MIN_POSITIVE)
    };
    [cosine(a, b, c), cosine(b, c, a), cosine(c, a, b)]
}
