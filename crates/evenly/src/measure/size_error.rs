//! [`SizeErrors`]: how well the edges of a mesh are as long as was wanted.

use serde::Serialize;

/// The lengths of a mesh's edges, each over the mean of the lengths that are wanted at its ends.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SizeErrors {
    /// Their mean.
    pub size_ratio_mean: f64,
    /// The smallest.
    pub size_ratio_min: f64,
    /// The largest.
    pub size_ratio_max: f64,
}

impl std::fmt::Display for SizeErrors {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { size_ratio_mean, size_ratio_min, size_ratio_max } = self;
        write!(f, "edges are {size_ratio_min:.2} to {size_ratio_max:.2} of the wanted length, on average {size_ratio_mean:.3}")
    }
}

impl SizeErrors {
    /// Of edges, each by its length and the lengths wanted at its ends; `None` where there are none.
    pub(crate) fn of(edges: impl Iterator<Item = (f64, [f64; 2])>) -> Option<Self> {
        let (mut sum, mut n) = (0.0, 0.0);
        let (mut least, mut most) = (f64::INFINITY, 0.0f64);
        for (length, [a, b]) in edges {
            let ratio = length / (0.5 * (a + b));
            (sum, n) = (sum + ratio, n + 1.0);
            (least, most) = (least.min(ratio), most.max(ratio));
        }
        (n > 0.0).then(|| Self { size_ratio_mean: sum / n, size_ratio_min: least, size_ratio_max: most })
    }
}
