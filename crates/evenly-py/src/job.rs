//! Long work on threads of its own, while Python's main thread looks after Ctrl-C.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::{Duration, Instant};

use evenly::{CancelToken, Phase, Progress};
use evenly_jobs::{Context, Error, Event};
use pyo3::create_exception;
use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError, PyValueError};
use pyo3::prelude::*;

use crate::answer::{Answer, Keywords};
use crate::arrays::array;

create_exception!(_evenly, Stopped, PyKeyboardInterrupt, "A job was interrupted; the argument is a `Pending`.");

/// How often signals are looked for, and how long an interrupted job may take to hand over before the interrupt is raised without it.
const LOOK: Duration = Duration::from_millis(20);
const GRACE: Duration = Duration::from_millis(50);

/// A job's answer, when it is there.
type Done = Result<Answer, Failure>;

enum Failure {
    /// Bad input.
    Value(String),
    /// What a callback has raised.
    Raised(PyErr),
    /// A fault of ours.
    Panic(String),
}

impl From<Failure> for PyErr {
    fn from(failure: Failure) -> Self {
        match failure {
            Failure::Value(message) => PyValueError::new_err(message),
            Failure::Raised(error) => error,
            Failure::Panic(message) => PyRuntimeError::new_err(format!("a fault in evenly, please report it: {message}")),
        }
    }
}

/// Where a job leaves its answer.
#[derive(Clone, Default)]
struct Desk(Arc<(Mutex<Option<Done>>, Condvar)>);

impl Desk {
    fn leave(&self, done: Done) {
        *self.0.0.lock().unwrap_or_else(PoisonError::into_inner) = Some(done);
        self.0.1.notify_all();
    }

    /// Waits so long at most.
    fn take(&self, patience: Duration) -> Option<Done> {
        let desk = self.0.0.lock().unwrap_or_else(PoisonError::into_inner);
        let (mut desk, _) = self.0.1.wait_timeout_while(desk, patience, |done| done.is_none()).unwrap_or_else(PoisonError::into_inner);
        desk.take()
    }
}

/// An interrupted job, which ends after the iteration at hand.
#[pyclass(frozen)]
pub struct Pending(Mutex<Option<Desk>>);

#[pymethods]
impl Pending {
    /// Waits for the state reached, which can be had once.
    fn result(&self, py: Python) -> PyResult<Py<PyAny>> {
        let desk = self.0.lock().unwrap_or_else(PoisonError::into_inner).take();
        let desk = desk.ok_or_else(|| PyRuntimeError::new_err("the state reached has been handed over"))?;
        loop {
            if let Some(done) = py.detach(|| desk.take(LOOK)) {
                return done.map_err(PyErr::from)?(py);
            }
            py.check_signals()?;
        }
    }
}

/// What a job is told besides its work.
pub struct Terms {
    /// `None` for as many as there are cores.
    pub threads: Option<usize>,
    /// Called after each iteration; False stops.
    pub callback: Option<Py<PyAny>>,
}

/// Runs work on threads, and returns its answer. Another Python thread may go on meanwhile.
pub fn run(
    py: Python,
    Terms { threads, callback }: Terms,
    work: impl FnOnce(&mut Context) -> Result<Answer, Error> + Send + 'static,
) -> PyResult<Py<PyAny>> {
    let (desk, cancel) = (Desk::default(), CancelToken::default());
    let (theirs, token) = (desk.clone(), cancel.clone());
    let on_threads = move || -> Done {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0)).build().map_err(|e| Failure::Value(e.to_string()))?;
        pool.install(|| {
            let mut raised = None;
            let done = {
                let mut positions = Vec::new();
                let watch = |event: Event| {
                    let progress = match event {
                        Event::Positions(now) => return positions = now,
                        Event::Progress(progress) => progress,
                        _ => return,
                    };
                    if let Some(callback) = callback.as_ref().filter(|_| progress.phase == Phase::Optimize && progress.iteration > 0) {
                        match goes_on(callback, progress, std::mem::take(&mut positions)) {
                            Ok(true) => {}
                            Ok(false) => token.cancel(),
                            Err(error) => {
                                token.cancel();
                                raised.get_or_insert(error);
                            }
                        }
                    }
                };
                let context = Context::watched(watch).with_cancel(token.clone());
                work(&mut if callback.is_some() { context.with_positions() } else { context })
            };
            match raised {
                Some(error) => Err(Failure::Raised(error)),
                None => done.map_err(|error| Failure::Value(error.message().shown(&Keywords))),
            }
        })
    };
    std::thread::spawn(move || {
        let done = catch_unwind(AssertUnwindSafe(on_threads));
        theirs.leave(done.unwrap_or_else(|fault| Err(Failure::Panic(told(&*fault)))));
    });
    loop {
        if let Some(done) = py.detach(|| desk.take(LOOK)) {
            return done.map_err(PyErr::from)?(py);
        }
        if let Err(signal) = py.check_signals() {
            cancel.cancel();
            if !signal.is_instance_of::<PyKeyboardInterrupt>(py) {
                return Err(signal);
            }
            let since = Instant::now();
            // Those who come back at once are waited for.
            while since.elapsed() < GRACE {
                if let Some(done) = py.detach(|| desk.take(GRACE)) {
                    desk.leave(done);
                    break;
                }
            }
            return Err(Stopped::new_err((Py::new(py, Pending(Mutex::new(Some(desk))))?,)));
        }
    }
}

/// Asks a callback whether to go on.
fn goes_on(callback: &Py<PyAny>, progress: Progress, positions: Vec<[f64; 2]>) -> PyResult<bool> {
    Python::attach(|py| {
        let Progress { iteration, energy, stable_share, fraction, .. } = progress;
        let positions = if positions.is_empty() { None } else { Some(array(py, positions)?) };
        let answer = callback.call1(py, (iteration, energy, stable_share, fraction, positions))?;
        // False alone is a refusal, numpy's too; functions that say nothing return None.
        Ok(answer.extract::<bool>(py).unwrap_or(true))
    })
}

fn told(fault: &(dyn std::any::Any + Send)) -> String {
    let text = fault.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| fault.downcast_ref::<String>().cloned()).unwrap_or_default()
}
