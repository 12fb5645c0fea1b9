//! `evenly compare`: several methods on the same points.

use std::time::Instant;

use anyhow::bail;
use clap::ArgMatches;
use evenly::{CancelToken, Density, Outcome, PointSet, PoissonDiskParams, RunContext, Space, measure, poisson_disk};
use evenly_io::{Draw, Subject, Target, figure};

use crate::args::Compare;
use crate::comparison::{Column, Comparison, Run};
use crate::method::{Method, refuse_others_flags};
use crate::method_args::start as begin;
use crate::table::Kind;
use crate::talk::say;
use crate::{input, interrupt, memory, record, session};

/// Points in a method's picture.
const SHOWN: usize = 600;

pub fn run(args: &Compare, flags: &ArgMatches) -> anyhow::Result<u8> {
    let space = args.space.space()?;
    let methods = if args.methods.is_empty() { Method::all_in(&space) } else { args.methods.clone() };
    refuse_others_flags(&methods, flags)?;
    let output = match &args.output {
        Some(path) => Some((Kind::of_path(path)?, Target::any(path, args.run.force)?)),
        None => None,
    };
    let given = match &args.input {
        Some(path) => Some(input::read(path, &space)?),
        None => None,
    };
    if let Some((_, Some(note))) = &given {
        say(format_args!("note: {note}"));
    }
    let given = given.map(|(points, _)| args.metric.applied(points)).transpose()?;
    let space = if args.metric.is_unit() { space.in_unit_square() } else { space };
    let n_points = match (&given, args.n_points) {
        (Some(points), _) => points.n_points(),
        (None, Some(n)) => n,
        (None, None) => bail!("--n-points is missing: how many?"),
    };
    if n_points < 3 {
        bail!("{n_points} points: to compare methods takes 3 or more");
    }

    // What is wrong with a parameter is said before the work begins.
    for &method in &methods {
        args.optimizer.optimizer(method, args.seed)?;
        memory::require_points(n_points, method)?;
    }
    let start = args.start.unwrap_or(Method::Procrustes.default_start(&space, false));
    let cancel = CancelToken::default();
    interrupt::cancels(&cancel, args.run.quiet);
    let runner = Runner { args, space, n_points, start, given, cancel };
    let pool = session::pool(args.run.threads, args.run.quiet)?;
    let is_drawn = matches!(output, Some((Kind::Html, _)));
    let comparison = pool.install(|| runner.compare(&methods, is_drawn))?;
    if comparison.columns.is_empty() && runner.cancel.is_cancelled() {
        return Ok(interrupt::code());
    }
    if comparison.columns.is_empty() {
        bail!("no run was done, so there is nothing to compare");
    }
    let text = |kind: Kind| kind.write(&comparison);
    match &output {
        Some((kind, target)) => target.write(text(*kind)?.as_bytes())?,
        None => Target::any("-".as_ref(), false)?.write(text(Kind::Text)?.as_bytes())?,
    }
    Ok(if runner.cancel.is_cancelled() { interrupt::code() } else { session::DONE })
}

struct Runner<'a> {
    args: &'a Compare,
    space: Space,
    n_points: usize,
    /// What optimisers begin with, unless points are given.
    start: Method,
    given: Option<PointSet>,
    cancel: CancelToken,
}

impl Runner<'_> {
    fn compare(&self, methods: &[Method], is_drawn: bool) -> anyhow::Result<Comparison> {
        let n_runs = methods.len() as u64 * u64::from(self.args.runs);
        let bar = session::bar(self.args.run.quiet, n_runs, "{msg} [{bar:30}] {pos} of {len} runs");
        let mut columns = Vec::new();
        for &method in methods.iter().take_while(|_| !self.cancel.is_cancelled()) {
            let mut column = Column { method: method.name(), runs: Vec::new(), picture: None };
            for index in 0..self.args.runs {
                bar.set_message(method.name());
                let seed = self.args.seed.wrapping_add(index.into());
                let Some((run, points)) = self.run(method, seed)? else { continue };
                if is_drawn && index == 0 {
                    let subject = Subject { most_points: Some(SHOWN), ..(&points).into() };
                    column.picture = figure(&subject, &[Draw::Points], &record::recipe(Some(seed))).ok();
                }
                column.runs.push(run);
                bar.inc(1);
            }
            if !column.runs.is_empty() {
                columns.push(column);
            }
        }
        bar.finish_and_clear();
        let start = if self.given.is_some() { None } else { Some(self.start.name()) };
        Ok(Comparison {
            version: record::VERSION,
            command: record::command(),
            space: self.space.clone(),
            n_points: self.n_points,
            is_interrupted: self.cancel.is_cancelled(),
            start,
            columns,
        })
    }

    /// One run of a method; `None` if it was interrupted, or has made what cannot be measured.
    fn run(&self, method: Method, seed: u64) -> anyhow::Result<Option<(Run, PointSet)>> {
        if self.cancel.is_cancelled() {
            return Ok(None);
        }
        let optimizer = self.args.optimizer.optimizer(method, seed)?;
        let mut points = match (&optimizer, &self.given) {
            (Some(_), Some(given)) => given.clone(),
            (Some(_), None) => begin(self.start, &self.space, &Density::uniform(), self.n_points, seed)?,
            (None, _) => PointSet::new(&self.space, Vec::new())?,
        };
        let clock = Instant::now();
        let mut report = None;
        match &optimizer {
            Some(optimizer) => {
                // Of the starts, only white noise has long density waves.
                let is_warped = !self.args.optimizer.no_warp && (self.given.is_some() || self.start == Method::White);
                if let Some(warp) = optimizer.warp().filter(|_| is_warped) {
                    warp(&mut points);
                }
                report = Some(optimizer.run(&mut points, &mut RunContext::default().with_cancel(self.cancel.clone()))?);
            }
            // As an outcome its number is chance; as a start it would not be maximal.
            None if method == Method::PoissonDisk => {
                let params = PoissonDiskParams { seed, ..PoissonDiskParams::for_about(&self.space, self.n_points) };
                points = poisson_disk(&self.space, &params)?;
            }
            None => points = begin(method, &self.space, &Density::uniform(), self.n_points, seed)?,
        }
        let seconds = clock.elapsed().as_secs_f64();
        if report.as_ref().is_some_and(|report| report.outcome == Outcome::Cancelled) {
            return Ok(None);
        }
        // What cannot be measured is said, and the others go on.
        let measures = match measure(&points) {
            Ok(measures) => measures,
            Err(error) => {
                say(format_args!("note: {}, seed {seed}: {error}", method.name()));
                return Ok(None);
            }
        };
        let targets = optimizer.as_ref().and_then(|optimizer| optimizer.targets());
        let is_reached = targets.map(|targets| targets.unmet(&measures).is_empty());
        let iterations = report.map(|report| report.iterations);
        Ok(Some((Run { seed, seconds, iterations, is_reached, measures }, points)))
    }
}
