//! Procrustes analysis: every triangle pulls its corners towards the equilateral triangle that fits it best; edges flip where that lowers the energy.
//!
//! Papazov and Hege, "Blue-noise Optimized Point Sets Based on Procrustes Analysis", ZIB-Report 17-55, 2017.
//!
//! What differs from the paper, and why:
//! - The rotation of equation (2) has a closed form: no singular value decomposition, no trigonometry.
//! - An edge flips only if both new triangles are turned the right way, and a move that turns a triangle over is undone at
//!   its corners. The paper's plain rule leaves a few inverted triangles in large sets. Both keep its convergence proof: the sum
//!   over a vertex's targets falls for any step between 0 and twice the way to their mean.
//! - Edges are visited along the Hilbert curve, not in random order: the quality is the same, the time a tenth.
//! - [`Mode::Fast`] adds momentum, restarted if the energy keeps rising, which the proof does not cover: a better result in a third of the iterations.
//! - In a rectangle the boundary is sampled first: corners and evenly spaced points slide along it, and while they find their
//!   place the triangulation is rebuilt, so that the triangles cover the whole domain.
//! - In a polygon boundary points are those that the boundary stops. Every few iterations the triangulation is rebuilt, and triangles whose circumcentre lies outside, or whose
//!   corners do not see each other, are left out, as the paper does at the start: corners may stay free. Points that come together at the boundary are moved apart.
//! - Where the density varies, a triangle's model is as large as the density at its centroid wants it (the paper's future work). The energy may then rise.
//!
//! Cost: O(n) an iteration, the number of iterations does not grow with n. It promises no smallest distance and no regularity.

mod boundary;
mod flips;
mod gaps;
mod mesh;
mod model;

use serde::Serialize;

use self::boundary::Rim;
use self::mesh::Mesh;
use self::model::Sides;
use super::optimizer::{ITERATIONS, Optimizing};
use super::prepare::{Prepared, keep_distinct, prepare};
use crate::density::{Field, SoftField};
use crate::error::Error;
use crate::parameter::{Choice, Entry, Parameter, Unit};
use crate::points::{PointSet, warp};
use crate::run::{Outcome, Phase, Progress, Report, RunContext};
use crate::triangulation::delaunay;

/// How points are moved towards their targets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Mode {
    /// The paper's plain steps: the energy never rises, but where a rectangle's triangulation is rebuilt.
    Paper,
    /// Momentum, restarted if the energy keeps rising: fewer iterations and a lower energy.
    #[default]
    Fast,
}

/// What [`procrustes`] can be told. There is no seed: edges are visited in a fixed order, and chance lies in the starting points.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ProcrustesParams {
    /// Plain steps or momentum.
    pub mode: Mode,
    /// Side of the model triangle, in hexagonal spacings; the paper's d = 3 r_max is 1.5. It is a stiffness, not a spacing, which is
    /// set by the number of points: smaller is more robust, larger covers more evenly. Outside [1, 1.625] quality falls.
    pub side: f64,
    /// Stops when an iteration lowers the energy by less than this fraction of the domain's area; in [`Mode::Fast`] when two in a row do.
    pub tolerance: f64,
    /// Stops after this many iterations in any case.
    pub max_iterations: usize,
}

impl Default for ProcrustesParams {
    fn default() -> Self {
        Self { mode: Mode::Fast, side: 1.5, tolerance: 2e-5, max_iterations: 500 }
    }
}

impl ProcrustesParams {
    /// Checks the parameters, as [`procrustes`] does before it begins.
    ///
    /// # Errors
    /// [`Error::InvalidParameter`] for a side outside (0, 8], a tolerance that is not positive and finite, or no iterations.
    pub fn validate(&self) -> Result<(), Error> {
        let invalid = |name, value: String, expected| Err(Error::InvalidParameter { name, value, expected });
        if !(self.side > 0.0 && self.side <= LARGEST_SIDE) {
            return invalid("side", self.side.to_string(), "positive, and 8 at most");
        }
        if !(self.tolerance.is_finite() && self.tolerance > 0.0) {
            return invalid("tolerance", self.tolerance.to_string(), "positive and finite");
        }
        if self.max_iterations == 0 {
            return invalid("max_iterations", "0".into(), "1 or more");
        }
        Ok(())
    }
}

/// The share of the last step that is carried on in [`Mode::Fast`].
const MOMENTUM: f64 = 0.7;
/// The first iterations of [`Mode::Fast`], in which nine in ten flips happen.
const ALWAYS_FLIP: usize = 8;
/// Larger sides would throw points further than a period.
const LARGEST_SIDE: f64 = 8.0;
/// The side of cells over which the density is averaged, in hexagonal spacings: what is finer is noise to triangles.
const SOFTNESS: f64 = 0.5;
/// Sides within which the quality holds.
const GOOD_SIDES: std::ops::RangeInclusive<f64> = 1.0..=1.625;
/// Changes of the energy below this are rounding: a set at rest sways by them.
const ROUNDING: f64 = 1e-12;
/// Where models change size with each move the energy may sway for ever: a run has settled that has found nothing lower in so many iterations.
const IDLE: usize = 16;

const MODES: [Choice; 2] = [
    Choice { name: "paper", doc: "plain steps, the energy never rises, but where a rectangle is triangulated again" },
    Choice { name: "fast", doc: "momentum" },
];

impl Optimizing for ProcrustesParams {
    const ENTRY: &'static Entry<Self> = &Entry {
        name: "procrustes",
        title: "Procrustes analysis (Papazov and Hege)",
        paper: "Papazov and Hege 2017, ZIB-Report 17-55",
        knows_density: true,
        begin: |_| Self::default(),
        seed: None,
        parameters: &[
            Parameter::count("iterations", "I", |p: &mut Self| &mut p.max_iterations, ITERATIONS),
            Parameter::choice(
                "mode",
                &MODES,
                |p: &Self| p.mode as usize,
                |p: &mut Self, place| p.mode = [Mode::Paper, Mode::Fast][place],
                "How points are moved towards their targets",
            ),
            Parameter::number(
                "side",
                "D",
                |p: &mut Self| &mut p.side,
                "Side of the model triangle in hexagonal spacings, good within 1 to 1.625",
            )
            .counting(Unit::Spacings)
            .rare(),
            Parameter::number(
                "tolerance",
                "T",
                |p: &mut Self| &mut p.tolerance,
                "Stop when an iteration, in mode fast two in a row, gains less than this share of the domain's area",
            )
            .rare(),
        ],
    };
    const WARP: Option<fn(&mut PointSet)> = Some(warp);

    fn run(&self, points: &mut PointSet, run: &mut RunContext) -> Result<Report, Error> {
        procrustes(points, self, run)
    }

    fn check(&self) -> Result<(), Error> {
        self.validate()
    }
}

/// Optimises `points` in place; their number and order stay.
///
/// # Errors
/// [`Error::InvalidParameter`] for a side outside (0, 8], a tolerance that is not positive and finite, or no iterations;
/// [`Error::TooFine`] where f64 cannot tell the points apart; [`Error::Degenerate`] where they cannot be triangulated. The points are
/// untouched then.
///
/// # Example
/// ```
/// use evenly::{ProcrustesParams, RunContext, Torus, procrustes, warp, white};
///
/// let mut points = white(Torus::new([0.0, 0.0], [1.0, 1.0])?, 1000, 7)?;
/// warp(&mut points);
/// let report = procrustes(&mut points, &ProcrustesParams::default(), &mut RunContext::default())?;
/// assert_eq!(report.inverted_triangles, 0);
/// assert_eq!(points.n_points(), 1000);
/// # Ok::<(), evenly::Error>(())
/// ```
pub fn procrustes(points: &mut PointSet, params: &ProcrustesParams, run: &mut RunContext) -> Result<Report, Error> {
    params.validate()?;
    let mut report = Report::new("procrustes", points.n_points());
    if !GOOD_SIDES.contains(&params.side) {
        report.notes.push(format!("side {} is outside [1, 1.625], where triangles keep their shape", params.side));
    }

    // Preprocessing: distinct points, and their Delaunay triangulation.
    let Some(Prepared { domain, spacing, positions, order, field }) = prepare(points, &mut report, run)? else { return Ok(report) };
    run.enter(Phase::Triangulate);
    let mut triangulation = delaunay(&domain, positions, order)?;
    report.triangulations = 1;
    let n_fixed = points.n_fixed();
    let rim = Rim::of(&domain, field.as_ref().is_some_and(Field::has_gaps), points.n_points());
    if rim == Rim::Walls && boundary::is_narrow(domain.size, spacing) {
        report
            .notes
            .push("the rectangle is less than three spacings wide: it is nearly all boundary, and points are less even there".into());
    }
    if rim != Rim::None {
        triangulation = rim.settle(triangulation, n_fixed, spacing)?;
        report.triangulations += 1;
    }
    run.enter(Phase::Optimize);
    let sides = Sides {
        mean: params.side * spacing,
        longest: LARGEST_SIDE * spacing,
        field: field.as_ref().map(|field| SoftField::new(field, &domain, SOFTNESS * spacing)),
        gaps: field.filter(Field::has_gaps),
    };
    let mut mesh = Mesh::new(triangulation, sides, n_fixed);

    // Step 1, match.
    let mut energy = mesh.flip_and_match(false).energy / mesh.area();
    report.energy.push(energy);
    report.outcome = Outcome::IterationLimit;
    let mut decay = Decay::new(params, !points.density().is_uniform() || rim == Rim::Polygon);
    while report.iterations < params.max_iterations {
        if run.is_cancelled() {
            report.outcome = Outcome::Cancelled;
            break;
        }
        // Step 2: move.
        let momentum = match params.mode {
            Mode::Fast if !decay.is_diverging() => MOMENTUM,
            _ => 0.0,
        };
        mesh.move_vertices(momentum);
        report.moves_undone += mesh.undo_inverted();
        // Step 3, flip, in fast mode every second time once most edges have found their place; and step 1 of the next iteration,
        // match, which also measures the energy of this one.
        let is_flipping = params.mode == Mode::Paper || report.iterations < ALWAYS_FLIP || report.iterations.is_multiple_of(2);
        let mut matched = mesh.flip_and_match(is_flipping);
        report.flips += matched.n_flips;
        report.iterations += 1;

        let is_settling = rim.is_settling(report.iterations);
        if is_settling {
            mesh = mesh.rebuilt(n_fixed, |old| rim.resettle(old, n_fixed, spacing))?;
            matched = mesh.flip_and_match(false);
            report.triangulations += 1;
        }
        let before = energy;
        energy = matched.energy / mesh.area();
        report.energy.push(energy);
        report.energy_rises += usize::from(energy > before + ROUNDING * (1.0 + before) && !is_settling);
        decay.step(before - energy);
        let fraction = decay.fraction.max(report.iterations as f64 / params.max_iterations as f64);
        run.show(|| mesh.shown(&domain));
        run.report(Progress { phase: Phase::Optimize, iteration: report.iterations, energy: Some(energy), stable_share: None, fraction });
        if decay.has_settled() && rim.has_settled(report.iterations) {
            report.outcome = Outcome::Converged;
            break;
        }
    }
    report.inverted_triangles = mesh.n_inverted();
    if report.outcome == Outcome::IterationLimit {
        report.notes.push(format!("stopped after {} iterations, before the energy had settled", report.iterations));
    }
    let (order, mut positions) = mesh.into_positions(&domain);
    if rim == Rim::Polygon {
        boundary::part_crowded(&domain, &mut positions, &order, n_fixed, spacing);
    }
    points.place(&domain, &order, &positions);
    if rim == Rim::Polygon {
        keep_distinct(points);
    }
    if !points.density().is_uniform() {
        gaps::part(points, run, &mut report)?;
    }
    Ok(report)
}

/// Watches the energy fall: when to restart, when to stop, and how far the run has come.
struct Decay {
    params: ProcrustesParams,
    /// What the last iterations have gained, the newest first.
    gains: [f64; 4],
    largest: f64,
    fraction: f64,
    /// Where the density varies, and in a polygon, how far the energy is above its lowest, and how many iterations ago it was clearly lower than ever before.
    is_varying: bool,
    above_lowest: f64,
    n_idle: usize,
}

impl Decay {
    fn new(params: &ProcrustesParams, is_varying: bool) -> Self {
        let gains = [f64::INFINITY; 4];
        Self { params: *params, gains, largest: params.tolerance, fraction: 0.0, is_varying, above_lowest: 0.0, n_idle: 0 }
    }

    /// Takes what an iteration has gained.
    fn step(&mut self, gain: f64) {
        let [a, b, c, _] = self.gains;
        self.gains = [gain, a, b, c];
        self.largest = self.largest.max(gain.abs());
        self.above_lowest -= gain;
        self.n_idle += 1;
        if self.above_lowest < -self.params.tolerance {
            (self.above_lowest, self.n_idle) = (0.0, 0);
        }
        self.fraction = self.fraction.max(self.estimate());
    }

    /// How far the gains have come down to the tolerance: with momentum about exponentially, in plain steps about as the inverse
    /// square of the iterations.
    fn estimate(&self) -> f64 {
        let recent = self.gains.iter().fold(self.params.tolerance, |most, gain| most.max(gain.abs())).min(self.largest);
        let share = self.params.tolerance / recent;
        match self.params.mode {
            Mode::Paper => share.sqrt(),
            Mode::Fast => 1.0 - libm::log(share) / libm::log((self.params.tolerance / self.largest).min(0.999)),
        }
    }

    /// Whether the energy has risen twice in a row: momentum alone makes it rise once.
    fn is_diverging(&self) -> bool {
        self.gains[..2].iter().all(|&gain| gain < 0.0)
    }

    /// Whether the last iteration has gained too little to go on; with momentum the last two, since its energy sways.
    fn has_settled(&self) -> bool {
        let n = if self.params.mode == Mode::Paper { 1 } else { 2 };
        let is_idle = self.is_varying && self.n_idle >= IDLE;
        is_idle || self.gains[..n].iter().all(|gain| (0.0..self.params.tolerance).contains(gain))
    }
}
