//! Points find their places; where they cannot, some are added or removed, and they try again.

use glam::DVec2;

use super::aim::Aim;
use super::mover::{MOST_ROUNDS, Mover};
use super::outline::{Of, Outline};
use super::polish::polish;
use super::repair::repair;
use super::settled::Settled;
use super::state::State;
use crate::error::Error;
use crate::run::{Outcome, Report, RunContext};
use crate::space::Domain;
use crate::triangulation::{LiveMesh, Triangulation};

/// So many repairs may bring nothing, one after the other.
const MOST_IN_VAIN: usize = 10;

/// Where a mesh is made.
#[derive(Clone, Copy)]
pub(super) struct Place<'a> {
    pub domain: &'a Domain,
    pub outline: &'a Outline,
    /// The wanted spacing, in normalised units.
    pub spacing: f64,
}

/// Moves points to what is aimed at, at first and after repairs, polishes the best of all states, and says in the report whether all is good.
pub(super) fn settle(
    state: State,
    Place { domain, outline, spacing }: Place,
    mover: &Mover,
    run: &mut RunContext,
    report: &mut Report,
) -> Result<Settled, Error> {
    let aim = mover.aim();
    let may_halve = |rail: u32| outline.segments[rail as usize].of != Of::Base;
    let mut best: Option<(f64, Settled)> = None;
    let (mut state, mut n_in_vain) = (state, 0);
    for round in 0..MOST_ROUNDS {
        let State { points, corners, bonds } = state.in_order(domain);
        let Ok(mesh) = LiveMesh::bounded(domain, &points, bonds, spacing) else { break };
        report.triangulations += 1;
        let Ok(mut mesh) = mover.moved(mesh, round, run, report) else { break };
        mesh.legalize();
        let triangulation = mesh.triangulation();
        let badness = badness(&triangulation, &aim);
        let is_better = best.as_ref().is_none_or(|&(least, _)| badness < least);
        n_in_vain = if is_better { 0 } else { n_in_vain + 1 };
        let is_done = run.is_cancelled() || badness == 0.0 || n_in_vain > MOST_IN_VAIN;
        let repaired = if is_done { None } else { repair(&mesh, corners.clone(), &aim, may_halve) };
        if is_better && let Some(settled) = Settled::new(&mesh, triangulation, &corners) {
            best = Some((badness, settled));
        }
        let Some(repaired) = repaired else { break };
        state = repaired;
    }
    let (_, mut settled) = best.ok_or_else(meets_itself)?;
    // Whoever has interrupted wants the state reached, and soon.
    if !run.is_cancelled() {
        let rails: Vec<[DVec2; 2]> = outline.segments.iter().map(|segment| segment.ends.map(|v| outline.points[v as usize])).collect();
        polish(&mut settled, &rails, &aim, mover.seed);
    }
    report.outcome = match () {
        () if run.is_cancelled() => Outcome::Cancelled,
        () if badness(&settled.triangulation, &aim) == 0.0 => Outcome::Converged,
        () => Outcome::IterationLimit,
    };
    Ok(settled)
}

/// Why there is no mesh of the points.
fn meets_itself() -> Error {
    Error::Degenerate("the border is so fine that points on it meet in rounding; a larger spacing helps".into())
}

/// How bad all triangles are.
fn badness(triangulation: &Triangulation, aim: &Aim) -> f64 {
    let Triangulation { half_edges, positions, .. } = triangulation;
    half_edges.triangles().map(|t| aim.badness(t.map(|v| positions[v as usize]))).sum()
}
