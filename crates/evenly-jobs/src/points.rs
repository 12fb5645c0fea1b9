//! Points: made of nothing ([`GenerateRequest`]), or of other points ([`OptimizeRequest`]).

use evenly::{
    Group, Measures, Method, Optimizer, Outcome, PointSet, Report, Settings, Space, UnmetTarget, angle_bounds_deg, hexagonal_spacing,
    measure, warp_isotropic,
};
use serde::{Deserialize, Serialize};

use crate::context::{Context, Stage};
use crate::error::Error;
use crate::given::{density_of, fixed_of, joined, measured_in, positioned};
use crate::memory;
use crate::message::Message;
use crate::method::{Job, optimizer, require_beginning, require_density, require_density_of_start};
use crate::resource::{Pixels, Positions, Resource, Resources};
use crate::space::{Domain, Metric};

/// Points from nothing.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct GenerateRequest {
    /// How many, exactly; of `poisson-disk` about.
    pub n_points: Option<usize>,
    /// How they are made: by an optimiser, or as one of its starts.
    #[cfg_attr(test, schemars(with = "crate::schema::MethodName"))]
    pub method: Method,
    /// What the method is told.
    #[cfg_attr(test, schemars(with = "crate::schema::Parameters"))]
    pub parameters: Settings,
    /// What an optimiser starts from; its own default if none is named.
    #[cfg_attr(test, schemars(with = "Option<crate::schema::MethodName>"))]
    pub start: Option<Method>,
    /// Not to even out points before they are optimised.
    pub no_warp: bool,
    /// The same seed makes the same points.
    pub seed: u64,
    /// Where they are.
    pub space: Domain,
    /// In whose units distances count.
    pub metric: Metric,
    /// How many are wanted where.
    pub density: Option<Resource<Pixels>>,
    /// Points that stay where they are; they are among the `n_points`, and come first.
    pub fixed: Option<Resource<Positions>>,
}

/// Better points from points.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct OptimizeRequest {
    /// The points.
    pub points: Resource<Positions>,
    /// How they are improved.
    #[serde(default)]
    #[cfg_attr(test, schemars(with = "crate::schema::MethodName"))]
    pub method: Method,
    /// What the method is told.
    #[serde(default)]
    #[cfg_attr(test, schemars(with = "crate::schema::Parameters"))]
    pub parameters: Settings,
    /// Not to even out points before they are optimised.
    #[serde(default)]
    pub no_warp: bool,
    /// The same seed makes the same points.
    #[serde(default)]
    pub seed: u64,
    /// Where they are; where their file says, or else in the unit torus.
    #[serde(default)]
    pub space: Option<Domain>,
    /// In whose units distances count.
    #[serde(default)]
    pub metric: Metric,
    /// How many are wanted where.
    #[serde(default)]
    pub density: Option<Resource<Pixels>>,
    /// Points that stay where they are. They come first; points at their places are left out.
    #[serde(default)]
    pub fixed: Option<Resource<Positions>>,
}

/// Points, and how they came about.
pub struct PointsOutcome {
    /// The points, in the units in which distances count.
    pub points: PointSet,
    /// What the points of the unit square are restored to.
    given: Option<PointSet>,
    /// How they were made.
    pub method: Method,
    /// The same with what it was told; `None` of a method that makes points at once.
    pub optimizer: Option<Box<dyn Optimizer>>,
    /// What the optimiser did.
    pub report: Option<Report>,
    /// What the user should know.
    pub notes: Vec<Message>,
    /// Whether the targets are a wish, not only what the default method aims at.
    is_asked: bool,
    is_cancelled: bool,
}

/// What points are worth.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PointsMeasured {
    /// Absent for fewer than three points, or all on one line.
    pub measures: Option<Measures>,
    /// The targets that were not reached; absent for a method that has none.
    pub unmet: Option<Vec<UnmetTarget>>,
    /// The measured lengths in units; absent where the density varies them.
    pub lengths: Option<PointsLengths>,
}

/// Lengths in the units in which distances count: those of the input, or of the unit square.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PointsLengths {
    /// The smallest distance of two points.
    pub min_distance: f64,
    /// The largest distance of a place to the nearest point.
    pub coverage_radius: f64,
}

/// How a job ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Ending {
    /// All that was asked for is there, as far as the input allows it.
    Done,
    /// Something that was asked for was not reached.
    Missed,
    /// Somebody ended it.
    Cancelled,
}

impl GenerateRequest {
    /// Checks what can be checked without data.
    ///
    /// # Errors
    /// Parameters that the method does not have, or outside their range; parts that do not go together; points that do not fit into memory.
    pub fn check(&self) -> Result<(), Error> {
        require_beginning(self.method, self.start, !self.no_warp)?;
        Job::Generate.check(self.method, &self.parameters)?;
        if self.density.is_some() {
            require_density(self.method)?;
        }
        match self.n_points {
            Some(n_points) => memory::require_points(n_points, self.method),
            None if self.method.is_optimizer() => Err(missing_number().into()),
            None => Ok(()),
        }
    }

    /// Makes the points.
    ///
    /// # Errors
    /// As [`check`](Self::check), for data that cannot be worked with, and as the method.
    pub fn run(&self, resources: &mut dyn Resources, context: &mut Context) -> Result<PointsOutcome, Error> {
        self.check()?;
        let Self { n_points, method, parameters, seed, metric, .. } = self;
        let (space, repairs) = self.space.space(resources)?;
        let mut notes = Vec::new();
        repairs.into_iter().for_each(|repair| context.note(&mut notes, repair));
        let begin = self.start.unwrap_or(method.default_start(&space, self.density.is_some()));
        if self.density.is_some() && method.is_optimizer() {
            require_density_of_start(begin)?;
        }
        context.enter(Stage::Read);
        let density = density_of(self.density.as_ref(), resources)?;
        let given = fixed_of(self.fixed.as_ref(), &space, resources)?.with_density(&density);
        let (fixed, given) = measured_in(*metric, given)?;
        let spacing = n_points.map_or(f64::NAN, |n| hexagonal_spacing(fixed.space().area(), n as f64));
        let (parameters, optimizer) = optimizer(*method, parameters, density.is_uniform().then_some(spacing), *seed)?;
        let parameters = &parameters;
        let is_asked = is_asked(*method, parameters);
        let made = PointsOutcome { points: fixed, given, method: *method, optimizer, report: None, notes, is_asked, is_cancelled: false };
        context.enter(Stage::Start);
        match &made.optimizer {
            Some(_) => {
                let n_points = n_points.ok_or_else(missing_number)?;
                let points = begin.start(&made.points, n_points, *seed)?;
                // Only white noise has long density waves.
                made.improved(points, begin.has_long_waves() && !self.no_warp, context)
            }
            None => {
                let (points, note) = method.make(parameters, &made.points, *n_points, *seed)?;
                let notes = made.notes.into_iter().chain(note.map(Message::from)).collect();
                Ok(PointsOutcome { points, notes, ..made })
            }
        }
    }
}

impl OptimizeRequest {
    /// The same with the defaults.
    pub fn of(points: Resource<Positions>) -> Self {
        Self {
            points,
            method: Method::default(),
            parameters: Settings::default(),
            no_warp: false,
            seed: 0,
            space: None,
            metric: Metric::Input,
            density: None,
            fixed: None,
        }
    }

    /// Checks what can be checked without data.
    ///
    /// # Errors
    /// As [`GenerateRequest::check`].
    pub fn check(&self) -> Result<(), Error> {
        Job::Optimize.require("method", self.method)?;
        require_beginning(self.method, None, !self.no_warp)?;
        if self.density.is_some() {
            require_density(self.method)?;
        }
        Job::Optimize.check(self.method, &self.parameters)
    }

    /// Improves the points.
    ///
    /// # Errors
    /// As [`check`](Self::check), for data that cannot be worked with, and as the method.
    pub fn run(&self, resources: &mut dyn Resources, context: &mut Context) -> Result<PointsOutcome, Error> {
        self.check()?;
        context.enter(Stage::Read);
        let (points, told) = positioned(&self.points, self.space.as_ref(), resources)?;
        let mut notes = Vec::new();
        told.into_iter().for_each(|note| context.note(&mut notes, note));
        let fixed = fixed_of(self.fixed.as_ref(), points.space(), resources)?;
        let points = joined(&fixed, points)?;
        memory::require_points(points.n_points(), self.method)?;
        let density = density_of(self.density.as_ref(), resources)?;
        let (points, given) = measured_in(self.metric, points.with_density(&density))?;
        let spacing = density.is_uniform().then(|| points.hex_spacing());
        let (_, optimizer) = optimizer(self.method, &self.parameters, spacing, self.seed)?;
        let begin = PointSet::new(points.space(), Vec::new())?;
        let is_asked = is_asked(self.method, &self.parameters);
        let made =
            PointsOutcome { points: begin, given, method: self.method, optimizer, report: None, notes, is_asked, is_cancelled: false };
        made.improved(points, !self.no_warp, context)
    }
}

impl PointsOutcome {
    /// Lets the optimiser improve points, evened out first if it is wanted and suits it. What came in is kept where it was nearer to the targets.
    fn improved(self, mut points: PointSet, is_warped: bool, context: &mut Context) -> Result<Self, Error> {
        let Self { given, method, optimizer, mut notes, is_asked, .. } = self;
        let Some(method_told) = optimizer.as_deref() else {
            return Ok(Self { points, given, method, optimizer, report: None, notes, is_asked, is_cancelled: false });
        };
        let warp = warp_for(&points, method_told, is_warped);
        let start = (warp.is_some() && method_told.targets().is_some()).then(|| points.clone());
        if let Some(warp) = warp {
            context.enter(Stage::Warp);
            warp(&mut points);
        }
        if let Some(advice) = method_told.targets().and_then(|targets| targets.advice(&points)) {
            context.note(&mut notes, advice.into());
        }
        // The points that came in are a state to keep.
        context.enter(Stage::Optimize);
        let report = context.run(|run| method_told.run(&mut points, run))?;
        for note in notes_on(&report) {
            if !notes.contains(&note) {
                notes.push(note);
            }
        }
        // Whoever has ended it wants the state reached, and soon.
        let is_cancelled = report.outcome == Outcome::Cancelled || context.is_cancelled();
        if let Some(start) = start.filter(|_| !is_cancelled) {
            context.enter(Stage::Measure);
            if is_nearer(&start, &points, &report, method_told) {
                notes.push("the points that came in miss the targets by less, and are written".into());
                points = start;
            }
        }
        Ok(Self { points, given, method, optimizer, report: Some(report), notes, is_asked, is_cancelled })
    }

    /// The points in the units that they were given in.
    ///
    /// # Errors
    /// As [`PointSet::restored_to`].
    pub fn restored(&self) -> Result<PointSet, Error> {
        Ok(match &self.given {
            Some(given) => self.points.restored_to(given)?,
            None => self.points.clone(),
        })
    }

    /// Whether the points were given in other units than those in which distances count.
    pub fn is_restored(&self) -> bool {
        self.given.is_some()
    }

    /// The domain, in the units that it was given in.
    pub fn space(&self) -> &Space {
        self.given.as_ref().unwrap_or(&self.points).space()
    }

    /// Whether it can be said that something was not reached.
    pub fn has_targets(&self) -> bool {
        self.optimizer.as_ref().is_some_and(|optimizer| optimizer.targets().is_some())
    }

    /// Measures the points.
    pub fn measured(&self) -> PointsMeasured {
        let measures = measure(&self.points).ok();
        let targets = self.optimizer.as_ref().and_then(|optimizer| optimizer.targets());
        let unmet = targets.zip(measures.as_ref()).map(|(targets, measures)| targets.unmet(measures));
        let is_uniform = self.points.density().is_uniform();
        let lengths = measures.as_ref().filter(|_| is_uniform).map(|measures| PointsLengths {
            min_distance: measures.min_distance * measures.hex_spacing,
            coverage_radius: measures.coverage_radius * measures.hex_spacing,
        });
        PointsMeasured { measures, unmet, lengths }
    }

    /// How the job ended; without measures, as the report says.
    pub fn ending(&self, measured: Option<&PointsMeasured>) -> Ending {
        let unmet = measured.and_then(|measured| measured.unmet.as_ref());
        match self.report.as_ref().map(|report| report.outcome) {
            _ if self.is_cancelled => Ending::Cancelled,
            Some(Outcome::Forced) => Ending::Done,
            _ if self.has_targets() && !self.is_asked => Ending::Done,
            _ if unmet.is_some_and(|unmet| !unmet.is_empty()) => Ending::Missed,
            Some(Outcome::IterationLimit | Outcome::LostToRounding) if unmet.is_none() => Ending::Missed,
            _ => Ending::Done,
        }
    }

    /// Whether somebody has ended it.
    pub fn is_cancelled(&self) -> bool {
        self.is_cancelled
    }
}

impl PointsMeasured {
    /// The angles between which beta certifies those of all triangles to lie, if there are any.
    pub fn certified_angles_deg(&self) -> Option<[f64; 2]> {
        let measures = self.measures.as_ref()?;
        angle_bounds_deg(measures.beta).filter(|_| !measures.angle_rms_deg.is_nan())
    }
}

/// Whether targets are asked for: one by one, or by a method that has them and is not the default.
fn is_asked(method: Method, parameters: &Settings) -> bool {
    let is_target = |name: &str| method.parameters().iter().any(|(about, _)| about.name == name && about.group == Group::Targets);
    method != Method::default() || parameters.names().any(is_target)
}

/// What evens out these points first, if anything.
pub(crate) fn warp_for(points: &PointSet, optimizer: &dyn Optimizer, is_wanted: bool) -> Option<fn(&mut PointSet)> {
    // By a density every method begins with points that follow it.
    let by_density = (!points.density().is_uniform()).then_some(warp_isotropic as fn(&mut PointSet));
    let can_warp = is_wanted && points.n_points() >= 3 && points.space().region().is_none();
    optimizer.method().warp().or(by_density).filter(|_| can_warp)
}

/// Whether points that came in miss the targets by less than what a run has made of them, all points taken together.
fn is_nearer(start: &PointSet, made: &PointSet, report: &Report, optimizer: &dyn Optimizer) -> bool {
    let targets = optimizer.targets().filter(|_| report.outcome != Outcome::Converged);
    targets.is_some_and(|targets| targets.total_miss(start) < targets.total_miss(made))
}

/// What the user should know of a run.
fn notes_on(report: &Report) -> Vec<Message> {
    let mut notes: Vec<Message> = report.notes.iter().cloned().map(Message::from).collect();
    if report.coincident_points > 0 {
        notes.push(format!("{} points shared their place with another and were moved apart", report.coincident_points).into());
    }
    if report.was_collinear {
        notes.push("all points lay on or near one line and were spread first".into());
    }
    notes
}

fn missing_number() -> evenly::Error {
    evenly::Error::Missing { names: &["n_points"], question: "how many?" }
}
