//! [`Context`]: what a job tells while it works, and how it is cancelled.

use std::cell::RefCell;

use evenly::{CancelToken, Phase, Progress, RunContext};

use crate::message::Message;

/// What a job does at the moment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// Data are looked up.
    Read,
    /// Points are made to begin with.
    Start,
    /// They are evened out.
    Warp,
    /// A method is at work; its progress comes as well. From here on there is a state to keep.
    Optimize,
    /// The result is measured.
    Measure,
}

/// A sign of life.
#[derive(Debug)]
pub enum Event<'a> {
    /// Something else begins.
    Stage(Stage),
    /// Where the points are after an iteration, of methods on points in the plane; its progress comes next.
    Positions(Vec<[f64; 2]>),
    /// How far a method has come.
    Progress(Progress),
    /// What should be known at once; the outcome has it too.
    Note(&'a Message),
    /// One of several runs begins.
    Run {
        /// What it is called.
        label: &'a str,
        /// How many there are in all.
        n_runs: usize,
    },
}

/// Who watches a job, and may cancel it. The default watches nothing.
#[derive(Default)]
pub struct Context<'a> {
    watch: Option<Watch<'a>>,
    cancel: CancelToken,
    has_positions: bool,
}

type Watch<'a> = Box<dyn FnMut(Event) + 'a>;

impl<'a> Context<'a> {
    /// Calls `watch` with each event.
    pub fn watched(watch: impl FnMut(Event) + 'a) -> Self {
        Self { watch: Some(Box::new(watch)), ..Self::default() }
    }

    /// Ends the job when `cancel` is raised: the outcome then has the state reached.
    #[must_use]
    pub fn with_cancel(self, cancel: CancelToken) -> Self {
        Self { cancel, ..self }
    }

    /// Tells of positions too.
    #[must_use]
    pub fn with_positions(self) -> Self {
        Self { has_positions: true, ..self }
    }

    /// Whether somebody has asked the job to end.
    pub fn is_cancelled(&self) -> bool {
        self.cancel.is_cancelled()
    }

    pub(crate) fn tell(&mut self, event: Event) {
        if let Some(watch) = &mut self.watch {
            watch(event);
        }
    }

    /// Tells of a note, and keeps it.
    pub(crate) fn note(&mut self, notes: &mut Vec<Message>, note: Message) {
        self.tell(Event::Note(&note));
        notes.push(note);
    }

    pub(crate) fn enter(&mut self, stage: Stage) {
        self.tell(Event::Stage(stage));
    }

    /// For what takes long without progress of its own; cancelled as the job is.
    pub(crate) fn silent(&self) -> RunContext<'static> {
        RunContext::default().with_cancel(self.cancel.clone())
    }

    /// Lets a method run, which tells of its progress. There is a state to keep once it moves points.
    pub(crate) fn run<T>(&mut self, method: impl FnOnce(&mut RunContext) -> T) -> T {
        let (cancel, has_positions) = (self.cancel.clone(), self.has_positions);
        let shared = RefCell::new(self);
        let mut has_begun = false;
        let on_progress = |progress: Progress| {
            let mut context = shared.borrow_mut();
            if progress.phase == Phase::Optimize && !std::mem::replace(&mut has_begun, true) {
                context.enter(Stage::Optimize);
            }
            context.tell(Event::Progress(progress));
        };
        let on_warning = |warning: &str| shared.borrow_mut().tell(Event::Note(&warning.to_owned().into()));
        let on_positions = |positions| shared.borrow_mut().tell(Event::Positions(positions));
        let run = RunContext::default().with_cancel(cancel).on_progress(on_progress).on_warning(on_warning);
        method(&mut if has_positions { run.on_positions(on_positions) } else { run })
    }
}
