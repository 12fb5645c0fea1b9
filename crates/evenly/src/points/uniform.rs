//! [`Uniform`]: independent places, uniform over a domain.

use glam::DVec2;

use super::random::Random;
use crate::space::{Domain, Space};

/// Draws places of a domain.
pub(super) struct Uniform {
    domain: Domain,
    /// Triangles that fill a polygon, and the area of each and of all before it.
    triangles: Vec<[DVec2; 3]>,
    areas: Vec<f64>,
}

impl Uniform {
    pub fn new(space: &Space) -> Self {
        let triangles = space.region().map(|region| region.triangles().to_vec()).unwrap_or_default();
        let mut sum = 0.0;
        let areas = triangles.iter().map(|triangle| {
            sum += area(triangle);
            sum
        });
        let areas = areas.collect();
        Self { domain: space.domain(), triangles, areas }
    }

    pub fn place(&self, random: &mut Random) -> DVec2 {
        let Some(total) = self.areas.last() else {
            let x = random.unit();
            return DVec2::new(x, random.unit()) * self.domain.size;
        };
        let at = random.unit() * total;
        let k = self.areas.partition_point(|&area| area <= at).min(self.triangles.len() - 1);
        place_in(&self.triangles[k], &self.domain, random)
    }
}

pub(super) fn area([a, b, c]: &[DVec2; 3]) -> f64 {
    0.5 * (*b - *a).perp_dot(*c - *a)
}

/// A place in a triangle of a domain.
pub(super) fn place_in(&[a, b, c]: &[DVec2; 3], domain: &Domain, random: &mut Random) -> DVec2 {
    let (mut s, mut t) = (random.unit(), random.unit());
    if s + t > 1.0 {
        (s, t) = (1.0 - s, 1.0 - t);
    }
    domain.inside(a + s * (b - a) + t * (c - a))
}
