//! [`Steps`]: a job that goes on by one iteration at a time, for those who look on.

use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::{JoinHandle, spawn};

use evenly::{CancelToken, Phase, Progress};

use crate::context::{Context, Event};
use crate::error::Error;
use crate::request::{Outcome, Request};
use crate::resource::Resources;

/// A job on a thread of its own, which waits after each iteration.
///
/// ```
/// use evenly_jobs::{Nothing, Outcome, Request, Steps};
///
/// let request: Request = serde_json::from_str(r#"{"job": "generate", "n_points": 300, "method": "lloyd", "seed": 7}"#)?;
/// let mut steps = Steps::begin(request, Nothing);
/// let first = steps.step().ok_or("there is an iteration")?;
/// assert_eq!((first.progress.iteration, first.positions.len()), (1, 300));
/// let Outcome::Points(outcome) = steps.finish()? else { return Err("these are points".into()) };
/// assert_eq!(outcome.points.n_points(), 300);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Steps {
    job: JoinHandle<Result<Outcome, Error>>,
    steps: Receiver<Step>,
    /// Lets the job go on; where it is gone, the job goes on by itself.
    go_on: Option<SyncSender<()>>,
    cancel: CancelToken,
    is_waiting: bool,
}

/// What a job has come to after an iteration.
#[derive(Debug, Clone)]
pub struct Step {
    /// How far it has come.
    pub progress: Progress,
    /// Where the points are, in the units in which distances count; empty of jobs that have no points in the plane.
    pub positions: Vec<[f64; 2]>,
}

impl Steps {
    /// Begins a job.
    pub fn begin(request: Request, mut resources: impl Resources + Send + 'static) -> Self {
        let (to_us, steps) = sync_channel(0);
        let (go_on, wait) = sync_channel(0);
        let cancel = CancelToken::default();
        let token = cancel.clone();
        let job = spawn(move || {
            let mut positions = Vec::new();
            let watch = |event: Event| match event {
                Event::Positions(now) => positions = now,
                Event::Progress(progress) if progress.phase == Phase::Optimize && progress.iteration > 0 => {
                    let is_seen = to_us.send(Step { progress, positions: std::mem::take(&mut positions) }).is_ok();
                    // Where nobody looks any more, it goes on.
                    if is_seen {
                        let _ = wait.recv();
                    }
                }
                _ => {}
            };
            request.run(&mut resources, &mut Context::watched(watch).with_cancel(token).with_positions())
        });
        Self { job, steps, go_on: Some(go_on), cancel, is_waiting: false }
    }

    /// The next iteration; `None` where there is none more.
    pub fn step(&mut self) -> Option<Step> {
        if let Some(go_on) = self.go_on.as_ref().filter(|_| self.is_waiting) {
            // A job that has ended does not wait.
            let _ = go_on.send(());
        }
        let step = self.steps.recv().ok();
        self.is_waiting = step.is_some();
        step
    }

    /// Goes on to the end.
    ///
    /// # Errors
    /// As [`Request::run`].
    ///
    /// # Panics
    /// Where the job does.
    pub fn finish(mut self) -> Result<Outcome, Error> {
        self.go_on = None;
        drop(self.steps);
        self.job.join().unwrap_or_else(|fault| std::panic::resume_unwind(fault))
    }

    /// Ends the job after the iteration at hand; the outcome has the state reached.
    ///
    /// # Errors
    /// As [`finish`](Self::finish).
    pub fn stop(self) -> Result<Outcome, Error> {
        self.cancel.cancel();
        self.finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::points::PointsOutcome;
    use crate::resource::Nothing;

    fn request(method: &str) -> Request {
        let text = format!(
            r#"{{"job": "generate", "n_points": 200, "method": "{method}", "seed": 3, "space": {{"kind": "rectangle", "size": [2, 1]}}}}"#
        );
        serde_json::from_str(&text).unwrap()
    }

    fn points(outcome: Result<Outcome, Error>) -> PointsOutcome {
        let Ok(Outcome::Points(outcome)) = outcome else { panic!("these are points") };
        outcome
    }

    /// Whoever looks on changes nothing, and sees the last state before it is rounded.
    #[test]
    fn steps_end_where_a_run_does_whatever_the_method() {
        for method in evenly::Method::all().filter(|method| method.is_optimizer() && method.name() != "warp") {
            let whole = points(request(method.name()).run(&mut Nothing, &mut Context::default()));
            let mut steps = Steps::begin(request(method.name()), Nothing);
            let mut last = None;
            let mut n_steps = 0;
            while let Some(step) = steps.step() {
                n_steps += 1;
                assert_eq!((step.progress.iteration, step.positions.len()), (n_steps, 200), "{method}");
                last = Some(step);
            }
            let stepped = points(steps.finish());
            assert_eq!((&stepped.points, &stepped.report), (&whole.points, &whole.report), "{method}");
            let is_last_kept = ["lloyd", "cvt", "distmesh", "procrustes"].contains(&method.name());
            if let Some(last) = last.filter(|_| is_last_kept) {
                let away = |(p, q): (&[f64; 2], &[f64; 2])| (p[0] - q[0]).hypot(p[1] - q[1]);
                let farthest = last.positions.iter().zip(whole.points.positions()).map(away).fold(0.0, f64::max);
                assert!(farthest < 1e-9, "{method}: {farthest}");
            }
        }
    }

    #[test]
    fn a_job_can_be_left_or_stopped() {
        let mut steps = Steps::begin(request("lloyd"), Nothing);
        assert_eq!(steps.step().map(|step| step.progress.iteration), Some(1));
        let stopped = points(steps.stop());
        assert!(stopped.is_cancelled() && stopped.report.is_some_and(|report| report.iterations <= 2));
        let whole = points(request("lloyd").run(&mut Nothing, &mut Context::default()));
        assert_eq!(points(Steps::begin(request("lloyd"), Nothing).finish()).points, whole.points);
        drop(Steps::begin(request("lloyd"), Nothing));
    }
}
