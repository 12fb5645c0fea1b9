//! One run from the command line: threads, progress, Ctrl-C, the clock, and what is written at the end.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use anyhow::{Context as _, bail};
use evenly::{CancelToken, Measures, Method, Optimizer, Outcome, Phase, PointSet, Progress, Report, RunContext, UnmetTarget, measure};
use evenly_io::{Columns, Draw, Target, write_table};
use indicatif::{ProgressBar, ProgressStyle};

use crate::args::RunArgs;
use crate::improve::{KEPT, is_nearer, notes, warp_for};
use crate::interrupt;
use crate::record::{self, Record};
use crate::talk::say;

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
    optimizer: Option<Box<dyn Optimizer>>,
    /// What the points of the unit square are restored to before they are written.
    pub restores_to: Option<PointSet>,
    /// Other columns of the file that the points come from.
    pub columns: Columns,
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
        let draw = args.draw.iter().flatten().map(|&layer| layer.into()).collect::<Vec<Draw>>();
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
            optimizer: None,
            restores_to: None,
            columns: Columns::default(),
        })
    }

    /// Tells the user something, once, and the record.
    pub fn note(&mut self, note: String) {
        if self.notes.contains(&note) {
            return;
        }
        if !self.args.quiet {
            say(format_args!("note: {note}"));
        }
        self.notes.push(note);
    }

    /// Runs a phase on the session's threads, and takes its time.
    pub fn time<T: Send>(&mut self, phase: &'static str, work: impl FnOnce() -> T + Send) -> T {
        let start = Instant::now();
        let done = self.pool.install(work);
        *self.seconds.entry(phase).or_default() += start.elapsed().as_secs_f64();
        done
    }

    /// Optimises points, and finishes.
    pub fn optimize(mut self, mut points: PointSet, optimizer: Box<dyn Optimizer>, is_warped: bool) -> anyhow::Result<u8> {
        self.seed = self.seed.or(optimizer.seed());
        let warp = warp_for(&points, &*optimizer, is_warped);
        let start = (warp.is_some() && optimizer.targets().is_some()).then(|| points.clone());
        if let Some(warp) = warp {
            self.time("warp", || warp(&mut points));
        }
        if let Some(advice) = optimizer.targets().and_then(|targets| targets.advice(&points)) {
            self.note(advice);
        }
        interrupt::cancels(&self.cancel, self.args.quiet);
        let bar = bar(self.args.quiet, 1000, "{msg} [{bar:30}] {eta} left");
        let mut clock = PhaseClock::default();
        let cancel = self.cancel.clone();
        let done = self.pool.install(|| {
            let on_progress = |progress: Progress| {
                clock.enter(progress.phase);
                show(&bar, progress);
            };
            optimizer.run(&mut points, &mut RunContext::default().on_progress(on_progress).with_cancel(cancel))
        });
        bar.finish_and_clear();
        let report = done?;
        clock.stop();
        self.seconds.extend(clock.seconds);
        for note in notes(&report) {
            self.note(note);
        }
        if let Some(start) = start
            && !self.cancel.is_cancelled()
            && self.time("measure", || is_nearer(&start, &points, &report, &*optimizer))
        {
            self.note(KEPT.into());
            points = start;
        }
        let method = optimizer.method();
        self.optimizer = Some(optimizer);
        self.finish(points, method, Some(report))
    }

    /// Measures the points, writes them and the record, and says how it went.
    pub fn finish(mut self, points: PointSet, method: Method, run: Option<Report>) -> anyhow::Result<u8> {
        let has_targets = self.optimizer.as_ref().is_some_and(|optimizer| optimizer.targets().is_some());
        // Who interrupts does not wait for measures.
        let is_wanted = (!self.args.quiet || self.args.json || self.report.is_some() || has_targets) && !self.cancel.is_cancelled();
        let measures = if is_wanted { self.time("measure", || measure(&points)).ok() } else { None };
        let targets = self.optimizer.as_ref().and_then(|optimizer| optimizer.targets());
        let unmet = targets.zip(measures.as_ref()).map(|(targets, measures)| targets.unmet(measures));
        let recipe = record::recipe(self.seed);
        let start = Instant::now();
        let restored = self.restores_to.as_ref().filter(|_| self.output.format().holds_points());
        let restored = restored.map(|given| points.restored_to(given)).transpose()?;
        let written = restored.as_ref().unwrap_or(&points);
        self.pool.install(|| write_table(written, &self.columns, &self.draw, &recipe, &self.output))?;
        self.seconds.insert("write", start.elapsed().as_secs_f64());
        if !self.args.quiet {
            self.summarize(&points, run.as_ref(), measures.as_ref());
        }
        let outcome = run.as_ref().map(|run| run.outcome);
        let is_unproved = unmet.is_none();
        let is_forced = outcome == Some(Outcome::Forced);
        let has_missed = !is_forced && unmet.as_ref().is_some_and(|unmet| !unmet.is_empty());
        for UnmetTarget { name, wanted, measured } in unmet.iter().flatten() {
            let how = if is_forced { "forced" } else { "not reached" };
            self.note(format!("{how}: {} is {measured:.6}, wanted {wanted}", name.replace('_', " ")));
        }
        let record = Record {
            version: record::VERSION,
            command: record::command(),
            method: method.name().into(),
            seed: self.seed,
            space: self.restores_to.as_ref().unwrap_or(&points).space().clone(),
            metric: if self.restores_to.is_some() { "unit" } else { "input" },
            n_points: points.n_points(),
            parameters: self.optimizer.as_deref().map(record::parameters),
            run,
            seconds: self.seconds,
            angle_bounds_deg: measures.as_ref().and_then(record::certified_angles),
            measures,
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
        Ok(match outcome {
            _ if self.cancel.is_cancelled() => interrupt::code(),
            _ if has_missed => NOT_REACHED,
            Some(Outcome::IterationLimit | Outcome::LostToRounding) if is_unproved => NOT_REACHED,
            _ => DONE,
        })
    }

    fn summarize(&self, points: &PointSet, run: Option<&Report>, measures: Option<&Measures>) {
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
        let seed = self.seed.map_or_else(String::new, |seed| format!(", seed {seed}"));
        say(format_args!("{}: {} points{seed}{how}, {seconds:.2} s", self.output.name(), points.n_points()));
        if let Some(m) = measures {
            let angles = if m.angle_rms_deg.is_nan() {
                "no triangle".to_owned()
            } else {
                format!("angles {:.1} to {:.1} degrees (rms {:.2} from 60)", m.min_angle_deg, m.max_angle_deg, m.angle_rms_deg)
            };
            let (spacing, beta) = (m.hex_spacing, m.beta);
            say(format_args!(
                "in hexagonal spacings of {spacing:.4e}: min distance {:.3}, coverage radius {:.3}, beta {beta:.3}; {angles}",
                m.min_distance, m.coverage_radius
            ));
        }
        if let Some([least, most]) = measures.and_then(record::certified_angles).filter(|bounds| bounds[1] <= 90.0) {
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

/// A bar on stderr where that is a terminal, and nothing where it is not.
pub fn bar(is_quiet: bool, length: u64, template: &str) -> ProgressBar {
    if is_quiet {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(length);
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style.progress_chars("=> "));
    }
    bar
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

/// A run's context: the bar shows how far it is; once an optimiser has begun, a signal cancels the run, whose state
/// is kept. Before, there is nothing to keep.
pub fn context<'a>(bar: &'a ProgressBar, cancel: &'a CancelToken, is_quiet: bool) -> RunContext<'a> {
    RunContext::default().with_cancel(cancel.clone()).on_progress(move |progress| {
        if progress.phase == Phase::Optimize {
            interrupt::cancels(cancel, is_quiet);
        }
        show(bar, progress);
    })
}

/// Shows how far a run has come.
fn show(bar: &ProgressBar, progress: Progress) {
    let energy = progress.energy.map_or_else(String::new, |energy| format!(", energy {energy:.5}"));
    bar.set_message(match (progress.phase, progress.stable_share) {
        (Phase::Separate | Phase::Triangulate, _) => "triangulating".to_owned(),
        (Phase::Optimize, Some(share)) => format!("pass {}, {:.2} % at rest", progress.iteration, 100.0 * share),
        (Phase::Optimize, None) => format!("iteration {}{energy}", progress.iteration),
    });
    bar.set_position((1000.0 * progress.fraction) as u64);
}

/// Wall time by phase.
#[derive(Default)]
struct PhaseClock {
    seconds: BTreeMap<&'static str, f64>,
    current: Option<(&'static str, Instant)>,
}

impl PhaseClock {
    fn enter(&mut self, phase: Phase) {
        let name = match phase {
            Phase::Separate => "separate",
            Phase::Triangulate => "triangulate",
            Phase::Optimize => "optimize",
        };
        if self.current.is_none_or(|(current, _)| current != name) {
            self.stop();
            self.current = Some((name, Instant::now()));
        }
    }

    fn stop(&mut self) {
        if let Some((name, start)) = self.current.take() {
            *self.seconds.entry(name).or_default() += Duration::as_secs_f64(&start.elapsed());
        }
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
