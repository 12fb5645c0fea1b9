//! Square bins for points: who is near?

use glam::DVec2;

use crate::space::Domain;

/// Points by the bin in which they lie.
pub(crate) struct Bins {
    domain: Domain,
    n_bins: [usize; 2],
    /// The last point that came into each bin, and for each point the one before it there.
    last: Vec<u32>,
    before: Vec<u32>,
    places: Vec<DVec2>,
}

/// The most bins of a polygon's frame.
const MOST_BINS: f64 = 1e7;
/// No point.
const NONE: u32 = u32::MAX;

impl Bins {
    /// Empty bins, whose sides are `reach` at least.
    pub fn new(domain: &Domain, reach: f64) -> Self {
        let mut n_bins = (domain.size / reach).floor().max(DVec2::ONE);
        // A polygon may have its parts far from each other.
        if domain.boundary.is_some() && n_bins.x * n_bins.y > MOST_BINS {
            n_bins = (n_bins * (MOST_BINS / (n_bins.x * n_bins.y)).sqrt()).floor().clamp(DVec2::ONE, DVec2::splat(MOST_BINS.sqrt()));
        }
        let n_bins = n_bins.to_array().map(|n| n as usize);
        Self { domain: domain.clone(), n_bins, last: vec![NONE; n_bins[0] * n_bins[1]], before: Vec::new(), places: Vec::new() }
    }

    pub fn push(&mut self, place: DVec2) {
        let [column, row] = self.bin(place);
        let last = &mut self.last[column + row * self.n_bins[0]];
        self.before.push(*last);
        *last = self.places.len() as u32;
        self.places.push(place);
    }

    pub fn places(&self) -> &[DVec2] {
        &self.places
    }

    fn bin(&self, place: DVec2) -> [usize; 2] {
        let n_bins = DVec2::new(self.n_bins[0] as f64, self.n_bins[1] as f64);
        (place / self.domain.size * n_bins).min(n_bins - 1.0).to_array().map(|at| at as usize)
    }

    /// The points that may lie within a bin's side of a place, and the ways there: each once, along the shortest way.
    pub fn near(&self, place: DVec2) -> impl Iterator<Item = (u32, DVec2)> {
        let [column, row] = self.bin(place);
        let columns = neighbours(column, self.n_bins[0], self.domain.is_periodic);
        let rows = neighbours(row, self.n_bins[1], self.domain.is_periodic);
        let bins = rows.flat_map(move |row| columns.clone().map(move |column| column + row * self.n_bins[0]));
        bins.flat_map(move |bin| {
            let held = |index: u32| (index != NONE).then_some(index);
            let points = std::iter::successors(held(self.last[bin]), move |&point| held(self.before[point as usize]));
            points.map(move |point| (point, self.domain.spoke(place, self.places[point as usize])))
        })
    }
}

/// A bin's number and those beside it, each once.
fn neighbours(bin: usize, n_bins: usize, is_periodic: bool) -> impl Iterator<Item = usize> + Clone {
    let (first, n) = match (is_periodic, n_bins) {
        (_, 1..=2) => (0, n_bins),
        (true, _) => (bin + n_bins - 1, 3),
        (false, _) => (bin.saturating_sub(1), (bin + 2).min(n_bins) - bin.saturating_sub(1)),
    };
    (first..first + n).map(move |bin| bin % n_bins)
}
