//! Weighted sample elimination: of many points, those go one by one that are most crowded, until so many are left as were asked for.
//!
//! Yuksel, "Sample Elimination for Generating Poisson Disk Sample Sets", Computer Graphics Forum 34(2), 2015, doi 10.1111/cgf.12538, with its
//! constants. What is left stands in the paper's progressive order: the first half, the first quarter and so on are spread evenly too.
//!
//! What differs from the paper: points are found in bins, not in a kd-tree; in a domain that is narrower than the spacing, distances are those of a row.
//! Where the density varies, so do the radii: two points matter to each other within the smaller of theirs.
//! Cost: O(m log m) for m points that are a fixed multiple of n, and about evenly spread; more of them have more neighbours.

use std::collections::BinaryHeap;

use glam::DVec2;

use super::bins::Bins;
use super::order::hilbert_order;
use super::point_set::{MAX_POINTS, PointSet};
use super::radius_bins::{RadiusBins, bins_for, radius};
use super::start::Starting;
use super::white::white_by_density;
use crate::density::{Density, Field};
use crate::error::Error;
use crate::parameter::Entry;
use crate::run::RunContext;
use crate::space::{Domain, Space};

/// Candidates a point that the paper finds enough.
pub const CANDIDATES_A_POINT: usize = 5;

/// After so many points it is asked whether the run is cancelled.
const ASKING: usize = 1 << 12;
/// The paper's alpha, beta and gamma.
const ALPHA: i32 = 8;
const BETA: f64 = 0.65;
const GAMMA: f64 = 1.5;
/// Odd, so that no two numbers have the same multiple in 32 bits; their order is about random.
const SPREAD: u32 = 0x9e37_79b1;

/// `n_points` of the `candidates`, spread evenly, in progressive order; those that stay are among them, and come first.
///
/// # Errors
/// [`Error::InvalidParameter`] for no points, for more than there are candidates, and for fewer than stay.
///
/// # Example
/// ```
/// use evenly::{Rectangle, eliminate, measure, white};
///
/// let candidates = white(Rectangle::new([0.0, 0.0], [2.0, 1.0])?, 5000, 7)?;
/// let points = eliminate(&candidates, 1000)?;
/// assert_eq!(points.n_points(), 1000);
/// assert!(measure(&points)?.min_distance > 0.65);
/// # Ok::<(), evenly::Error>(())
/// ```
pub fn eliminate(candidates: &PointSet, n_points: usize) -> Result<PointSet, Error> {
    eliminated(candidates, n_points, &RunContext::default())
}

/// All points in progressive order: any first part of them is spread evenly. Where the run is cancelled, those whose turn has not come stand first, as they are.
///
/// # Errors
/// [`Error::InvalidParameter`] for no points.
pub fn progressive(points: &PointSet, run: &RunContext) -> Result<PointSet, Error> {
    eliminated(points, points.n_points(), run)
}

fn eliminated(candidates: &PointSet, n_points: usize, run: &RunContext) -> Result<PointSet, Error> {
    let n_candidates = candidates.n_points();
    let n_fixed = candidates.n_fixed();
    if n_points == 0 || n_points > n_candidates || n_points < n_fixed {
        let expected = "1 or more, at least the number of points that stay, and at most that of candidates";
        return Err(Error::InvalidParameter { name: "n_points", value: n_points.to_string(), expected });
    }
    let (domain, places) = candidates.normalized();
    let mut left = hilbert_order(&places, domain.size);
    let field = candidates.field(&domain);
    let thin = |left: &mut Vec<u32>, n_points: usize| thin(&domain, field.as_ref(), (&places, n_fixed), left, n_points, run);
    let _ = thin(&mut left, n_points);
    // From the last place to the first: half of what is left goes, and stands behind what stays.
    let mut order = Vec::with_capacity(n_points);
    while left.len() > n_fixed.max(1) && !run.is_cancelled() {
        let n_half = (left.len() / 2).max(n_fixed);
        order.extend(thin(&mut left, n_half));
    }
    order.extend(left.into_iter().filter(|&index| index as usize >= n_fixed));
    let others = order.iter().rev().map(|&index| candidates.positions()[index as usize]);
    let positions = candidates.positions()[..n_fixed].iter().copied().chain(others).collect();
    PointSet::new(candidates.space(), positions)?.with_density(candidates.density()).with_fixed(n_fixed)
}

/// Takes points out, none of the first `n_fixed`, until `n_points` are left; returns them in the order in which they went.
fn thin(
    domain: &Domain,
    field: Option<&Field>,
    (places, n_fixed): (&[DVec2], usize),
    left: &mut Vec<u32>,
    n_points: usize,
    run: &RunContext,
) -> Vec<u32> {
    // Twice the paper's r_max and r_min. A row of points has another spacing, and room enough to need no r_min.
    let (spacing, of_row) = (domain.hex_spacing(n_points), domain.size.max_element() / n_points as f64);
    let farthest = spacing.max(of_row);
    let nearest = if of_row > spacing { 0.0 } else { farthest * (1.0 - libm::pow(n_points as f64 / left.len() as f64, GAMMA)) * BETA };
    let nearest = nearest / farthest;
    let weight = |distance: f64| (1.0 - distance.max(nearest)).powi(ALPHA);
    let crowd = Crowd::new(domain, field, left.iter().map(|&index| places[index as usize]), farthest);

    let mut is_left = vec![true; left.len()];
    let mut weights = vec![0.0; left.len()];
    for (k, sum) in (0u32..).zip(&mut weights) {
        if (k as usize).is_multiple_of(ASKING) && run.is_cancelled() {
            return Vec::new();
        }
        crowd.each_near(k, |_, distance| *sum += weight(distance));
    }
    // Weights only fall, so what is on top with a weight that is not its own any more goes back down.
    // Equal weights go in no order of place.
    let key = |weight: f64, k: u32| ((weight.max(0.0) + 0.0).to_bits(), k.wrapping_mul(SPREAD), k);
    let candidates = weights.iter().zip(0..).filter(|&(_, k)| left[k as usize] as usize >= n_fixed);
    let mut heap: BinaryHeap<_> = candidates.map(|(&weight, k)| key(weight, k)).collect();
    let mut gone = Vec::with_capacity(left.len() - n_points);
    while gone.len() < left.len() - n_points
        && let Some(top) = heap.pop()
    {
        let k = top.2;
        let now = key(weights[k as usize], k);
        if now != top {
            heap.push(now);
            continue;
        }
        if gone.len().is_multiple_of(ASKING) && run.is_cancelled() {
            break;
        }
        is_left[k as usize] = false;
        gone.push(left[k as usize]);
        crowd.each_near(k, |other, distance| weights[other as usize] -= weight(distance));
    }
    let mut k = 0;
    left.retain(|_| {
        k += 1;
        is_left[k - 1]
    });
    gone
}

/// Candidates, and who of them is near to whom.
enum Crowd {
    Even(Bins, f64),
    Varying(RadiusBins, Vec<(DVec2, f64)>),
}

impl Crowd {
    /// Candidates matter to each other that are nearer than `farthest`, times what the density makes of it.
    fn new(domain: &Domain, field: Option<&Field>, places: impl Iterator<Item = DVec2>, farthest: f64) -> Self {
        let Some(field) = field else {
            let mut bins = Bins::new(domain, farthest);
            places.for_each(|place| bins.push(place));
            return Self::Even(bins, farthest);
        };
        let mut bins = bins_for(domain, farthest);
        let disks: Vec<(DVec2, f64)> = places.map(|place| (place, radius(field, place, farthest))).collect();
        disks.iter().for_each(|&(place, radius)| bins.push(place, radius));
        Self::Varying(bins, disks)
    }

    /// Calls with each candidate near to candidate `k`, and the distance relative to the farthest that matters.
    fn each_near(&self, k: u32, mut call: impl FnMut(u32, f64)) {
        match self {
            Self::Even(bins, farthest) => {
                let ways = bins.near(bins.places()[k as usize]).filter(|&(other, _)| other != k);
                let distances = ways.map(|(other, way)| (other, way.length_squared()));
                let near = distances.filter(|(_, squared)| *squared < farthest * farthest);
                near.for_each(|(other, squared)| call(other, squared.sqrt() / farthest));
            }
            Self::Varying(bins, disks) => {
                let (place, radius) = disks[k as usize];
                bins.near(place, radius).filter(|&(other, _)| other != k).for_each(|(other, distance)| call(other, distance));
            }
        }
    }
}

/// Its entry among the methods that make points.
#[derive(Clone, Copy)]
pub(crate) struct Eliminate;

impl Starting for Eliminate {
    const ENTRY: &'static Entry<Self> = &Entry {
        name: "eliminate",
        title: "Weighted sample elimination (Yuksel), in progressive order",
        paper: "Yuksel 2015, doi 10.1111/cgf.12538",
        knows_density: true,
        begin: |_| Self,
        seed: None,
        parameters: &[],
    };
    const HOLDS_CANDIDATES: bool = true;

    fn exactly(space: &Space, density: &Density, n_points: usize, seed: u64) -> Result<PointSet, Error> {
        let n_candidates = n_points.saturating_mul(CANDIDATES_A_POINT).min(MAX_POINTS.max(n_points));
        eliminate(&white_by_density(space, density, n_candidates, seed)?, n_points)
    }
}
