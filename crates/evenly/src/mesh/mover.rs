//! [`Mover`]: what moves the points of a mesh to their places, at first and after each repair.

use super::aim::Aim;
use super::method::MeshMethod;
use crate::error::Error;
use crate::optimize::{OptBetaParams, PushPull, to_least_ratio};
use crate::run::{Report, RunContext};
use crate::star::Rule;
use crate::sweep::{Ending, Plan, Sweep};
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
pub(super) struct Mover<'a> {
    pub method: &'a MeshMethod,
    pub is_non_obtuse: bool,
    pub seed: u64,
}

impl Mover<'_> {
    /// What triangles are to be.
    pub fn aim(&self) -> Aim {
        if self.is_non_obtuse { Aim::non_obtuse() } else { Aim::plain() }
    }

    /// What is easier than that, for after repairs.
    fn later_aim(&self) -> Aim {
        if self.is_non_obtuse { Aim::non_obtuse() } else { Aim::loose() }
    }

    /// The mesh with its points moved; `round` counts the repairs.
    ///
    /// # Errors
    /// [`Error::Degenerate`] where the best state of Opt-beta cannot be triangulated anew.
    pub fn moved(&self, mesh: LiveMesh, round: usize, run: &mut RunContext, report: &mut Report) -> Result<LiveMesh, Error> {
        let mut sweep = Sweep::new(mesh);
        let passes = |at_first: usize| if round == 0 { at_first } else { PASSES_AGAIN };
        match self.method {
            MeshMethod::PushPull => self.push_and_pull(&mut sweep, round, run, report),
            MeshMethod::Lloyd(params) => self.relax(&mut sweep, &params.rule(), passes(params.iterations), run, report),
            MeshMethod::DistMesh(params) => self.relax(&mut sweep, &params.rule(), passes(params.iterations), run, report),
            MeshMethod::OptBeta(params) => {
                let params = OptBetaParams { iterations: report.iterations + passes(params.iterations), ..*params };
                let best = to_least_ratio(&mut sweep, &params, run, report)?;
                let mut mesh = sweep.into_mesh();
                mesh.rebuild(best)?;
                return Ok(mesh);
            }
        }
        Ok(sweep.into_mesh())
    }

    fn push_and_pull(&self, sweep: &mut Sweep, round: usize, run: &mut RunContext, report: &mut Report) {
        if round > 0 {
            self.rest(sweep, &self.later_aim().rule(None), LATER_PASSES, run, report);
            return;
        }
        if self.rest(sweep, &self.aim().rule(Some(TOLERANCE)), EVEN_PASSES, run, report) != Ending::Cancelled {
            self.rest(sweep, &self.aim().rule(None), PASSES, run, report);
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
