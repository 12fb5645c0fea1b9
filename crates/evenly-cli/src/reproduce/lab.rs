//! Where reproductions work: runs that can be interrupted, and what is measured of their points.

use std::fmt::{Display, Formatter};
use std::path::PathBuf;
use std::time::Instant;

use anyhow::Context as _;
use evenly::{
    CancelToken, Density, Error, Measures, Method, Optimizer, Outcome, PointSet, PoissonDiskParams, PowerSpectrum, RadialSpectrum, Report,
    RunContext, Space, Torus, measure, poisson_disk, power_spectrum, radial_spectrum,
};
use evenly_io::{Draw, Subject, figure};
use indicatif::ProgressBar;

/// That Ctrl-C ended it.
#[derive(Debug)]
pub struct Interrupted;

impl Display for Interrupted {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        f.write_str("interrupted")
    }
}

impl std::error::Error for Interrupted {}

pub struct Lab {
    pub is_quick: bool,
    pub cancel: CancelToken,
    pub bar: ProgressBar,
    /// Models in files, for what is shown on them.
    pub models: Vec<PathBuf>,
}

/// How a set is made.
pub struct Recipe {
    pub name: &'static str,
    start: Start,
    is_warped: bool,
    optimizer: Option<Box<dyn Optimizer>>,
}

#[derive(Clone, Copy)]
enum Start {
    /// Exactly as many points as asked for.
    Exact(&'static str),
    /// Maximal Poisson-disk sampling itself, whose number is chance; the largest distance to a point, by the smallest of two points, is this.
    Maximal(f64),
}

/// A set, and how it came about.
pub struct Run {
    pub points: PointSet,
    pub report: Option<Report>,
    /// Wall time, with the warp and without the start.
    pub seconds: f64,
    pub start_seconds: f64,
}

impl Recipe {
    /// A start by itself.
    pub fn start(name: &'static str, start: &'static str) -> Self {
        Self { name, start: Start::Exact(start), is_warped: false, optimizer: None }
    }

    /// Maximal Poisson-disk sampling with about as many points: beta is this, from 1 to 2.
    pub fn maximal(name: &'static str, beta: f64) -> Self {
        Self { name, start: Start::Maximal(beta), is_warped: false, optimizer: None }
    }

    /// An optimiser, from points as they are.
    pub fn plain(name: &'static str, start: &'static str, optimizer: impl Optimizer + 'static) -> Self {
        Self { name, start: Start::Exact(start), is_warped: false, optimizer: Some(Box::new(optimizer)) }
    }

    /// An optimiser as the command line runs it: from white noise, evened out first if that suits the method.
    pub fn usual(name: &'static str, optimizer: impl Optimizer + 'static) -> Self {
        Self { name, start: Start::Exact("white"), is_warped: true, optimizer: Some(Box::new(optimizer)) }
    }
}

impl Lab {
    /// The torus on which all papers work.
    pub fn torus() -> Result<Space, Error> {
        Ok(Torus::new([0.0, 0.0], [1.0, 1.0])?.into())
    }

    /// What a quick run takes, or a full one.
    pub fn pick<T>(&self, quick: T, full: T) -> T {
        if self.is_quick { quick } else { full }
    }

    pub fn run(&self, recipe: &Recipe, n_points: usize, seed: u64) -> anyhow::Result<Run> {
        self.run_on(Self::torus()?, recipe, n_points, seed)
    }

    pub fn run_on(&self, space: Space, recipe: &Recipe, n_points: usize, seed: u64) -> anyhow::Result<Run> {
        self.check()?;
        self.bar.set_message(format!("{}, {n_points} points", recipe.name));
        let clock = Instant::now();
        let mut points = match recipe.start {
            Start::Exact(method) => named(method)?.start_in(&space, &Density::uniform(), n_points, seed)?,
            Start::Maximal(beta) => maximal(&space, n_points, beta, seed)?,
        };
        let start_seconds = clock.elapsed().as_secs_f64();
        let clock = Instant::now();
        let mut report = None;
        if let Some(optimizer) = &recipe.optimizer {
            if let Some(warp) = optimizer.method().warp().filter(|_| recipe.is_warped) {
                warp(&mut points);
            }
            let done = optimizer.run(&mut points, &mut RunContext::default().with_cancel(self.cancel.clone()))?;
            if done.outcome == Outcome::Cancelled {
                return Err(Interrupted.into());
            }
            report = Some(done);
        }
        Ok(Run { points, report, seconds: clock.elapsed().as_secs_f64(), start_seconds })
    }

    /// As many sets as there are seeds.
    pub fn sets(&self, recipe: &Recipe, n_points: usize, n_sets: u64) -> anyhow::Result<Vec<PointSet>> {
        (0..n_sets).map(|seed| Ok(self.run(recipe, n_points, seed)?.points)).collect()
    }

    /// # Errors
    /// [`Interrupted`] after Ctrl-C.
    pub fn check(&self) -> Result<(), Interrupted> {
        if self.cancel.is_cancelled() { Err(Interrupted) } else { Ok(()) }
    }
}

/// The method of this name.
pub fn named(name: &str) -> anyhow::Result<Method> {
    Method::named(name).with_context(|| format!("{name:?} is no method"))
}

/// A maximal set of about this many points.
fn maximal(space: &Space, n_points: usize, beta: f64, seed: u64) -> Result<PointSet, Error> {
    let of = |spacing: f64| poisson_disk(space, &PoissonDiskParams { spacing, coverage: Some(beta * spacing), is_visible: false, seed });
    let spacing = PoissonDiskParams::for_about(space, n_points).spacing;
    if beta == 1.0 {
        return of(spacing);
    }
    // A looser set has fewer points: as many fewer at any size.
    let loose = of(spacing)?;
    of(spacing * (loose.n_points() as f64 / n_points as f64).sqrt())
}

/// Everything that is measured of some sets together.
pub struct Profile {
    pub measures: Vec<Measures>,
    pub radial: RadialSpectrum,
    pub power: PowerSpectrum,
}

impl Profile {
    pub fn of(sets: &[PointSet]) -> Result<Self, Error> {
        let measures = sets.iter().map(measure).collect::<Result<_, _>>()?;
        Ok(Self { measures, radial: radial_spectrum(sets)?, power: power_spectrum(sets, PowerSpectrum::MAX_FREQUENCY)? })
    }

    /// A figure of the sets it was made of.
    pub fn figure(&self, sets: &[PointSet], parts: &[Draw], most_points: usize) -> anyhow::Result<String> {
        let (radial, power) = (Some(&self.radial), Some(&self.power));
        let subject = Subject { sets, name: "", is_local: false, most_points: Some(most_points), radial, power };
        Ok(figure(&subject, parts, "")?)
    }
}
