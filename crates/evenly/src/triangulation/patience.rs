//! [`Patience`]: by how much targets are relaxed at the points that boundaries keep from rest.
//!
//! Near a ragged boundary, a fixed point or a gap in a density no arrangement may meet all targets. A
//! point there finds no rest, and keeps its neighbours from theirs. So each such point gets *slack*
//! that grows with the visits at which something was wrong, until it rests. Points that come to rest
//! in the usual number of visits have none.

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// A point that a boundary touches is given slack after so many visits without rest; most others
/// rest by then.
const AT_BOUNDARIES: u32 = 100;
/// One that only its neighbours keep from rest.
const ELSEWHERE: u32 = 1000;
/// The slack that each visit beyond these adds.
const STEP: f64 = 0.002;
/// The visits after which it grows faster: what is still without rest has targets out of reach.
const HASTE: f64 = 500.0;

/// For each point the visits without rest; empty where nothing keeps points from it.
#[derive(Debug, Default)]
pub(crate) struct Patience {
    n_restless: Vec<AtomicU32>,
}

impl Patience {
    pub fn of(n_points: usize) -> Self {
        Self { n_restless: (0..n_points).map(|_| AtomicU32::new(0)).collect() }
    }

    /// Whether points may be given slack at all.
    pub fn has_any(&self) -> bool {
        !self.n_restless.is_empty()
    }

    /// Counts a visit at which something was wrong.
    #[inline]
    pub fn count(&self, point: u32) {
        if let Some(n) = self.n_restless.get(point as usize) {
            // No other thread visits the point.
            n.store(n.load(Relaxed).saturating_add(1), Relaxed);
        }
    }

    /// The share of its targets by which a point may miss them.
    #[inline]
    pub fn slack(&self, point: u32, is_at_boundary: bool) -> f64 {
        let Some(n) = self.n_restless.get(point as usize) else { return 0.0 };
        let patience = if is_at_boundary { AT_BOUNDARIES } else { ELSEWHERE };
        let late = f64::from(n.load(Relaxed).saturating_sub(patience));
        STEP * late * (1.0 + late / HASTE)
    }
}
