//! [`Wishes`]: what is asked for of points by another face than the command line, in its words: so the same wish is the same points, to the bit, and wrong ones are the same errors.

use anyhow::{Context as _, bail};
use clap::{CommandFactory as _, FromArgMatches as _, Parser};
use evenly::{Method, Optimizer, Outcome, PointSet, Report, RunContext, measure};

use crate::args::WarpArg;
use crate::improve::{KEPT, is_nearer, notes, warp_for};
use crate::input;
use crate::method::{Any, MethodArgs, Starts, by_flag, parser, refuse_beginning, refuse_density, require_density};

/// A method, and what it is told.
pub struct Wishes {
    flags: Flags,
    optimizer: Option<Box<dyn Optimizer>>,
}

#[derive(Parser)]
#[command(no_binary_name = true, disable_help_flag = true)]
struct Flags {
    #[arg(long, default_value_t = Method::default(), value_parser = parser::<Any>())]
    method: Method,
    #[arg(long, value_parser = parser::<Starts>())]
    start: Option<Method>,
    #[arg(long, default_value_t = 0)]
    seed: u64,
    #[command(flatten)]
    warp: WarpArg,
    #[command(flatten)]
    method_args: MethodArgs<Any>,
}

/// Points, and how they came about.
pub struct Made {
    /// The points.
    pub points: PointSet,
    /// What the optimiser did; `None` of a method that is none.
    pub report: Option<Report>,
    /// What the user should know.
    pub notes: Vec<String>,
    /// For each target that was missed, in a sentence.
    pub unmet: Vec<String>,
}

impl Made {
    /// The points of the unit square of another set's domain, restored to that domain.
    ///
    /// # Errors
    /// As [`PointSet::restored_to`].
    pub fn restored_to(self, given: &PointSet) -> anyhow::Result<Self> {
        Ok(Self { points: self.points.restored_to(given)?, ..self })
    }
}

impl Wishes {
    /// Reads flags, as `--method=lloyd`.
    ///
    /// # Errors
    /// What the command line says of them.
    pub fn parse(words: &[String]) -> anyhow::Result<Self> {
        let matches = Flags::command().try_get_matches_from(words);
        let flags = matches.and_then(|matches| Flags::from_arg_matches(&matches)).map_err(|error| crate::usage::plain(&error))?;
        flags.method_args.refuse_others(&[flags.method])?;
        refuse_beginning(flags.method, flags.start.is_some(), flags.warp.no_warp)?;
        let optimizer = flags.method.optimizer(&flags.method_args.of(flags.method), flags.seed).map_err(by_flag)?;
        Ok(Self { flags, optimizer })
    }

    /// Makes points in the space, and by the density, of those that stay.
    ///
    /// # Errors
    /// As `evenly generate`.
    pub fn generate(&self, fixed: &PointSet, n_points: Option<usize>, run: &mut RunContext) -> anyhow::Result<Made> {
        let Flags { method, start, seed, warp, method_args } = &self.flags;
        let has_density = !fixed.density().is_uniform();
        if has_density {
            refuse_density(*method)?;
        }
        match &self.optimizer {
            Some(optimizer) => {
                let begin = start.unwrap_or(method.default_start(fixed.space(), has_density));
                if has_density {
                    require_density(begin)?;
                }
                let n_points = n_points.context("n is missing: how many points?")?;
                let points = begin.start(fixed, n_points, *seed).map_err(by_flag)?;
                // Only white noise has long density waves.
                improved(points, &**optimizer, begin.has_long_waves() && !warp.no_warp, run)
            }
            None => {
                let (points, note) = method.make(&method_args.of(*method), fixed, n_points, *seed).map_err(by_flag)?;
                Ok(Made { points, report: None, notes: note.into_iter().collect(), unmet: Vec::new() })
            }
        }
    }

    /// Makes better points of points, those that stay first.
    ///
    /// # Errors
    /// As `evenly optimize`.
    pub fn optimize(&self, fixed: &PointSet, points: PointSet, run: &mut RunContext) -> anyhow::Result<Made> {
        if !fixed.density().is_uniform() {
            refuse_density(self.flags.method)?;
        }
        let points = input::joined(fixed, points)?.with_density(fixed.density());
        match &self.optimizer {
            Some(optimizer) => improved(points, &**optimizer, !self.flags.warp.no_warp, run),
            None => bail!("{} makes points, and improves none", self.flags.method),
        }
    }
}

fn improved(mut points: PointSet, optimizer: &dyn Optimizer, is_warped: bool, run: &mut RunContext) -> anyhow::Result<Made> {
    let warp = warp_for(&points, optimizer, is_warped);
    let start = (warp.is_some() && optimizer.targets().is_some()).then(|| points.clone());
    if let Some(warp) = warp {
        warp(&mut points);
    }
    let advice = optimizer.targets().and_then(|targets| targets.advice(&points));
    let report = optimizer.run(&mut points, run)?;
    let mut notes: Vec<String> = advice.into_iter().chain(notes(&report)).collect();
    if report.outcome == Outcome::Cancelled {
        // Whoever has interrupted wants the state reached, and soon.
        return Ok(Made { points, report: Some(report), notes, unmet: Vec::new() });
    }
    if let Some(start) = start
        && is_nearer(&start, &points, &report, optimizer)
    {
        notes.push(KEPT.into());
        points = start;
    }
    let measures = optimizer.targets().and_then(|targets| Some((targets, measure(&points).ok()?)));
    let unmet = measures.map_or_else(Vec::new, |(targets, measures)| targets.unmet(&measures));
    let unmet = unmet.iter().map(|target| format!("{} is {:.6}, wanted {}", target.name, target.measured, target.wanted));
    Ok(Made { points, report: Some(report), notes, unmet: unmet.collect() })
}
