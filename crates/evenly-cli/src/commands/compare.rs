//! `evenly compare`: several methods on the same points.

use std::time::Instant;

use anyhow::bail;
use evenly::{CancelToken, Density, Method, Outcome, PointSet, RunContext, Settings, Space, measure};
use evenly_io::{Draw, Subject, Target, figure};

use crate::args::Compare;
use crate::comparison::{Column, Comparison, Run};
use crate::improve::warp_for;
use crate::method::{Told, all_in, by_flag, refuse_density, require_density};
use crate::table::Kind;
use crate::talk::say;
use crate::{input, interrupt, memory, record, session};

/// Points in a method's picture.
const SHOWN: usize = 600;

pub fn run(args: &Compare) -> anyhow::Result<u8> {
    let space = args.space.space()?;
    let density = args.density.density()?;
    let has_density = args.density.is_given();
    let named: Vec<Told> = args.methods.iter().map(|&method| method.into()).chain(args.told.iter().cloned()).collect();
    let compared = if named.is_empty() { all_in(&space, has_density).into_iter().map(Told::from).collect() } else { named };
    let methods: Vec<Method> = compared.iter().map(|told| told.method).collect();
    args.optimizer.refuse_others(&methods)?;
    if has_density {
        methods.iter().try_for_each(|&method| refuse_density(method))?;
    }
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
    let given = given.map(|(points, _)| args.metric.applied(points.with_density(&density))).transpose()?;
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
    for told in &compared {
        told.method.optimizer(&told.with(args), args.seed).map_err(by_flag)?;
        memory::require_points(n_points, told.method)?;
    }
    let start = args.start.unwrap_or(Method::default().default_start(&space, has_density));
    if has_density {
        require_density(start)?;
    }
    let cancel = CancelToken::default();
    interrupt::cancels(&cancel, args.run.quiet);
    let runner = Runner { args, space, density, n_points, start, given, cancel };
    let pool = session::pool(args.run.threads, args.run.quiet)?;
    let is_drawn = matches!(output, Some((Kind::Html, _)));
    let comparison = pool.install(|| runner.compare(&compared, is_drawn))?;
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

impl Told {
    /// What it is told by itself, and of what all are told the rest.
    fn with(&self, args: &Compare) -> Settings {
        args.optimizer.of(self.method).overlaid(&self.settings)
    }
}

struct Runner<'a> {
    args: &'a Compare,
    space: Space,
    density: Density,
    n_points: usize,
    /// What optimisers begin with, unless points are given.
    start: Method,
    given: Option<PointSet>,
    cancel: CancelToken,
}

impl Runner<'_> {
    fn compare(&self, methods: &[Told], is_drawn: bool) -> anyhow::Result<Comparison> {
        let n_runs = methods.len() as u64 * u64::from(self.args.runs);
        let bar = session::bar(self.args.run.quiet, n_runs, "{msg} [{bar:30}] {pos} of {len} runs");
        let mut columns = Vec::new();
        for told in methods.iter().take_while(|_| !self.cancel.is_cancelled()) {
            let mut column = Column { method: told.label.clone(), runs: Vec::new(), picture: None };
            for index in 0..self.args.runs {
                bar.set_message(told.label.clone());
                let seed = self.args.seed.wrapping_add(index.into());
                let Some((run, points)) = self.run(told, seed)? else { continue };
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
        let start = if self.given.is_some() { None } else { Some(self.start.name().into()) };
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
    fn run(&self, told: &Told, seed: u64) -> anyhow::Result<Option<(Run, PointSet)>> {
        if self.cancel.is_cancelled() {
            return Ok(None);
        }
        let Told { method, settings, .. } = &Told { settings: told.with(self.args), ..told.clone() };
        let optimizer = method.optimizer(settings, seed).map_err(by_flag)?;
        let mut points = match (&optimizer, &self.given) {
            (Some(_), Some(given)) => given.clone(),
            (Some(_), None) => self.start.start_in(&self.space, &self.density, self.n_points, seed)?,
            (None, _) => PointSet::new(&self.space, Vec::new())?.with_density(&self.density),
        };
        let clock = Instant::now();
        let mut report = None;
        match &optimizer {
            Some(optimizer) => {
                // Of the starts, only white noise has long density waves.
                let is_warped = !self.args.warp.no_warp && (self.given.is_some() || self.start.has_long_waves());
                if let Some(warp) = warp_for(&points, &**optimizer, is_warped) {
                    warp(&mut points);
                }
                report = Some(optimizer.run(&mut points, &mut RunContext::default().with_cancel(self.cancel.clone()))?);
            }
            // As they are, not as a start: a maximal set's number of points is chance.
            None => points = method.make(settings, &points, Some(self.n_points), seed)?.0,
        }
        let seconds = clock.elapsed().as_secs_f64();
        if report.as_ref().is_some_and(|report| report.outcome == Outcome::Cancelled) {
            return Ok(None);
        }
        // What cannot be measured is said, and the others go on.
        let measures = match measure(&points) {
            Ok(measures) => measures,
            Err(error) => {
                say(format_args!("note: {}, seed {seed}: {error}", told.label));
                return Ok(None);
            }
        };
        let targets = optimizer.as_ref().and_then(|optimizer| optimizer.targets());
        let is_reached = targets.map(|targets| targets.unmet(&measures).is_empty());
        let iterations = report.map(|report| report.iterations);
        Ok(Some((Run { seed, seconds, iterations, is_reached, measures }, points)))
    }
}
