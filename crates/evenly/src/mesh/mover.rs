//! [`Mover`]: what moves the points of a mesh to their places, at first and after each repair.

use super::aim::Aim;
use crate::error::Error;
use crate::methods::{ByRule, Local, LocalMethod, OptBetaParams, PushPull, to_least_ratio};
use crate::parameter::{Setting, Settings};
use crate::run::{Report, RunContext};
use crate::star::Rule;
use crate::sweep::{Ending, Plan, Schedule, Sweep};
use crate::triangulation::LiveMesh;

/// Passes at first in which cells are made alike as well, so that no long waves are left.
const EVEN_PASSES: usize = 60;
const TOLERANCE: f64 = 0.3;
/// Passes until points count as restless, at first and after each repair.
const PASSES: usize = 600;
const LATER_PASSES: usize = 60;
/// After so many passes it is seen whether they have helped: whether no more than this part of the restless points is so still.
const STRETCH: usize = 20;
const HELPED: f64 = 0.75;
/// Where fewer points than this are restless, or than this part of all, passes cost little.
const FEW: f64 = 100.0;
const FEW_SHARE: f64 = 0.02;
/// Rounds of moves and repairs at most.
pub(super) const MOST_ROUNDS: usize = 40;
/// Passes of other methods than Push-Pull's after each repair.
const PASSES_AGAIN: usize = 20;

/// A method, and what is aimed at.
pub(super) struct Mover {
    /// `None` for Push-Pull to what is aimed at.
    local: Option<Local>,
    /// What triangles are to be.
    pub aim: Aim,
    /// What is easier than that, for after repairs.
    later_aim: Aim,
    pub seed: u64,
}

impl Mover {
    pub fn new(method: Option<&LocalMethod>, is_non_obtuse: bool, seed: u64) -> Self {
        let local = method.map(LocalMethod::local);
        let aim = match &local {
            Some(Local::Targets(targets)) => Aim::of(targets, is_non_obtuse),
            _ if is_non_obtuse => Aim::non_obtuse(),
            _ => Aim::plain(),
        };
        Self { local, aim, later_aim: if is_non_obtuse { aim } else { aim.loosened() }, seed }
    }

    /// What Push-Pull is told to go for the aim.
    pub fn targets(&self) -> Settings {
        let Aim { distance, radius, relaxation, .. } = self.aim;
        let numbers = [
            ("min_distance", distance),
            ("coverage_radius", radius),
            ("capacity_tolerance", self.tolerance()),
            ("relaxation", Some(relaxation)),
        ];
        numbers.into_iter().fold(Settings::default(), |all, (name, number)| all.with(name, number.map_or(Setting::Off, Setting::Number)))
    }

    /// The mesh with its points moved; `round` counts the repairs.
    ///
    /// # Errors
    /// [`Error::Degenerate`] where the best state of Opt-beta cannot be retriangulated.
    pub fn moved(&self, mesh: LiveMesh, round: usize, run: &mut RunContext, report: &mut Report) -> Result<LiveMesh, Error> {
        let mut sweep = Sweep::new(mesh);
        let passes = |at_first: usize| if round == 0 { at_first } else { PASSES_AGAIN };
        match &self.local {
            None | Some(Local::Targets(_)) => self.push_and_pull(&mut sweep, round, run, report),
            Some(Local::Passes(rule, n_passes)) => self.relax(&mut sweep, &ByRule(&**rule), passes(*n_passes), run, report),
            Some(Local::Stay) => {}
            Some(Local::LeastRatio(params)) => {
                let params = OptBetaParams { iterations: report.iterations + passes(params.iterations), ..*params };
                let best = to_least_ratio(&mut sweep, &params, run, report)?;
                let mut mesh = sweep.into_mesh();
                mesh.rebuild(best)?;
                return Ok(mesh);
            }
        }
        Ok(sweep.into_mesh())
    }

    fn schedule(&self) -> Schedule {
        if let Some(Local::Targets(targets)) = &self.local { targets.schedule } else { Schedule::InTurn }
    }

    /// By how much cells may differ at first.
    fn tolerance(&self) -> Option<f64> {
        match &self.local {
            Some(Local::Targets(targets)) => targets.capacity_tolerance,
            _ => Some(TOLERANCE),
        }
    }

    fn push_and_pull(&self, sweep: &mut Sweep, round: usize, run: &mut RunContext, report: &mut Report) {
        let passes = match &self.local {
            Some(Local::Targets(targets)) => targets.max_passes.unwrap_or(PASSES + EVEN_PASSES),
            _ => PASSES + EVEN_PASSES,
        };
        if round > 0 {
            self.rest(sweep, &self.later_aim.rule(None), LATER_PASSES.min(passes), run, report);
            return;
        }
        if self.rest(sweep, &self.aim.rule(self.tolerance()), EVEN_PASSES.min(passes), run, report) != Ending::Cancelled {
            self.rest(sweep, &self.aim.rule(None), passes - EVEN_PASSES.min(passes), run, report);
        }
    }

    fn relax(&self, sweep: &mut Sweep, rule: &impl Rule, n_passes: usize, run: &mut RunContext, report: &mut Report) {
        let max_passes = report.iterations + n_passes;
        sweep.run(rule, &Plan { max_passes, ..Plan::of_passes(n_passes + MOST_ROUNDS * PASSES_AGAIN, self.seed) }, run, report);
    }

    /// Sweeps as long as that brings points to rest, and so many passes at most.
    fn rest(&self, sweep: &mut Sweep, rule: &PushPull, most: usize, run: &mut RunContext, report: &mut Report) -> Ending {
        let end = report.iterations + most;
        let few = FEW_SHARE.max(FEW / sweep.n_points() as f64);
        let mut restless = 1.0;
        loop {
            let plan = Plan {
                schedule: self.schedule(),
                max_passes: end.min(report.iterations + STRETCH),
                ..Plan::of_passes(PASSES + MOST_ROUNDS * LATER_PASSES, self.seed)
            };
            let ending = sweep.run(rule, &plan, run, report);
            let left = report.stable_share.last().map_or(0.0, |share| 1.0 - share);
            if ending != Ending::PassLimit || report.iterations >= end || left > few.max(HELPED * restless) {
                return ending;
            }
            restless = left;
        }
    }
}
