//! Points find their places; where they cannot, some are added or removed, and they try again.

use std::collections::HashSet;

use glam::DVec2;

use super::aim::Aim;
use super::mover::{MOST_ROUNDS, Mover};
use super::outline::{Of, Outline};
use super::patches::{Patch, Whole, cut_out, put_back};
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
pub(super) fn settle(state: State, place: Place, mover: &Mover, run: &mut RunContext, report: &mut Report) -> Result<Settled, Error> {
    let outline = place.outline;
    let may_halve = |rail: u32| outline.segments[rail as usize].of != Of::Base;
    let rounds = Rounds { place, mover, may_halve: &may_halve, is_patch: false };
    let best = rounds.make(state, run, report).ok_or_else(meets_itself)?;
    let mut settled = Settled::new(&best.mesh, best.mesh.triangulation(), &best.corners).ok_or_else(meets_itself)?;
    // Whoever has interrupted wants the state reached, and soon.
    let aim = mover.aim;
    if !run.is_cancelled() {
        polish(&mut settled, &outline.rails(), &aim, mover.seed);
    }
    report.outcome = match () {
        () if run.is_cancelled() => Outcome::Cancelled,
        () if badness(&settled.triangulation, &aim) == 0.0 => Outcome::Converged,
        () => Outcome::IterationLimit,
    };
    Ok(settled)
}

/// What rounds are made with, on the whole or on a patch.
struct Rounds<'a> {
    place: Place<'a>,
    mover: &'a Mover,
    /// Whether an edge on this rail may be halved.
    may_halve: &'a dyn Fn(u32) -> bool,
    is_patch: bool,
}

/// The best state of some rounds.
struct Best {
    badness: f64,
    mesh: LiveMesh,
    /// The outline's point that each point is; in a patch, the whole's.
    corners: Vec<u32>,
}

impl Rounds<'_> {
    /// Moves points, repairs what is bad, and so on while that helps; where few places are bad, each is settled for itself.
    /// `None` where there is no mesh of the points.
    fn make(&self, mut state: State, run: &mut RunContext, report: &mut Report) -> Option<Best> {
        let Self { place, mover, .. } = *self;
        let aim = mover.aim;
        let mut best: Option<Best> = None;
        let mut n_in_vain = 0;
        // The corners of triangles that could not be mended where they are.
        let mut given_up = HashSet::new();
        // What a patch begins with has been moved.
        let mut is_moved = self.is_patch;
        for round in 0..MOST_ROUNDS {
            let State { points, corners, bonds } = state.in_order(place.domain);
            let Ok(mut mesh) = LiveMesh::bounded(place.domain, &points, bonds, place.spacing) else { break };
            report.triangulations += 1;
            if !is_moved {
                let Ok(moved) = mover.moved(mesh, round, run, report) else { break };
                mesh = moved;
                mesh.legalize();
            }
            let triangulation = mesh.triangulation();
            let badness = badness(&triangulation, &aim);
            let is_better = best.as_ref().is_none_or(|best| badness < best.badness);
            n_in_vain = if is_better { 0 } else { n_in_vain + 1 };
            let is_done = run.is_cancelled() || badness == 0.0 || n_in_vain > MOST_IN_VAIN;
            let patches = if is_done || self.is_patch { None } else { self.patches(&mesh, &triangulation, &corners, &given_up) };
            is_moved = patches.is_some();
            let next = match patches {
                _ if is_done => None,
                Some((_, patches)) if patches.is_empty() => None,
                Some((whole, patches)) => Some(self.mended(whole, patches, &mut given_up, run, report)),
                None => repair(&mesh, corners.clone(), &aim, self.may_halve),
            };
            if is_better {
                best = Some(Best { badness, mesh, corners });
            }
            let Some(next) = next else { break };
            state = next;
        }
        best
    }

    /// The whole, and what is around its bad triangles, except those that are given up; `None` if that is too much of it.
    fn patches(
        &self,
        mesh: &LiveMesh,
        triangulation: &Triangulation,
        corners: &[u32],
        given_up: &HashSet<[u64; 2]>,
    ) -> Option<(State, Vec<Patch>)> {
        let aim = self.mover.aim;
        let state = State::of(mesh, corners.to_vec())?;
        let (_, source) = mesh.bonds()?;
        let is_bad = |t: [u32; 3]| {
            let t = t.map(|v| triangulation.positions[v as usize]);
            aim.badness(t) > 0.0 && !t.iter().all(|&at| given_up.contains(&bits(at)))
        };
        let patches = cut_out(Whole { state: &state, triangulation, source }, is_bad)?;
        Some((state, patches))
    }

    /// The whole with each patch settled for itself.
    fn mended(
        &self,
        whole: State,
        patches: Vec<Patch>,
        given_up: &mut HashSet<[u64; 2]>,
        run: &mut RunContext,
        report: &mut Report,
    ) -> State {
        let aim = self.mover.aim;
        let mut settled = Vec::with_capacity(patches.len());
        for patch in patches {
            let may_halve = |rail: u32| patch.rail(rail).is_some_and(self.may_halve);
            let rounds = Rounds { may_halve: &may_halve, is_patch: true, ..*self };
            let Some(best) = rounds.make(patch.state.clone(), run, report) else { continue };
            if best.badness > 0.0 {
                let Triangulation { half_edges, positions, .. } = best.mesh.triangulation();
                let bad = half_edges.triangles().map(|t| t.map(|v| positions[v as usize])).filter(|&t| aim.badness(t) > 0.0);
                given_up.extend(bad.flatten().map(bits));
            }
            if let Some(state) = State::of(&best.mesh, best.corners) {
                settled.push((patch, state));
            }
        }
        put_back(whole, settled)
    }
}

fn bits(at: DVec2) -> [u64; 2] {
    at.to_array().map(f64::to_bits)
}

/// Why there is no mesh of the points.
fn meets_itself() -> Error {
    Error::Degenerate("the boundary is so fine that points on it meet in rounding; a larger spacing helps".into())
}

/// How bad all triangles are.
fn badness(triangulation: &Triangulation, aim: &Aim) -> f64 {
    let Triangulation { half_edges, positions, .. } = triangulation;
    half_edges.triangles().map(|t| aim.badness(t.map(|v| positions[v as usize]))).sum()
}
