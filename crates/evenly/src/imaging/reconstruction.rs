//! Filters that make pixels of samples.

/// A reconstruction filter; the same along x and y, and their product in the plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ReconstructionFilter {
    /// Piecewise cubic, 4 pixels wide: B = C = 1/3 of Mitchell and Netravali, "Reconstruction Filters in Computer Graphics", SIGGRAPH 1988.
    #[default]
    Mitchell,
    /// A Gaussian 3 pixels wide, with a standard deviation of half a pixel.
    Gaussian,
}

impl ReconstructionFilter {
    /// Beyond this distance, in pixels, it is 0.
    pub(super) fn radius(self) -> f64 {
        match self {
            Self::Mitchell => 2.0,
            Self::Gaussian => 1.5,
        }
    }

    /// Along one axis, at a distance in pixels.
    pub(super) fn weight(self, distance: f64) -> f64 {
        let x = distance.abs();
        match self {
            _ if x >= self.radius() => 0.0,
            Self::Mitchell if x < 1.0 => (7.0 * x * x * x - 12.0 * x * x + 16.0 / 3.0) / 6.0,
            Self::Mitchell => (-7.0 / 3.0 * x * x * x + 12.0 * x * x - 20.0 * x + 32.0 / 3.0) / 6.0,
            Self::Gaussian => libm::exp(-2.0 * x * x),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cubic_sums_to_one_wherever_it_stands_and_both_end_at_their_radius() {
        for step in 0..20 {
            let at = f64::from(step) / 20.0;
            let sum: f64 = (-3..=3).map(|pixel| ReconstructionFilter::Mitchell.weight(f64::from(pixel) - at)).sum();
            assert!((sum - 1.0).abs() < 1e-12);
        }
        for filter in [ReconstructionFilter::Mitchell, ReconstructionFilter::Gaussian] {
            assert!(filter.weight(filter.radius()) == 0.0 && filter.weight(0.0) > filter.weight(0.7));
            assert!((filter.weight(0.999_999) - filter.weight(1.000_001)).abs() < 1e-5);
        }
    }
}
