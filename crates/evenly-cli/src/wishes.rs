//! [`Wishes`]: what is asked for of points by another face than the command line, in its words: so the same wish is the same points, to the bit, and wrong ones are the same errors.

use anyhow::{Context as _, bail};
use clap::{ArgMatches, FromArgMatches as _, Parser};
use evenly::{Outcome, PointSet, Report, RunContext, measure, warp};

use crate::improve::{KEPT, is_nearer, notes, warp_for};
use crate::input;
use crate::method::{Method, parser, refuse_others_flags};
use crate::method_args::{OptimizerArgs, StartArgs, start_around};
use crate::optimizer::Optimizer;

/// A method, and what it is told.
pub struct Wishes {
    flags: Flags,
    optimizer: Option<Box<dyn Optimizer>>,
}

#[derive(Parser)]
#[command(no_binary_name = true, disable_help_flag = true)]
struct Flags {
    #[arg(long, default_value = "procrustes", value_parser = parser(|_| true))]
    method: Method,
    #[arg(long, value_parser = parser(Method::is_start))]
    start: Option<Method>,
    #[arg(long, default_value_t = 0)]
    seed: u64,
    #[command(flatten)]
    optimizer: OptimizerArgs,
    #[command(flatten)]
    starts: StartArgs,
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
        let read = || -> Result<(Flags, ArgMatches), clap::Error> {
            let matches = <Flags as clap::CommandFactory>::command().try_get_matches_from(words)?;
            Ok((Flags::from_arg_matches(&matches)?, matches))
        };
        let (flags, matches) = read().map_err(|error| crate::plain(&error))?;
        refuse_others_flags(&[flags.method], &matches)?;
        let optimizer = flags.optimizer.optimizer(flags.method, flags.seed)?;
        Ok(Self { flags, optimizer })
    }

    /// Makes points in the space, and by the density, of those that stay.
    ///
    /// # Errors
    /// As `evenly generate`.
    pub fn generate(&self, fixed: &PointSet, n_points: Option<usize>, run: &mut RunContext) -> anyhow::Result<Made> {
        let Flags { method, start, seed, optimizer: flags, starts } = &self.flags;
        let has_density = !fixed.density().is_uniform();
        if has_density {
            method.refuse_density()?;
        }
        match &self.optimizer {
            Some(optimizer) => {
                let begin = start.unwrap_or(method.default_start(fixed.space(), has_density));
                if has_density {
                    begin.require_density()?;
                }
                let n_points = n_points.context("n is missing: how many points?")?;
                let points = start_around(fixed, begin, n_points, *seed)?;
                // Only white noise has long density waves.
                improved(points, &**optimizer, begin == Method::White && !flags.no_warp, run)
            }
            None if *method == Method::Warp => bail!("warp makes no points of its own; it is a method of optimize"),
            None => {
                let (points, note) = starts.make(*method, fixed, n_points, *seed)?;
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
            self.flags.method.refuse_density()?;
        }
        let mut points = input::joined(fixed, points)?.with_density(fixed.density());
        match &self.optimizer {
            Some(optimizer) => improved(points, &**optimizer, !self.flags.optimizer.no_warp, run),
            None if self.flags.method == Method::Warp => {
                warp(&mut points);
                Ok(Made { points, report: None, notes: Vec::new(), unmet: Vec::new() })
            }
            None => bail!("{} makes points, and improves none", self.flags.method.name()),
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
