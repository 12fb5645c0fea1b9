//! [`Watch`]: a job on threads, with a bar that shows how far it is, notes as they come, and the time that each stage takes.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::time::{Duration, Instant};

use evenly::{CancelToken, Phase, Progress};
use evenly_jobs::{Context, Error, Event, Stage};
use indicatif::{HumanDuration, ProgressBar, ProgressState, ProgressStyle};

use crate::interrupt;
use crate::talk::say;
use crate::wording::{Flags, told};

/// From this part of a run on the time left is shown.
const FORESEEN: f32 = 0.05;

pub struct Watch {
    bar: ProgressBar,
    clock: StageClock,
    cancel: CancelToken,
    is_quiet: bool,
    /// Notes that were told as they came.
    pub told: Vec<String>,
}

impl Watch {
    pub fn new(template: &str, cancel: &CancelToken, is_quiet: bool) -> Self {
        let bar = bar(is_quiet, 1000, template);
        Self { bar, clock: StageClock::default(), cancel: cancel.clone(), is_quiet, told: Vec::new() }
    }

    /// Does a job. Once a method has begun, a signal cancels it, and its state is kept; before, there is nothing to keep.
    pub fn run<T: Send>(
        &mut self,
        pool: &rayon::ThreadPool,
        job: impl FnOnce(&mut Context) -> Result<T, Error> + Send,
    ) -> anyhow::Result<T> {
        let cancel = self.cancel.clone();
        let done = pool.install(|| job(&mut Context::watched(|event| self.see(event)).with_cancel(cancel)));
        self.bar.finish_and_clear();
        self.clock.stop();
        done.map_err(told)
    }

    /// Wall time of each stage.
    pub fn seconds(&self) -> BTreeMap<&'static str, f64> {
        self.clock.seconds.clone()
    }

    fn see(&mut self, event: Event) {
        match event {
            Event::Stage(Stage::Optimize) => interrupt::cancels(&self.cancel, self.is_quiet),
            Event::Stage(stage) => {
                self.bar.set_message(name_of(stage));
                self.clock.enter(name_of(stage));
            }
            Event::Progress(progress) => {
                self.clock.enter(name_of_phase(progress.phase));
                show(&self.bar, progress);
            }
            Event::Note(note) => {
                let note = note.shown(&Flags);
                if !self.is_quiet {
                    self.bar.suspend(|| say(format_args!("note: {note}")));
                }
                self.told.push(note);
            }
            Event::Positions(_) => {}
            Event::Run { label, n_runs } => {
                self.bar.set_length(n_runs as u64);
                self.bar.set_message(label.to_owned());
                self.bar.inc(1);
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
        bar.set_style(style.with_key("left", time_left).progress_chars("=> "));
    }
    bar
}

/// The time left, once it is known a little.
fn time_left(state: &ProgressState, out: &mut dyn Write) {
    if state.fraction() >= FORESEEN {
        // A bar without it is a bar as well.
        let _ = write!(out, " {:#} left", HumanDuration(state.eta()));
    }
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

fn name_of(stage: Stage) -> &'static str {
    match stage {
        Stage::Read => "read",
        Stage::Start => "start",
        Stage::Warp => "warp",
        Stage::Optimize => "optimize",
        Stage::Measure => "measure",
    }
}

fn name_of_phase(phase: Phase) -> &'static str {
    match phase {
        Phase::Separate => "separate",
        Phase::Triangulate => "triangulate",
        Phase::Optimize => "optimize",
    }
}

/// Wall time by stage.
#[derive(Default)]
struct StageClock {
    seconds: BTreeMap<&'static str, f64>,
    current: Option<(&'static str, Instant)>,
}

impl StageClock {
    fn enter(&mut self, name: &'static str) {
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
