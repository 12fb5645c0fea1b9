//! [`Aim`]: what points are moved to, and what makes a triangle bad.

use glam::DVec2;

use crate::optimize::PushPull;

/// What a mesh is to be.
#[derive(Debug, Clone, Copy)]
pub(super) struct Aim {
    /// The shortest sides and the largest circumradii that points move to, in local spacings.
    pub distance: f64,
    pub radius: f64,
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

    /// What is easier, where the other cannot be reached.
    pub fn loose() -> Self {
        Self::new(0.81, 0.69, 1.0, GOOD_DEG)
    }

    /// No obtuse triangles.
    pub fn non_obtuse() -> Self {
        Self::new(0.90, 0.63, 1.15, NON_OBTUSE_DEG)
    }

    fn new(distance: f64, radius: f64, relaxation: f64, [least, most]: [f64; 2]) -> Self {
        Self { distance, radius, relaxation, most_cosine: libm::cos(least.to_radians()), least_cosine: libm::cos(most.to_radians()) }
    }

    /// What moves points there; with a tolerance, cells are made alike too.
    pub fn rule(&self, capacity_tolerance: Option<f64>) -> PushPull {
        let &Self { distance, radius, relaxation, .. } = self;
        PushPull { min_distance: Some(distance), coverage_radius: Some(radius), capacity_tolerance, relaxation }
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
