//! How many points there are at each distance from a point: the pair correlation, counted pair by pair.

use rayon::prelude::*;

use super::rows::Rows;
use crate::error::Error;
use crate::points::{PointSet, hilbert_order};

/// Bins of distances in a mean spacing.
pub(crate) const BINS: usize = 200;

/// The pair correlation of a set in `n_bins` bins of 1 / [`BINS`] of each point's own `spacing`, a length of the normalised domain.
pub(super) fn correlate(points: &PointSet, n_bins: usize, spacing: &(impl Fn(usize) -> f64 + Sync)) -> Result<Vec<f64>, Error> {
    /// Points whose pairs are counted in one go.
    const CHUNK: usize = 1 << 10;
    let (domain, positions) = points.normalized();
    let n_points = positions.len();
    // Neighbours side by side in memory.
    let order = hilbert_order(&positions, domain.size);
    let rows = Rows::new(&domain, &positions, 4.0);
    let reach = |index: usize| n_bins as f64 / BINS as f64 * spacing(index);
    let is_clear = |index: usize| domain.room(positions[index]) >= reach(index) * (1.0 - 1e-12);
    let centres: Vec<usize> = order.iter().map(|&index| index as usize).filter(|&index| is_clear(index)).collect();
    if centres.is_empty() {
        return Err(Error::Degenerate("no point is far enough from the boundary for a spectrum".into()));
    }
    let counted = centres.par_chunks(CHUNK).map(|chunk| {
        let mut counts = vec![0u64; n_bins];
        for &index in chunk {
            let (place, scale) = (positions[index], BINS as f64 / spacing(index));
            rows.near(place, reach(index), |others, shift| {
                let place = place - shift;
                for &other in others {
                    if let Some(count) = counts.get_mut(((other - place).length() * scale) as usize) {
                        *count += 1;
                    }
                }
            });
            // Itself.
            counts[0] -= 1;
        }
        counts
    });
    let add = |mut a: Vec<u64>, b: Vec<u64>| {
        a.iter_mut().zip(b).for_each(|(a, b)| *a += b);
        a
    };
    let counts = counted.reduce(|| vec![0; n_bins], add);
    // What white noise has in a ring: its area, as there is a point in each squared spacing.
    let ring = |bin: usize| std::f64::consts::PI * (2.0 * bin as f64 + 1.0) / (BINS * BINS) as f64 * (1.0 - 1.0 / n_points as f64);
    Ok(counts.iter().enumerate().map(|(bin, &n)| n as f64 / (centres.len() as f64 * ring(bin))).collect())
}

/// Brings the mean over far pairs to 1: a density that is a little wrong would else look like a long wave.
pub(crate) fn level(correlation: &mut [f64]) -> Result<(), Error> {
    let far = correlation.len() / 2;
    let weighted = |values: &mut dyn Iterator<Item = (usize, f64)>| values.map(|(bin, value)| (bin as f64 + 0.5) * value).sum::<f64>();
    let sum = weighted(&mut correlation.iter().copied().enumerate().skip(far));
    let expected = weighted(&mut (far..correlation.len()).map(|bin| (bin, 1.0)));
    if sum == 0.0 {
        return Err(Error::Degenerate("no two points are some spacings apart; are the spacings right?".into()));
    }
    correlation.iter_mut().for_each(|g| *g *= expected / sum);
    Ok(())
}
