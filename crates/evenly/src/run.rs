//! One run of a method: progress and cancel on the way in, a [`Report`] on the way out.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use serde::Serialize;

/// What a run is doing at the moment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Phase {
    /// Coincident and collinear points are moved apart.
    Separate,
    /// The Delaunay triangulation is built.
    Triangulate,
    /// Points are being moved.
    Optimize,
}

/// A sign of life, sent at the start of each phase and after each iteration.
#[derive(Debug, Clone, Copy)]
pub struct Progress {
    /// What is going on.
    pub phase: Phase,
    /// Iterations done so far; of a method that sweeps, passes.
    pub iteration: usize,
    /// The energy after the last iteration; `None` before the first, and of methods without one.
    pub energy: Option<f64>,
    /// The share of points at which the last pass found nothing to do; `None` before the first, and of methods that do not sweep.
    pub stable_share: Option<f64>,
    /// How far the run has come, 0 to 1, estimated; never falls.
    pub fraction: f64,
}

/// A flag that another thread may raise to end a run early; the run then returns the state reached.
#[derive(Debug, Clone, Default)]
pub struct CancelToken(Arc<AtomicBool>);

impl CancelToken {
    /// Asks the run to stop after the iteration at hand.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether somebody has asked.
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// What is called with a warning.
type Warn<'a> = Box<dyn FnMut(&str) + 'a>;
/// What is called with positions.
type Show<'a> = Box<dyn FnMut(Vec<[f64; 2]>) + 'a>;

/// Progress and cancel for one run. `RunContext::default()` is silent and cannot be cancelled.
///
/// Threads are rayon's: run inside `ThreadPool::install` to choose how many. The result does not depend on it.
#[derive(Default)]
pub struct RunContext<'a> {
    progress: Option<Box<dyn FnMut(Progress) + 'a>>,
    warning: Option<Warn<'a>>,
    positions: Option<Show<'a>>,
    cancel: CancelToken,
}

impl<'a> RunContext<'a> {
    /// Calls `progress` at each phase and iteration.
    #[must_use]
    pub fn on_progress(mut self, progress: impl FnMut(Progress) + 'a) -> Self {
        self.progress = Some(Box::new(progress));
        self
    }

    /// Calls `warning` with what should be known before the run has ended; the report's notes have it too.
    #[must_use]
    pub fn on_warning(mut self, warning: impl FnMut(&str) + 'a) -> Self {
        self.warning = Some(Box::new(warning));
        self
    }

    /// Calls `positions` with where the points are after each iteration, in input units and in their order, before its progress is told: of methods on points in the plane.
    #[must_use]
    pub fn on_positions(mut self, positions: impl FnMut(Vec<[f64; 2]>) + 'a) -> Self {
        self.positions = Some(Box::new(positions));
        self
    }

    /// Stops when `cancel` is raised.
    #[must_use]
    pub fn with_cancel(mut self, cancel: CancelToken) -> Self {
        self.cancel = cancel;
        self
    }

    pub(crate) fn report(&mut self, progress: Progress) {
        if let Some(call) = &mut self.progress {
            call(progress);
        }
    }

    /// Shows where points are, if anybody looks.
    pub(crate) fn show(&mut self, positions: impl FnOnce() -> Vec<[f64; 2]>) {
        if let Some(call) = &mut self.positions {
            call(positions());
        }
    }

    /// Says at once, and in the report, what should be known.
    pub(crate) fn warn(&mut self, warning: String, report: &mut Report) {
        if let Some(call) = &mut self.warning {
            call(&warning);
        }
        report.notes.push(warning);
    }

    pub(crate) fn enter(&mut self, phase: Phase) {
        self.report(Progress { phase, iteration: 0, energy: None, stable_share: None, fraction: 0.0 });
    }

    /// Whether somebody has asked the run to stop.
    pub fn is_cancelled(&self) -> bool {
        self.cancel.is_cancelled()
    }

    /// For a part of a run that shows no progress of its own; cancelled as this one is.
    pub(crate) fn silent(&self) -> RunContext<'static> {
        RunContext::default().with_cancel(self.cancel.clone())
    }
}

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// The stop criterion was met.
    Converged,
    /// As many iterations or passes were made as were asked for.
    IterationsDone,
    /// The limit of iterations or passes came first; the best state reached is kept.
    IterationLimit,
    /// At rest. Boundaries, fixed points or gaps in a density keep some targets from being met: the notes say where.
    Forced,
    /// The stop criterion was met, but not any more after rounding to input units: the domain is too far from 0.
    LostToRounding,
    /// The run was cancelled; the state reached is kept, or the best, of methods that keep that.
    Cancelled,
    /// Fewer than three points: nothing to optimise.
    NothingToDo,
}

/// What a method did, whatever the method.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// The method's name, as on the command line.
    pub method: &'static str,
    /// Number of points; the same before and after.
    pub n_points: usize,
    /// How the run ended.
    pub outcome: Outcome,
    /// Iterations done; of a method that sweeps, passes.
    pub iterations: usize,
    /// Of a method that sweeps: how often a point was visited.
    pub visits: usize,
    /// Of a method that sweeps: for each pass the share of points at which it found nothing to do.
    pub stable_share: Vec<f64>,
    /// What the method brings down, before the first iteration and after each: of Procrustes its energy, as a fraction of the domain's area, of cvt the energy
    /// relative to the hexagonal lattice's, of opt-beta beta; of other methods nothing.
    pub energy: Vec<f64>,
    /// Of Procrustes: how often its energy rose from one iteration to the next, by more than rounding; steps in which a rectangle's triangulation is rebuilt do not count.
    pub energy_rises: usize,
    /// Edges flipped; of methods that sweep, and of Procrustes.
    pub flips: usize,
    /// Triangle corners put back because a move would have turned a triangle over.
    pub moves_undone: usize,
    /// Triangles of the method's own mesh that are turned over at the end.
    pub inverted_triangles: usize,
    /// Points of the input that shared their place with another, and were moved apart.
    pub coincident_points: usize,
    /// Whether all points lay on one line, or in a polygon near one, and were spread first.
    pub was_collinear: bool,
    /// How often the triangulation was rebuilt.
    pub triangulations: usize,
    /// What the user should know, in plain words.
    pub notes: Vec<String>,
}

impl Report {
    /// Says where a sweep was ended by the limit.
    pub(crate) fn note_limit(&mut self) {
        if self.outcome == Outcome::IterationLimit {
            self.notes.push(format!("stopped after {} passes; the best state is kept", self.iterations));
        }
    }

    pub(crate) fn new(method: &'static str, n_points: usize) -> Self {
        Self {
            method,
            n_points,
            outcome: Outcome::NothingToDo,
            iterations: 0,
            visits: 0,
            stable_share: Vec::new(),
            energy: Vec::new(),
            energy_rises: 0,
            flips: 0,
            moves_undone: 0,
            inverted_triangles: 0,
            coincident_points: 0,
            was_collinear: false,
            triangulations: 0,
            notes: Vec::new(),
        }
    }
}
