//! Push-pull optimization: each point moves its neighbours until none is nearer than a wanted distance, no gap is larger than a wanted radius,
//! and all Voronoi cells have about the same area.
//!
//! Ahmed, Guo, Yan, Franceschi, Zhang and Deussen, "A Simple Push-Pull Algorithm for Blue-Noise Sampling", IEEE Transactions on Visualization
//! and Computer Graphics 23(12), 2017, doi 10.1109/TVCG.2016.2641963.
//!
//! What differs from the paper, and why:
//! - The three steps of a visit work one after the other on a copy of the star, and each neighbour then moves once: as good as
//!   rereading the star in between, and faster. Summing three shifts of one reading diverges on tough targets.
//! - Points are visited in an order that is new in each pass: a fixed order runs into cycles that never end.
//! - Obtuse triangles are not left out. It makes no difference in the plane, and on curved surfaces they count.
//! - The Delaunay property is restored where a star is read, not after each move; before a run counts as converged, everywhere.
//! - Where the density varies (section 4.2), lengths are integrals of its root and areas of itself, exact on pixels. The radius of a triangle is the mean of the ways from its
//!   three corners: with the visited corner's alone the three disagree, and never rest. Across a gap in the density half of the local spacing counts at least.
//!   Cells press on their sides by the sides' mass: by length, points would crowd at the rims of gaps.
//! - In a rectangle a wall acts like the points' mirror images: cells end there, and the coverage radius counts walls and corners.
//!
//! Cost: O(n) in all, about 20 visits a point for {0.85, 0.67}, 60 for {0.90, 0.65} and 150 for {0.90, 0.63}. It does not promise that
//! any targets can be reached: what is known to be, is in the documentation of [`PushPullParams`].

mod entry;
mod frontier;
mod rule;
mod transfer;

use serde::Serialize;

use self::frontier::{Known, nearest_known};
use self::rule::LEAST_TOLERANCE;
pub(crate) use self::rule::PushPull;
use self::transfer::transferred;
use super::obstacles::conclude;
use super::prepare::{keep_distinct, triangulated};
use super::targets::{ROUNDING, Targets, UnmetTarget, is_lost_to_rounding, over, under};
use crate::error::Error;
use crate::measure::{Measures, PointMeasures, measure};
use crate::points::PointSet;
use crate::run::{Outcome, Report, RunContext};
use crate::sweep::{Ending, Plan, Schedule, Sweep};

/// What [`push_pull`] can be told: the targets, each of which may be left out, and how to go for them.
///
/// Lengths are relative to the hexagonal spacing. These distances, and all below, are known to be
/// reached: on a torus with 1,000 and 10,000 points, the toughest with a relaxation of 1.2 alone; in a
/// rectangle at least 24 spacings wide. Between walls 15 spacings apart they are 0.05 to 0.1 less at a
/// radius below 0.67, and nearer to each other 0.85 at 0.75.
///
/// | coverage radius at least | torus, tolerance 0.0386 | torus, 0.1 | rectangle, 0.0386 | rectangle, 0.1 |
/// |---|---|---|---|---|
/// | 0.61 | - | 0.90 | - | - |
/// | 0.62 | 0.91 | 0.92 | - | - |
/// | 0.63 | 0.92 | 0.92 | - | - |
/// | 0.64 | 0.92 | 0.93 | - | 0.90 |
/// | 0.65 | 0.93 | 0.94 | 0.90 | 0.94 |
/// | 0.66 | 0.93 | 0.94 | 0.92 | 0.95 |
/// | 0.67 | 0.94 | 0.95 | 0.92 | 0.95 |
/// | 0.75 | 0.94 | 0.96 | 0.94 | 0.95 |
///
/// Where `coverage_radius` is below 0.707 of `min_distance`, no triangle is obtuse.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PushPullParams {
    /// No two points shall be nearer than this (the paper's r_f, "conflict radius"); in (0, 1]. More makes points more regular. Without it
    /// 0.001 is kept.
    pub min_distance: Option<f64>,
    /// No place shall be farther from the nearest point than this (r_c); 0.577 at least, that of the hexagonal lattice.
    pub coverage_radius: Option<f64>,
    /// The area of each Voronoi cell shall differ from the mean by at most this part of it; 0, which is
    /// 1e-8, or more. Without it, a start's long density waves stay. Less than 0.0386 takes many more
    /// passes; on a torus 0 converges with {0.85, 0.67}, in a rectangle mostly not.
    pub capacity_tolerance: Option<f64>,
    /// The part of each move that is made; in (0, 2). More than 1 reaches tougher targets, and makes points more regular; where it
    /// diverges the run goes on with 1. With [`Schedule::Summed`] these are halved: 0.5 converges, and where 1 diverges the run goes on with 0.5.
    pub relaxation: f64,
    /// Whether points move at each visit, or at the end of a pass. The second is the paper's parallel variant: it takes several times the
    /// passes, fails at tougher targets, and makes points less regular.
    pub schedule: Schedule,
    /// Stops after this many passes in any case; `None` for a limit that grows with the number of points,
    /// 2000 at least, and up to 20 attempts at few points.
    pub max_passes: Option<usize>,
    /// The order of visits depends on it.
    pub seed: u64,
}

/// Targets to choose from, with the tolerance and relaxation that they need.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum PushPullPreset {
    /// {0.75, 0.75}, tolerance 0.1: quick, and irregular.
    Fast,
    /// {0.85, 0.67}.
    #[default]
    Balanced,
    /// {0.90, 0.65}.
    Tough,
    /// {0.80, 0.63}: row 1 of the paper's Table 1, low aliasing.
    Paper1,
    /// {0.90, 0.65}: row 2, between the two.
    Paper2,
    /// {0.92, 0.62}: row 3, low noise. The paper does not tell its tolerance; 0.1 with a relaxation of 1.2 converges.
    Paper3,
}

impl Default for PushPullParams {
    fn default() -> Self {
        Self::preset(PushPullPreset::default())
    }
}

/// So many attempts are made, while they have taken fewer than [`QUICK`] visits: half a second.
const ATTEMPTS: usize = 20;
const QUICK: usize = 1_000_000;
/// So often points are transferred to where there is room, unless more than this share of them miss targets.
const TRANSFERS: usize = 4;
const FEW: f64 = 0.5;
/// In rectangles a smaller tolerance is not known to be reached together with {0.85, 0.67}.
const LEAST_IN_RECTANGLES: f64 = 0.005;

impl PushPullParams {
    /// The parameters of a preset.
    pub fn preset(preset: PushPullPreset) -> Self {
        let (min_distance, coverage_radius, tolerance, relaxation) = match preset {
            PushPullPreset::Fast => (0.75, 0.75, 0.1, 1.0),
            PushPullPreset::Balanced => (0.85, 0.67, 0.0386, 1.0),
            PushPullPreset::Tough | PushPullPreset::Paper2 => (0.90, 0.65, 0.0386, 1.0),
            PushPullPreset::Paper1 => (0.80, 0.63, 0.0386, 1.0),
            PushPullPreset::Paper3 => (0.92, 0.62, 0.1, 1.2),
        };
        Self {
            min_distance: Some(min_distance),
            coverage_radius: Some(coverage_radius),
            capacity_tolerance: Some(tolerance),
            relaxation,
            schedule: Schedule::InTurn,
            max_passes: None,
            seed: 0,
        }
    }

    pub(crate) fn rule(&self) -> PushPull {
        let &Self { min_distance, coverage_radius, capacity_tolerance, relaxation, .. } = self;
        PushPull { min_distance, coverage_radius, capacity_tolerance, relaxation }
    }

    /// Checks the parameters, as [`push_pull`] does before it begins.
    ///
    /// # Errors
    /// [`Error::InvalidParameter`] for a value outside its range, for no target at all, and for a distance that leaves larger gaps than the
    /// radius allows: more than sqrt(3) times as much.
    pub fn validate(&self) -> Result<(), Error> {
        let invalid = |name, value: String, expected| Err(Error::InvalidParameter { name, value, expected });
        let is_in = |value: Option<f64>, low: f64, high: f64| value.is_none_or(|value| value >= low && value <= high);
        let shown = |value: Option<f64>| value.map_or_else(|| "not given".into(), |value| value.to_string());
        if !is_in(self.min_distance, f64::MIN_POSITIVE, 1.0) {
            return invalid("min_distance", shown(self.min_distance), "positive, and 1 at most");
        }
        if !is_in(self.coverage_radius, 0.577, f64::MAX) {
            return invalid("coverage_radius", shown(self.coverage_radius), "0.577 or more, and finite");
        }
        if !is_in(self.capacity_tolerance, 0.0, f64::MAX) {
            return invalid("capacity_tolerance", shown(self.capacity_tolerance), "0 or more, and finite");
        }
        if !(self.relaxation > 0.0 && self.relaxation < 2.0) {
            return invalid("relaxation", self.relaxation.to_string(), "more than 0, and less than 2");
        }
        if self.max_passes == Some(0) {
            return invalid("max_passes", "0".into(), "1 or more");
        }
        match (self.min_distance, self.coverage_radius) {
            (None, None) if self.capacity_tolerance.is_none() => {
                invalid("min_distance", shown(None), "given, or the coverage radius, or the capacity tolerance: there is no target")
            }
            (Some(distance), Some(radius)) if distance > 3f64.sqrt() * radius => {
                invalid("min_distance", distance.to_string(), "at most 1.732 times the coverage radius, or both cannot be met")
            }
            _ => Ok(()),
        }
    }

    fn nearest_known(&self, points: &PointSet) -> Option<(f64, f64)> {
        let space = points.space();
        let width = space.size().into_iter().fold(f64::INFINITY, f64::min) / points.hex_spacing();
        let known = match self.schedule {
            Schedule::Summed => Known::Summed,
            Schedule::InTurn if space.is_periodic() => Known::OnTorus,
            Schedule::InTurn => Known::within_walls(width),
        };
        nearest_known(self.min_distance, self.coverage_radius, self.capacity_tolerance, known)
    }

    /// The relaxation from which on a run may diverge.
    fn safe_relaxation(&self) -> f64 {
        if self.schedule == Schedule::Summed { 0.5 } else { 1.0 }
    }

    /// Passes of all attempts together.
    fn most_passes(&self) -> usize {
        self.max_passes.unwrap_or(usize::MAX)
    }

    /// Passes that tough targets may take: more points have a worse worst spot.
    fn pass_limit(&self, n_points: usize) -> usize {
        (1000.0 * (libm::log10(n_points as f64) - 1.0)).max(2000.0) as usize
    }
}

impl Targets for PushPullParams {
    fn unmet(&self, measures: &Measures) -> Vec<UnmetTarget> {
        let unmet = |name, wanted: Option<f64>, measured: f64, is_met: fn(f64, f64) -> bool| {
            let wanted = wanted.filter(|&wanted| !is_met(measured, wanted))?;
            Some(UnmetTarget { name, wanted, measured })
        };
        let of_distance =
            unmet("min_distance", self.min_distance, measures.min_distance_held(), |distance, wanted| distance >= wanted - ROUNDING);
        let of_radius =
            unmet("coverage_radius", self.coverage_radius, measures.coverage_radius, |radius, wanted| radius <= wanted + ROUNDING);
        let of_capacity = unmet("capacity_tolerance", self.capacity_tolerance, measures.capacity_deviation_held(), is_tolerated);
        [of_distance, of_radius, of_capacity].into_iter().flatten().collect()
    }

    fn miss(&self, point: &PointMeasures) -> f64 {
        let of_distance = self.min_distance.map_or(0.0, |wanted| under(point.nearest, wanted));
        let of_radius = self.coverage_radius.map_or(0.0, |wanted| over(point.reach, wanted));
        let tolerance = self.capacity_tolerance.filter(|_| point.is_inner);
        let deviation = (point.capacity - 1.0).abs();
        let of_capacity = tolerance.filter(|&tolerance| !is_tolerated(deviation, tolerance)).map_or(0.0, |tolerance| deviation - tolerance);
        of_distance + of_radius + of_capacity
    }

    fn advice(&self, points: &PointSet) -> Option<String> {
        let is_bounded = !points.space().is_periodic() && self.min_distance.or(self.coverage_radius).is_some();
        if is_bounded && self.capacity_tolerance.is_some_and(|tolerance| tolerance < LEAST_IN_RECTANGLES) {
            return Some(format!("with other targets a capacity tolerance below {LEAST_IN_RECTANGLES} is not known to be reached here"));
        }
        let (distance, radius) = self.nearest_known(points)?;
        let named = |name: &str, wanted: Option<f64>, known: f64| wanted.map(|_| format!("{name} {known}"));
        let known = [named("min distance", self.min_distance, distance), named("coverage radius", self.coverage_radius, radius)];
        let known = known.into_iter().flatten().collect::<Vec<_>>().join(" with ");
        Some(format!("these targets are not known to be reached here, and the run may be long; the nearest that are: {known}"))
    }
}

/// Whether a deviation from the mean capacity is within a tolerance, to rounding.
fn is_tolerated(deviation: f64, tolerance: f64) -> bool {
    deviation <= tolerance.max(LEAST_TOLERANCE) * (1.0 + ROUNDING)
}

/// Optimises `points` in place; their number and order stay.
///
/// Where the targets are not reached, the report says so, and `points` are in the best state that was seen: that which misses a target by least. Where
/// they are tougher than what is known to be reached, that is reached first. Few points, some hundreds, begin again in other orders
/// of visits where targets are missed.
///
/// # Errors
/// [`Error::InvalidParameter`] as [`PushPullParams::validate`] has it; [`Error::TooFine`] where f64 cannot tell the points apart;
/// [`Error::Degenerate`] where they cannot be triangulated. The points are untouched then.
///
/// # Example
/// ```
/// use evenly::{Outcome, PushPullParams, RunContext, Torus, measure, push_pull, warp_isotropic, white};
///
/// let mut points = white(Torus::new([0.0, 0.0], [1.0, 1.0])?, 1000, 7)?;
/// warp_isotropic(&mut points);
/// let report = push_pull(&mut points, &PushPullParams::default(), &mut RunContext::default())?;
/// assert_eq!(report.outcome, Outcome::Converged);
/// let measures = measure(&points)?;
/// assert!(measures.min_distance >= 0.85 && measures.coverage_radius <= 0.67);
/// # Ok::<(), evenly::Error>(())
/// ```
pub fn push_pull(points: &mut PointSet, params: &PushPullParams, run: &mut RunContext) -> Result<Report, Error> {
    params.validate()?;
    let mut report = Report::new("push-pull", points.n_points());
    report.notes.extend(params.advice(points));
    push_and_pull(points, params, run, &mut report)?;
    conclude(points, params, &mut report);
    Ok(report)
}

/// As [`push_pull`], for whichever method.
pub(super) fn push_and_pull(
    points: &mut PointSet,
    params: &PushPullParams,
    run: &mut RunContext,
    report: &mut Report,
) -> Result<(), Error> {
    attempt(points, params, run, report)?;
    let mut miss = if report.outcome == Outcome::Forced { params.total_miss(points) } else { 0.0 };
    for _ in 0..TRANSFERS {
        if report.outcome != Outcome::Forced || params.share_missing(points) > FEW {
            break;
        }
        let Some(mut moved) = transferred(points)? else { break };
        push_and_pull_once(&mut moved, params, run, report)?;
        let missed = params.total_miss(&moved);
        if missed >= miss {
            report.outcome = Outcome::Forced;
            break;
        }
        (*points, miss) = (moved, missed);
    }
    Ok(())
}

/// Few points may come to rest in one order of visits and not in another: where targets are missed, they
/// begin again from the start, while that is quick. The attempt that misses the targets by least counts.
fn attempt(points: &mut PointSet, params: &PushPullParams, run: &mut RunContext, report: &mut Report) -> Result<(), Error> {
    let start = points.clone();
    let n_notes = report.notes.len();
    push_and_pull_once(points, params, run, report)?;
    let n_points = points.n_points();
    let mut miss = None;
    for _ in 1..ATTEMPTS {
        let is_out_of_passes = report.iterations * n_points > QUICK || report.iterations >= params.most_passes();
        if report.outcome != Outcome::IterationLimit || is_out_of_passes {
            break;
        }
        let least = *miss.get_or_insert_with(|| params.total_miss(points));
        let mut again = start.clone();
        report.notes.truncate(n_notes);
        push_and_pull_once(&mut again, params, run, report)?;
        let missed = params.total_miss(&again);
        if report.outcome == Outcome::Converged || missed < least {
            (*points, miss) = (again, Some(missed));
        }
    }
    Ok(())
}

/// Visits until all points are at rest.
fn push_and_pull_once(points: &mut PointSet, params: &PushPullParams, run: &mut RunContext, report: &mut Report) -> Result<(), Error> {
    // Distinct points, and their Delaunay triangulation.
    let Some((domain, mesh)) = triangulated(points, report, run)? else { return Ok(()) };
    let is_patient = mesh.patience.has_any();
    let mut sweep = Sweep::new(mesh);
    let mut plan = Plan {
        schedule: params.schedule,
        keeps_best: true,
        ends_if_diverging: params.relaxation > params.safe_relaxation(),
        // In the nooks of a boundary targets may not be reached at all.
        ends_if_stuck: points.space().region().is_some(),
        ..Plan::of_passes(params.most_passes().min(report.iterations + params.pass_limit(points.n_points())), params.seed)
    };

    // Of targets that are not known to be reached, first the nearest that are.
    let rule = params.rule();
    let mut fallback = None;
    if let Some((distance, radius)) = params.nearest_known(points) {
        let known =
            PushPull { min_distance: rule.min_distance.map(|_| distance), coverage_radius: rule.coverage_radius.map(|_| radius), ..rule };
        if settle(&mut sweep, known, params, &plan, run, report)? != Ending::Converged {
            sweep.return_to_best()?;
            report.triangulations += 1;
        }
        fallback = Some(sweep.change_rule(report.iterations));
        plan.ends_if_stuck = true;
    }

    // Visits, until no point has to move another.
    let ending = if points.density().is_uniform() {
        settle(&mut sweep, rule, params, &plan, run, report)?
    } else {
        settle_by_density(&mut sweep, rule, &plan, run, report)
    };
    report.outcome = match ending {
        Ending::Converged => Outcome::Converged,
        Ending::Cancelled => Outcome::Cancelled,
        Ending::PassLimit | Ending::Diverging | Ending::Stuck => Outcome::IterationLimit,
    };
    let (order, best) = sweep.into_best();
    if matches!(report.outcome, Outcome::Converged | Outcome::Cancelled) {
        points.place(&domain, &order, &best);
    } else {
        let states = [Some(best), fallback].into_iter().flatten();
        let states = states.map(|places| points.moved(&domain, &order, &places));
        let miss;
        (*points, miss) = nearest_to_targets(points.clone(), states, params);
        let is_reached = miss == 0.0;
        if report.outcome == Outcome::IterationLimit && is_reached {
            report.outcome = Outcome::Converged;
        }
    }
    let is_missed = || measure(points).is_ok_and(|measures| !params.unmet(&measures).is_empty());
    if report.outcome == Outcome::Converged && is_patient && is_missed() {
        report.outcome = Outcome::Forced;
    }
    if report.outcome == Outcome::Converged && is_lost_to_rounding(points, params) {
        report.outcome = Outcome::LostToRounding;
        report
            .notes
            .push("the targets were reached, but lost in rounding to coordinates so far from 0; move the origin nearer to it".into());
    }
    if report.outcome != Outcome::Converged || params.min_distance.is_none() {
        keep_distinct(points);
    }
    Ok(())
}

/// Where a density is rough, a few cells may throw points to and fro between them for ever: moves of another size end that. So many passes are made with each of
/// these parts of the relaxation.
const STAGE: usize = 300;
const PARTS: [f64; 3] = [1.0, 0.6, 0.8];

fn settle_by_density(sweep: &mut Sweep, rule: PushPull, plan: &Plan, run: &mut RunContext, report: &mut Report) -> Ending {
    let mut n_stages = 0;
    loop {
        let stage = PushPull { relaxation: PARTS[n_stages % PARTS.len()] * rule.relaxation, ..rule };
        n_stages += 1;
        let max_passes = plan.max_passes.min(report.iterations + STAGE);
        let ending = sweep.run(&stage, &Plan { max_passes, ..*plan }, run, report);
        if ending != Ending::PassLimit || max_passes == plan.max_passes {
            return ending;
        }
    }
}

/// Sweeps, and where a large relaxation leads nowhere, once more with a safe one.
fn settle(
    sweep: &mut Sweep,
    mut rule: PushPull,
    params: &PushPullParams,
    plan: &Plan,
    run: &mut RunContext,
    report: &mut Report,
) -> Result<Ending, Error> {
    let ending = sweep.run(&rule, plan, run, report);
    if ending != Ending::Diverging {
        return Ok(ending);
    }
    rule.relaxation = params.safe_relaxation();
    let (tried, passes, safe) = (params.relaxation, report.iterations, rule.relaxation);
    report.notes.push(format!("relaxation {tried} had made no progress by pass {passes}; from the best state on it was {safe}"));
    sweep.return_to_best()?;
    report.triangulations += 1;
    Ok(sweep.run(&rule, &Plan { ends_if_diverging: false, ..*plan }, run, report))
}

/// Of the start and some states that which misses the targets by least, all points taken together, and by how much.
fn nearest_to_targets(start: PointSet, states: impl Iterator<Item = PointSet>, params: &PushPullParams) -> (PointSet, f64) {
    let missing = |points: PointSet| {
        let miss = params.total_miss(&points);
        (points, miss)
    };
    states.map(missing).fold(missing(start), |best, other| if other.1 < best.1 { other } else { best })
}
