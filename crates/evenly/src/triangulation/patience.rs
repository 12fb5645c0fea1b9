//! [`Patience`]: by how much targets are relaxed at the points that boundaries keep from rest.
//!
//! Near a ragged boundary, a fixed point or a gap in a density no arrangement may meet all targets. A
//! point there finds no rest, and keeps its neighbours from theirs. So each such point gets *slack*
//! that grows with the visits at which something was wrong, until it rests. Points that come to rest
//! in the usual number of visits have none.

use std::sync::atomic::{AtomicBool, AtomicU32, Ordering::Relaxed};

/// A point that a boundary touches is given slack after so many visits without rest; most others
/// rest by then.
const AT_BOUNDARIES: f64 = 100.0;
/// One with a neighbour that a boundary touches and that has slack.
const BESIDE: f64 = 300.0;
/// Others.
const ELSEWHERE: f64 = 1000.0;
/// The slack that each visit beyond these adds.
const STEP: f64 = 0.002;
/// The visits after which it grows faster: what is still without rest has targets out of reach.
const HASTE: f64 = 500.0;

/// The largest share of points that a boundary touches for which these numbers hold. Where it touches more,
/// few points are free to make room, and all goes faster, up to so many times.
const USUAL_SHARE: f64 = 0.3;
const FASTEST: f64 = 12.0;

/// For each point the visits without rest; empty where nothing keeps points from it.
#[derive(Debug, Default)]
pub(crate) struct Patience {
    /// How much faster than usual.
    pace: f64,
    n_restless: Vec<AtomicU32>,
    /// Which points have slack by a boundary.
    is_relaxed: Vec<AtomicBool>,
}

impl Patience {
    /// For so many points, of which a boundary touches about this share.
    pub fn of(n_points: usize, share_at_boundary: f64) -> Self {
        let pace = (share_at_boundary / USUAL_SHARE).powi(2).clamp(1.0, FASTEST);
        let is_relaxed = (0..n_points).map(|_| AtomicBool::new(false)).collect();
        Self { n_restless: (0..n_points).map(|_| AtomicU32::new(0)).collect(), is_relaxed, pace }
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

    /// The share of its targets by which a point may miss them, given its neighbours.
    #[inline]
    pub fn slack(&self, point: u32, is_at_boundary: bool, mut neighbours: impl Iterator<Item = u32>) -> f64 {
        let Some(n) = self.n_restless.get(point as usize) else { return 0.0 };
        let n = self.pace * f64::from(n.load(Relaxed));
        if n <= AT_BOUNDARIES {
            return 0.0;
        }
        let is_relaxed = |point: u32| self.is_relaxed.get(point as usize).is_some_and(|is| is.load(Relaxed));
        let patience = if is_at_boundary {
            self.is_relaxed[point as usize].store(true, Relaxed);
            AT_BOUNDARIES
        } else if neighbours.any(is_relaxed) {
            BESIDE
        } else {
            ELSEWHERE
        };
        let late = (n - patience).max(0.0);
        STEP * late * (1.0 + late / HASTE)
    }
}
