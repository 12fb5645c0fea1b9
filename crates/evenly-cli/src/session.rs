//! One run from the command line: threads, progress, Ctrl-C, the clock, and what is written at the end.

use std::collections::BTreeMap;
use std::time::Instant;

use anyhow::{Context as _, bail};
use evenly::{CancelToken, Measures, Outcome, Report, UnmetTarget};
use evenly_io::{Columns, Draw, Target, write_table};
use evenly_jobs::{Context, Ending, Error, Message, PointsMeasured, PointsOutcome};

use crate::args::RunArgs;
use crate::interrupt;
use crate::record::{self, Record};
use crate::talk::say;
use crate::watch::Watch;
use crate::wording::{Flags, told};

/// Done: all exit codes are numbers, so that other faces can read them.
pub const DONE: u8 = 0;
/// Done, but what was asked for was not reached.
pub const NOT_REACHED: u8 = 1;

pub struct Session<'a> {
    args: &'a RunArgs,
    seed: Option<u64>,
    output: Target,
    report: Option<Target>,
    draw: Vec<Draw>,
    pool: rayon::ThreadPool,
    cancel: CancelToken,
    seconds: BTreeMap<&'static str, f64>,
    notes: Vec<String>,
}

/// More threads than this for each core only get in each other's way.
const MOST_A_CORE: usize = 4;

/// Threads for rayon: as many as asked for, within reason, or as there are cores.
pub fn pool(threads: Option<u16>, is_quiet: bool) -> anyhow::Result<rayon::ThreadPool> {
    let most = MOST_A_CORE * std::thread::available_parallelism().map_or(1, usize::from);
    let n_threads = threads.map_or(0, usize::from).min(most);
    if threads.is_some_and(|threads| usize::from(threads) > n_threads) && !is_quiet {
        say(format_args!("note: {n_threads} threads are used, {MOST_A_CORE} for each core; the result does not depend on it"));
    }
    rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().context("no threads")
}

impl<'a> Session<'a> {
    /// Checks everything that can be checked before the work begins.
    pub fn new(args: &'a RunArgs, seed: Option<u64>) -> anyhow::Result<Self> {
        let output = Target::new(&args.output, args.format, args.force)?;
        if args.draw.is_some() && output.format().holds_points() {
            bail!("--draw needs a figure, .svg, .png or .pdf; {} is none", output.name());
        }
        if args.json && output.is_stdout() {
            bail!("--json and the points cannot both go to stdout; name a file with -o, or with --report");
        }
        let report = match &args.report {
            Some(path) => Some(Target::any(path, args.force)?),
            None => None,
        };
        if report.as_ref().is_some_and(|report| report.is_same(&output)) {
            bail!("{}: the points and the report cannot go to the same file", output.name());
        }
        let draw = args.draw.clone().unwrap_or_default();
        let cancel = CancelToken::default();
        Ok(Self {
            args,
            seed,
            output,
            report,
            draw: if draw.is_empty() { vec![Draw::Points] } else { draw },
            pool: pool(args.threads, args.quiet)?,
            cancel,
            seconds: BTreeMap::new(),
            notes: Vec::new(),
        })
    }

    /// Tells the user something, once, and the record.
    pub fn note(&mut self, note: &Message) {
        let note = note.shown(&Flags);
        if self.notes.contains(&note) {
            return;
        }
        if !self.args.quiet {
            say(format_args!("note: {note}"));
        }
        self.notes.push(note);
    }

    /// Does a job, and shows how far it is.
    pub fn run(&mut self, job: impl FnOnce(&mut Context) -> Result<PointsOutcome, Error> + Send) -> anyhow::Result<PointsOutcome> {
        let mut watch = Watch::new("{msg} [{bar:30}]{left}", &self.cancel, self.args.quiet);
        let outcome = watch.run(&self.pool, job)?;
        self.seconds.extend(watch.seconds());
        self.notes = watch.told;
        outcome.notes.iter().for_each(|note| self.note(note));
        Ok(outcome)
    }

    /// Measures the points, writes them, with other columns of their file, and the record, and says how it went.
    pub fn finish(mut self, outcome: &PointsOutcome, columns: Columns) -> anyhow::Result<u8> {
        let is_asked = !self.args.quiet || self.args.json || self.report.is_some() || outcome.has_targets();
        // Who interrupts does not wait for measures.
        let is_wanted = is_asked && !self.cancel.is_cancelled();
        let begin = Instant::now();
        let measured = is_wanted.then(|| self.pool.install(|| outcome.measured()));
        if is_wanted {
            *self.seconds.entry("measure").or_default() += begin.elapsed().as_secs_f64();
        }
        let measures = measured.as_ref().and_then(|measured| measured.measures.as_ref());
        let seed = self.seed.or(outcome.optimizer.as_ref().and_then(|optimizer| optimizer.seed()));
        let recipe = record::recipe(seed);
        let start = Instant::now();
        // Figures are drawn as distances count.
        let restored = self.output.format().holds_points().then(|| outcome.restored()).transpose().map_err(told)?;
        let written = restored.as_ref().unwrap_or(&outcome.points);
        self.pool.install(|| write_table(written, &columns, &self.draw, &recipe, &self.output))?;
        self.seconds.insert("write", start.elapsed().as_secs_f64());
        if !self.args.quiet {
            self.summarize(outcome, seed, measured.as_ref());
        }
        let is_forced = outcome.report.as_ref().is_some_and(|report| report.outcome == Outcome::Forced);
        let unmet = measured.as_ref().and_then(|measured| measured.unmet.clone());
        for UnmetTarget { name, wanted, measured } in unmet.iter().flatten() {
            let how = if is_forced { "forced" } else { "not reached" };
            self.note(&format!("{how}: {} is {measured:.6}, wanted {wanted}", name.replace('_', " ")).into());
        }
        let record = Record {
            version: record::VERSION,
            command: record::command(),
            method: outcome.method.name().into(),
            seed,
            space: outcome.space().clone(),
            metric: if outcome.is_restored() { "unit" } else { "input" },
            n_points: outcome.points.n_points(),
            parameters: outcome.optimizer.as_deref().map(record::parameters),
            run: outcome.report.clone(),
            seconds: self.seconds,
            angle_bounds_deg: measured.as_ref().and_then(PointsMeasured::certified_angles_deg),
            measures: measures.cloned(),
            lengths: measured.as_ref().and_then(|measured| measured.lengths),
            unmet,
            notes: self.notes,
        };
        let text = serde_json::to_string_pretty(&record)? + "\n";
        if let Some(report) = &self.report {
            report.write(text.as_bytes())?;
        }
        if self.args.json {
            Target::any("-".as_ref(), false)?.write(text.as_bytes())?;
        }
        let is_cancelled = self.cancel.is_cancelled();
        Ok(code(if is_cancelled { Ending::Cancelled } else { outcome.ending(measured.as_ref()) }))
    }

    fn summarize(&self, outcome: &PointsOutcome, seed: Option<u64>, measured: Option<&PointsMeasured>) {
        let (points, run) = (&outcome.points, outcome.report.as_ref());
        let measures: Option<&Measures> = measured.and_then(|measured| measured.measures.as_ref());
        let seconds: f64 = self.seconds.values().sum();
        let steps = if run.is_some_and(|run| run.visits > 0) { "passes" } else { "iterations" };
        let how = match run.map(|run| (run.outcome, run.iterations)) {
            Some((Outcome::Converged, n)) => format!(", converged in {n} {steps}"),
            Some((Outcome::IterationsDone, n)) => format!(", {n} {steps}"),
            Some((Outcome::IterationLimit | Outcome::LostToRounding, n)) => format!(", not converged in {n} {steps}"),
            Some((Outcome::Forced, n)) => format!(", at rest after {n} {steps}"),
            Some((Outcome::Cancelled, n)) => format!(", interrupted after {n} {steps}"),
            Some((Outcome::NothingToDo, _)) | None => String::new(),
        };
        let seed = seed.map_or_else(String::new, |seed| format!(", seed {seed}"));
        say(format_args!("{}: {} points{seed}{how}, {seconds:.2} s", self.output.name(), points.n_points()));
        if let Some(m) = measures {
            let angles = if m.angle_rms_deg.is_nan() {
                "no triangle".to_owned()
            } else {
                format!("angles {:.1} to {:.1} degrees (rms {:.2} from 60)", m.min_angle_deg, m.max_angle_deg, m.angle_rms_deg)
            };
            let (spacing, beta) = (m.hex_spacing, m.beta);
            let units = measured
                .and_then(|measured| measured.lengths)
                .map_or_else(String::new, |lengths| format!(" ({:.4e} and {:.4e} units)", lengths.min_distance, lengths.coverage_radius));
            say(format_args!(
                "in hexagonal spacings of {spacing:.4e}: min distance {:.3}, coverage radius {:.3}{units}, beta {beta:.3}; {angles}",
                m.min_distance, m.coverage_radius
            ));
        }
        if let Some([least, most]) = measured.and_then(PointsMeasured::certified_angles_deg).filter(|bounds| bounds[1] <= 90.0) {
            let (which, whose) = if points.space().is_periodic() { ("", "all") } else { (" with its circumcentre inside", "all their") };
            say(format_args!(
                "certificate: as beta is below 0.7071, no triangle{which} is obtuse; {whose} angles lie within {least:.2} and {most:.2} degrees"
            ));
        }
        if self.args.verbose {
            let phases: Vec<String> = self.seconds.iter().map(|(phase, s)| format!("{phase} {s:.3} s")).collect();
            say(phases.join(", "));
            if let Some(run) = run {
                say(work(run));
            }
        }
    }
}

/// What a run did.
fn work(run: &Report) -> String {
    if run.method == "procrustes" {
        return format!(
            "{} flips, {} moves undone, {} rises of the energy, {} inverted triangles",
            run.flips, run.moves_undone, run.energy_rises, run.inverted_triangles
        );
    }
    let visits = run.visits as f64 / run.n_points as f64;
    format!("{visits:.1} visits a point, {} flips, {} triangulations", run.flips, run.triangulations)
}

/// The exit code of a job.
pub fn code(ending: Ending) -> u8 {
    match ending {
        Ending::Done => DONE,
        Ending::Missed => NOT_REACHED,
        Ending::Cancelled => interrupt::code(),
    }
}

/// That no two outputs go to the same file.
pub fn require_distinct(targets: &[Option<&Target>]) -> anyhow::Result<()> {
    let all: Vec<&Target> = targets.iter().flatten().copied().collect();
    match all.iter().enumerate().find(|&(k, target)| all[..k].iter().any(|before| before.is_same(target))) {
        Some((_, target)) => bail!("{}: two outputs cannot go to the same file", target.name()),
        None => Ok(()),
    }
}
