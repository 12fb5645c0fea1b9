//! Lloyd's method: each point goes to the centroid of its Voronoi cell, and so to a centroidal Voronoi tessellation.
//!
//! Lloyd, "Least Squares Quantization in PCM", IEEE Transactions on Information Theory 28(2), 1982, doi 10.1109/TIT.1982.1056489; Du, Faber and Gunzburger,
//! "Centroidal Voronoi Tessellations: Applications and Algorithms", SIAM Review 41(4), 1999, doi 10.1137/S0036144599352836.
//!
//! Where the density varies, centroids are weighted by it: Secord, "Weighted Voronoi Stippling", NPAR 2002, doi 10.1145/508530.508537. The energy is least where points are as dense as the
//! density's root, so over many passes they thin out where they are dense.
//!
//! What differs, and why: points move one after the other, and each sees what those before it have done. No move raises the energy, the sum
//! of squared distances of all places to their points, and a pass gains about twice as much as one in which all move at once.
//!
//! Cost: O(n) a pass. It does not promise the least energy: it comes to rest where hexagonal patches meet. The longer it runs, the more regular the points.

use serde::Serialize;

use super::local::Local;
use super::optimizer::{ITERATIONS, Optimizing};
use super::prepare::validate_iterations;
use super::relax::relax;
use crate::error::Error;
use crate::parameter::{Entry, Parameter};
use crate::points::PointSet;
use crate::run::{Report, RunContext};
use crate::star::{Rule, Senses, Star};

/// What [`lloyd`] can be told.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LloydParams {
    /// Passes over all points; more make points more regular.
    pub iterations: usize,
    /// Stops before that where no point is farther from its centroid than this many hexagonal spacings; 0 for never.
    pub tolerance: f64,
    /// The order of visits depends on it.
    pub seed: u64,
}

impl Default for LloydParams {
    fn default() -> Self {
        Self { iterations: 100, tolerance: 1e-4, seed: 0 }
    }
}

impl LloydParams {
    /// Checks the parameters, as [`lloyd`] does before it begins.
    ///
    /// # Errors
    /// [`Error::InvalidParameter`] for no iterations, or a tolerance below 0.
    pub fn validate(&self) -> Result<(), Error> {
        if !(self.tolerance >= 0.0 && self.tolerance.is_finite()) {
            return Err(Error::InvalidParameter {
                name: "tolerance",
                value: self.tolerance.to_string(),
                expected: "0 or more, and finite",
            });
        }
        validate_iterations(self.iterations)
    }

    pub(crate) fn rule(&self) -> ToCentroid {
        ToCentroid { tolerance: self.tolerance }
    }
}

impl Optimizing for LloydParams {
    const ENTRY: &'static Entry<Self> = &Entry {
        name: "lloyd",
        title: "Lloyd's method: to the centroids of the Voronoi cells",
        paper: "Lloyd 1982, doi 10.1109/TIT.1982.1056489; Secord 2002, doi 10.1145/508530.508537",
        knows_density: true,
        begin: |_| Self::default(),
        seed: Some(|p| &mut p.seed),
        parameters: &[
            Parameter::count("iterations", "I", |p: &mut Self| &mut p.iterations, ITERATIONS),
            Parameter::number(
                "tolerance",
                "T",
                |p: &mut Self| &mut p.tolerance,
                "Stop when no point goes farther than this many hexagonal spacings",
            )
            .rare(),
        ],
    };

    fn run(&self, points: &mut PointSet, run: &mut RunContext) -> Result<Report, Error> {
        lloyd(points, self, run)
    }

    fn check(&self) -> Result<(), Error> {
        self.validate()
    }

    fn local(&self) -> Option<Local> {
        Some(Local::Passes(Box::new(self.rule()), self.iterations))
    }
}

/// Moves `points` towards the centroids of their cells, in place; their number and order stay.
///
/// # Errors
/// [`Error::InvalidParameter`] as [`LloydParams::validate`] has it; [`Error::TooFine`] where f64 cannot tell the points apart;
/// [`Error::Degenerate`] where they cannot be triangulated. The points are untouched then.
///
/// # Example
/// ```
/// use evenly::{LloydParams, RunContext, Torus, lloyd, measure, white};
///
/// let mut points = white(Torus::new([0.0, 0.0], [1.0, 1.0])?, 1000, 7)?;
/// lloyd(&mut points, &LloydParams::default(), &mut RunContext::default())?;
/// assert!(measure(&points)?.mean_distance > 0.9);
/// # Ok::<(), evenly::Error>(())
/// ```
pub fn lloyd(points: &mut PointSet, params: &LloydParams, run: &mut RunContext) -> Result<Report, Error> {
    params.validate()?;
    relax("lloyd", &params.rule(), points, params.iterations, params.seed, run)
}

/// Goes to the centroid, if it is farther than the tolerance.
pub(crate) struct ToCentroid {
    tolerance: f64,
}

impl Rule for ToCentroid {
    fn senses(&self) -> Senses {
        Senses { centroid: true, echoes: true, ..Senses::default() }
    }

    fn visit(&self, star: &mut Star) -> bool {
        star.find_centroid();
        star.own_move() > self.tolerance
    }
}
