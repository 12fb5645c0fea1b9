//! Points with radii of their own: who is nearer than both radii?

use glam::DVec2;

use super::bins::Bins;
use crate::density::Field;
use crate::space::Domain;

/// Points in bins as wide as their radii, to a factor of two.
pub(super) struct RadiusBins {
    /// From wide to narrow, each half as wide as the one before.
    levels: Vec<Level>,
    widest: f64,
    n_points: u32,
}

struct Level {
    bins: Bins,
    radii: Vec<f64>,
    numbers: Vec<u32>,
}

/// Bins are narrowed no more often than this: it would take too many.
const MOST_LEVELS: usize = 12;

impl RadiusBins {
    /// Empty bins, for radii up to the first length, and about down to the second.
    pub fn new(domain: &Domain, widest: f64, narrowest: f64) -> Self {
        let n_levels = (libm::log2(widest / narrowest).floor().max(0.0) as usize + 1).min(MOST_LEVELS);
        let level = |k: usize| Level { bins: Bins::new(domain, widest / (1 << k) as f64), radii: Vec::new(), numbers: Vec::new() };
        Self { levels: (0..n_levels).map(level).collect(), widest, n_points: 0 }
    }

    /// Points are numbered as they come.
    pub fn push(&mut self, place: DVec2, radius: f64) {
        let level = (libm::log2(self.widest / radius).max(0.0) as usize).min(self.levels.len() - 1);
        let level = &mut self.levels[level];
        level.bins.push(place);
        level.radii.push(radius);
        level.numbers.push(self.n_points);
        self.n_points += 1;
    }

    /// The points that are nearer to a place than the smaller of this radius and their own: their numbers, and the distance relative to that.
    pub fn near(&self, place: DVec2, radius: f64) -> impl Iterator<Item = (u32, f64)> {
        self.levels.iter().flat_map(move |level| {
            level.bins.near(place).filter_map(move |(index, way)| {
                let smaller = radius.min(level.radii[index as usize]);
                let squared = way.length_squared();
                (squared < smaller * smaller).then(|| (level.numbers[index as usize], squared.sqrt() / smaller))
            })
        })
    }
}

/// Densities are taken to be within this factor of the mean where a radius comes of them.
const RANGE: f64 = 1e4;

/// The radius at a place: this long where the density is 1, in proportion to the local spacing.
pub(super) fn radius(field: &Field, place: DVec2, mean: f64) -> f64 {
    mean / field.at(place).clamp(1.0 / RANGE, RANGE).sqrt()
}

/// Bins for radii that come of a density; of those that are the smallest by far several points share a bin.
pub(super) fn bins_for(domain: &Domain, mean: f64) -> RadiusBins {
    RadiusBins::new(domain, (mean * RANGE.sqrt()).min(domain.size.max_element()), mean / 4.0)
}
