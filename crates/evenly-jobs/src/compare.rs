//! [`CompareRequest`]: several methods on the same points.

use std::time::Instant;

use evenly::{Measures, Method, Outcome, PointSet, Settings, Space, hexagonal_spacing, measure};
use serde::{Deserialize, Serialize};

use crate::context::{Context, Event, Stage};
use crate::error::Error;
use crate::given::{density_of, measured_in, positioned};
use crate::memory;
use crate::message::Message;
use crate::method::{Job, optimizer, require_density, require_density_of_start};
use crate::points::warp_for;
use crate::resource::{Pixels, Positions, Resource, Resources};
use crate::space::{Domain, Metric};

/// Several methods on the same points.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct CompareRequest {
    /// Points that all begin with; new ones for each run if there are none.
    pub points: Option<Resource<Positions>>,
    /// How many points, without any given.
    pub n_points: Option<usize>,
    /// What is compared; all methods if none is named.
    pub methods: Vec<Compared>,
    /// What all methods are told that take it.
    #[cfg_attr(test, schemars(with = "crate::schema::Parameters"))]
    pub parameters: Settings,
    /// How often each runs, each time with the next seed.
    pub runs: u16,
    /// What optimisers start from, without points given.
    #[cfg_attr(test, schemars(with = "Option<crate::schema::MethodName>"))]
    pub start: Option<Method>,
    /// Not to even out points before they are optimised.
    pub no_warp: bool,
    /// The first run's seed.
    pub seed: u64,
    /// Where the points are; where the file of given ones says, or else in the unit torus.
    pub space: Option<Domain>,
    /// In whose units distances count.
    pub metric: Metric,
    /// How many are wanted where.
    pub density: Option<Resource<Pixels>>,
}

impl Default for CompareRequest {
    fn default() -> Self {
        Self {
            points: None,
            n_points: None,
            methods: Vec::new(),
            parameters: Settings::default(),
            runs: 3,
            start: None,
            no_warp: false,
            seed: 0,
            space: None,
            metric: Metric::Input,
            density: None,
        }
    }
}

/// A method, and what it alone is told.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Compared {
    /// What its runs are called.
    pub label: String,
    /// The method.
    #[cfg_attr(test, schemars(with = "crate::schema::MethodName"))]
    pub method: Method,
    /// What it alone is told.
    #[serde(default)]
    #[cfg_attr(test, schemars(with = "crate::schema::Parameters"))]
    pub parameters: Settings,
}

impl From<Method> for Compared {
    fn from(method: Method) -> Self {
        Self { label: method.name().into(), method, parameters: Settings::default() }
    }
}

/// Methods side by side.
pub struct CompareOutcome {
    /// Where the points are, in the units in which distances count.
    pub space: Space,
    /// How many there are.
    pub n_points: usize,
    /// What optimisers started from; `None` for points that were given.
    pub start: Option<Method>,
    /// Those methods that were run.
    pub columns: Vec<Column>,
    /// What the user should know.
    pub notes: Vec<Message>,
    /// Whether runs are missing since somebody ended it.
    pub is_cancelled: bool,
}

/// The runs of one method.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Column {
    /// What they are called.
    pub method: String,
    /// The runs.
    pub runs: Vec<CompareRun>,
    /// The first run's points.
    #[serde(skip)]
    pub first: Option<PointSet>,
}

/// One run of a method.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CompareRun {
    /// Its seed.
    pub seed: u64,
    /// Wall time, with the warp, without the measuring.
    pub seconds: f64,
    /// Iterations or passes, of optimisers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub iterations: Option<usize>,
    /// Whether its targets were reached; absent for a method without any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub is_reached: Option<bool>,
    /// What has come of it.
    pub measures: Measures,
}

/// What all runs begin with.
struct Begin {
    space: Space,
    density: evenly::Density,
    n_points: usize,
    start: Method,
    given: Option<PointSet>,
}

impl CompareRequest {
    /// What is compared, in a space.
    fn compared(&self, space: &Space) -> Vec<Compared> {
        if !self.methods.is_empty() {
            return self.methods.clone();
        }
        let has_density = self.density.is_some();
        let is_there = |method: &Method| method.takes_space(space) && (method.knows_density() || !has_density) && method.name() != "warp";
        Method::all().filter(is_there).map(Compared::from).collect()
    }

    /// What a method is told: of what all are told its own, and what it alone is told.
    fn told(&self, compared: &Compared) -> Settings {
        compared.method.own(&self.parameters).overlaid(&compared.parameters)
    }

    /// Runs the methods, one after the other.
    ///
    /// # Errors
    /// Parts that do not go together, what methods are told wrongly, and data that cannot be worked with.
    pub fn run(&self, resources: &mut dyn Resources, context: &mut Context) -> Result<CompareOutcome, Error> {
        context.enter(Stage::Read);
        let mut notes = Vec::new();
        let (space, given) = match &self.points {
            Some(points) => {
                let (points, told) = positioned(points, self.space.as_ref(), resources)?;
                told.into_iter().for_each(|note| context.note(&mut notes, note));
                (points.space().clone(), Some(points))
            }
            None => {
                let (space, repairs) = self.space.clone().unwrap_or_default().space(resources)?;
                repairs.into_iter().for_each(|repair| context.note(&mut notes, repair));
                (space, None)
            }
        };
        let compared = self.compared(&space);
        let methods: Vec<Method> = compared.iter().map(|each| each.method).collect();
        Job::Generate.require_taken(&self.parameters, &methods)?;
        if self.density.is_some() {
            methods.iter().try_for_each(|&method| require_density(method))?;
        }
        if let Some(start) = self.start {
            Job::Start.require("start", start)?;
        }
        let density = density_of(self.density.as_ref(), resources)?;
        let given = given.map(|points| measured_in(self.metric, points.with_density(&density))).transpose()?.map(|(points, _)| points);
        let space = if self.metric == Metric::Unit { space.in_unit_square() } else { space };
        let n_points = given.as_ref().map(PointSet::n_points).or(self.n_points);
        let n_points = n_points.ok_or(evenly::Error::Missing { names: &["n_points"], question: "how many?" })?;
        if n_points < 3 {
            return Err(Message::from(format!("{n_points} points: to compare methods takes 3 or more")).into());
        }
        // What is wrong with a parameter is said before the work begins.
        for each in &compared {
            Job::Generate.check(each.method, &self.told(each))?;
            memory::require_points(n_points, each.method)?;
        }
        let start = self.start.unwrap_or(Method::default().default_start(&space, self.density.is_some()));
        if self.density.is_some() {
            require_density_of_start(start)?;
        }
        let begin = Begin { space, density, n_points, start, given };
        let mut columns = Vec::new();
        context.enter(Stage::Optimize);
        for each in &compared {
            let mut column = Column { method: each.label.clone(), runs: Vec::new(), first: None };
            for (k, seed) in (0..self.runs).map(|k| (k, self.seed.wrapping_add(k.into()))) {
                context.tell(Event::Run { label: &each.label, n_runs: compared.len() * usize::from(self.runs) });
                let Some((run, points)) = self.one(each, &begin, seed, &mut notes, context)? else { continue };
                if k == 0 {
                    column.first = Some(points);
                }
                column.runs.push(run);
            }
            if !column.runs.is_empty() {
                columns.push(column);
            }
        }
        let Begin { space, n_points, start, given, .. } = begin;
        let start = given.is_none().then_some(start);
        Ok(CompareOutcome { space, n_points, start, columns, notes, is_cancelled: context.is_cancelled() })
    }

    /// One run of a method; `None` if it was interrupted, or has made what cannot be measured.
    fn one(
        &self,
        compared: &Compared,
        begin: &Begin,
        seed: u64,
        notes: &mut Vec<Message>,
        context: &mut Context,
    ) -> Result<Option<(CompareRun, PointSet)>, Error> {
        if context.is_cancelled() {
            return Ok(None);
        }
        let method = compared.method;
        let spacing = hexagonal_spacing(begin.space.area(), begin.n_points as f64);
        let (settings, optimizer) = optimizer(method, &self.told(compared), begin.density.is_uniform().then_some(spacing), seed)?;
        let mut points = match (&optimizer, &begin.given) {
            (Some(_), Some(given)) => given.clone(),
            (Some(_), None) => begin.start.start_in(&begin.space, &begin.density, begin.n_points, seed)?,
            (None, _) => PointSet::new(&begin.space, Vec::new())?.with_density(&begin.density),
        };
        let clock = Instant::now();
        let mut report = None;
        match &optimizer {
            Some(optimizer) => {
                // Of the starts, only white noise has long density waves.
                let is_warped = !self.no_warp && (begin.given.is_some() || begin.start.has_long_waves());
                if let Some(warp) = warp_for(&points, &**optimizer, is_warped) {
                    warp(&mut points);
                }
                report = Some(optimizer.run(&mut points, &mut context.silent())?);
            }
            // As they are, not as a start: a maximal set's number of points is chance.
            None => points = method.make(&settings, &points, Some(begin.n_points), seed)?.0,
        }
        let seconds = clock.elapsed().as_secs_f64();
        if report.as_ref().is_some_and(|report| report.outcome == Outcome::Cancelled) {
            return Ok(None);
        }
        // What cannot be measured is said, and the others go on.
        let measures = match measure(&points) {
            Ok(measures) => measures,
            Err(error) => {
                context.note(notes, format!("{}, seed {seed}: {error}", compared.label).into());
                return Ok(None);
            }
        };
        let targets = optimizer.as_ref().and_then(|optimizer| optimizer.targets());
        let is_reached = targets.map(|targets| targets.unmet(&measures).is_empty());
        let iterations = report.map(|report| report.iterations);
        Ok(Some((CompareRun { seed, seconds, iterations, is_reached, measures }, points)))
    }
}
