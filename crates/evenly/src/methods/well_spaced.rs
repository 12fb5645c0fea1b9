//! Well-spaced points: beta, the ratio of the largest gap's radius to the smallest distance, is brought down to a target.
//!
//! The measure is that of Ebeida, Awad, Ge, Mahmoud, Mitchell, Knupp and Wei, "Improving Spatial Coverage while Preserving the Blue Noise of Point Sets",
//! Computer-Aided Design 46, 2014, doi 10.1016/j.cad.2013.08.015. No angle is smaller than asin(1 / (2 beta)), so below 1/sqrt(2) no
//! triangle is obtuse.
//!
//! What differs from the paper, and why: its Opt-beta moves each point to where the ratio of its own cell is best. That ratio has no scale, so dense and
//! sparse patches are each well spaced by themselves, and the whole stalls at 0.8. Here all points aim at one distance and one radius,
//! R_f = sqrt(kappa / (sqrt(3) beta)) hexagonal spacings and R_c = beta R_f: with kappa = 1 the hexagonal lattice's own where beta is as small as can
//! be. They are reached by Push-Pull's moves, which also keep the Voronoi cells' areas alike.
//!
//! Cost: O(n) in all; 15 visits a point to 0.75, 40 to 0.70, 110 to 0.68, some 310 to 0.67. It does not promise that any beta can be reached: on a torus 0.67 is known to be.

use serde::Serialize;

use super::local::Local;
use super::obstacles::conclude;
use super::optimizer::{BETA, ITERATIONS, Optimizing, PASSES};
use super::push_pull::{PushPullParams, push_and_pull};
use super::targets::{Targets, UnmetTarget, unmet_beta, validate_beta};
use crate::error::Error;
use crate::measure::{Measures, PointMeasures, measure};
use crate::parameter::{Entry, Group, Parameter};
use crate::points::{PointSet, warp_isotropic};
use crate::run::{Outcome, Report, RunContext};

/// What [`well_spaced`] can be told.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct WellSpacedParams {
    /// The coverage radius over the smallest distance shall be this at most; 0.578 or more, where 0.577 is the hexagonal lattice's. Down to 0.67 is
    /// known to be reached on a torus, to 0.72 in a rectangle from 50 points on. Less makes points more regular: psi6 is 0.48 at 0.75, 0.54 at 0.70 and 0.59 at 0.67.
    pub beta: f64,
    /// Stops after this many passes in any case; `None` for a limit that grows with the number of points, 2000 at least.
    pub max_passes: Option<usize>,
    /// The order of visits depends on it.
    pub seed: u64,
}

impl Default for WellSpacedParams {
    fn default() -> Self {
        Self { beta: 0.75, max_passes: None, seed: 0 }
    }
}

/// What leads to a ratio, as measured.
struct Way {
    /// For ratios from this on.
    beta: f64,
    /// Shorter distances and radii are easier where the ratio is tough.
    kappa: f64,
    /// Exaggerated moves take fewer passes and, more so, make points more regular.
    relaxation: f64,
    /// Takes long density waves out; less makes points more regular.
    capacity_tolerance: f64,
}

const WAYS: [Way; 4] = [
    Way { beta: 0.72, kappa: 0.98, relaxation: 1.1, capacity_tolerance: 0.2 },
    Way { beta: 0.69, kappa: 1.0, relaxation: 1.2, capacity_tolerance: 0.1 },
    Way { beta: 0.665, kappa: 0.975, relaxation: 1.12, capacity_tolerance: 0.1 },
    Way { beta: 0.0, kappa: 0.97, relaxation: 1.15, capacity_tolerance: 0.1 },
];
/// The coverage radius of the hexagonal lattice, rounded up.
const LEAST_RADIUS: f64 = 0.5774;
/// What is known to be reached on a torus.
const ON_TORUS: f64 = 0.67;

/// What is known to be reached in a rectangle by so many points: few have no room between its walls.
fn in_rectangle(n_points: usize) -> f64 {
    match n_points {
        50.. => 0.72,
        20.. => 0.80,
        _ => 0.90,
    }
}

impl WellSpacedParams {
    /// Checks the parameters, as [`well_spaced`] does before it begins.
    ///
    /// # Errors
    /// [`Error::InvalidParameter`] for a ratio outside [0.578, 2], or no passes.
    pub fn validate(&self) -> Result<(), Error> {
        validate_beta(self.beta)?;
        self.targets().validate()
    }

    /// One distance and one radius for all.
    pub(crate) fn targets(&self) -> PushPullParams {
        let [.., last] = &WAYS;
        let &Way { kappa, relaxation, capacity_tolerance, .. } = WAYS.iter().find(|way| self.beta >= way.beta).unwrap_or(last);
        // A generous ratio needs no distance beyond the hexagonal lattice's.
        let distance = (kappa / (3f64.sqrt() * self.beta)).sqrt().min(1.0);
        PushPullParams {
            min_distance: Some(distance),
            coverage_radius: Some((self.beta * distance).max(LEAST_RADIUS)),
            capacity_tolerance: Some(capacity_tolerance),
            relaxation,
            max_passes: self.max_passes,
            seed: self.seed,
            ..PushPullParams::default()
        }
    }
}

impl Targets for WellSpacedParams {
    fn unmet(&self, measures: &Measures) -> Vec<UnmetTarget> {
        unmet_beta(self.beta, measures)
    }

    fn miss(&self, point: &PointMeasures) -> f64 {
        // Areas are made alike on the way, and are no target.
        PushPullParams { capacity_tolerance: None, ..self.targets() }.miss(point)
    }

    fn advice(&self, points: &PointSet) -> Option<String> {
        let known = if points.space().is_periodic() { ON_TORUS } else { in_rectangle(points.n_points()) };
        let text = || format!("beta {} is not known to be reached here, and the run may be long; {known} is", self.beta);
        (self.beta < known).then(text)
    }
}

/// The angles in degrees between which all angles of a Delaunay triangulation lie whose coverage radius is `beta` times its smallest distance; `None`
/// from 1 on, where they say little. On a bounded domain they hold for triangles with their circumcentre in it.
pub fn angle_bounds_deg(beta: f64) -> Option<[f64; 2]> {
    let least = libm::asin(0.5 / beta).to_degrees();
    (beta < 1.0).then_some([least, 180.0 - 2.0 * least])
}

impl Optimizing for WellSpacedParams {
    const ENTRY: &'static Entry<Self> = &Entry {
        name: "well-spaced",
        title: "Low beta, the ratio of the largest gap to the smallest distance (Ebeida et al.)",
        paper: "Ebeida, Awad, Ge, Mahmoud, Mitchell, Knupp and Wei 2014, doi 10.1016/j.cad.2013.08.015",
        knows_density: true,
        begin: |_| Self::default(),
        seed: Some(|p| &mut p.seed),
        parameters: &[
            Parameter::own_count("iterations", "I", |p: &mut Self| &mut p.max_passes, ITERATIONS).by_default(PASSES),
            Parameter::number("beta", "B", |p: &mut Self| &mut p.beta, BETA)
                .of(Group::Targets)
                .details("It is known to reach 0.67 on a torus and 0.72 in a rectangle."),
        ],
    };
    const WARP: Option<fn(&mut PointSet)> = Some(warp_isotropic);

    fn run(&self, points: &mut PointSet, run: &mut RunContext) -> Result<Report, Error> {
        well_spaced(points, self, run)
    }

    fn check(&self) -> Result<(), Error> {
        self.validate()
    }

    fn targets(&self) -> Option<&dyn Targets> {
        Some(self)
    }

    fn local(&self) -> Option<Local> {
        Some(Local::Targets(self.targets()))
    }
}

/// Optimises `points` in place; their number and order stay.
///
/// Where the ratio is not reached, the report says so, and `points` are in the best state that was seen.
///
/// # Errors
/// [`Error::InvalidParameter`] as [`WellSpacedParams::validate`] has it; [`Error::TooFine`] where f64 cannot tell the points apart;
/// [`Error::Degenerate`] where they cannot be triangulated. The points are untouched then.
///
/// # Example
/// ```
/// use evenly::{RunContext, Torus, WellSpacedParams, measure, warp_isotropic, well_spaced, white};
///
/// let mut points = white(Torus::new([0.0, 0.0], [1.0, 1.0])?, 1000, 7)?;
/// warp_isotropic(&mut points);
/// well_spaced(&mut points, &WellSpacedParams { beta: 0.70, ..WellSpacedParams::default() }, &mut RunContext::default())?;
/// let measures = measure(&points)?;
/// assert!(measures.beta <= 0.70 && measures.obtuse_fraction == 0.0);
/// # Ok::<(), evenly::Error>(())
/// ```
pub fn well_spaced(points: &mut PointSet, params: &WellSpacedParams, run: &mut RunContext) -> Result<Report, Error> {
    params.validate()?;
    let mut report = Report::new("well-spaced", points.n_points());
    report.notes.extend(params.advice(points));
    push_and_pull(points, &params.targets(), run, &mut report)?;
    // The ratio may be met though the distance and the radius are not.
    let has_missed = matches!(report.outcome, Outcome::IterationLimit | Outcome::Forced | Outcome::LostToRounding);
    if has_missed && measure(points).is_ok_and(|measures| params.unmet(&measures).is_empty()) {
        report.outcome = Outcome::Converged;
    }
    conclude(points, params, &mut report);
    Ok(report)
}
