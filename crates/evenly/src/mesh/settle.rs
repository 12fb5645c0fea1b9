//! Points find their places; where they cannot, some are added or removed, and they try again.

use std::collections::HashMap;

use super::aim::Aim;
use super::outline::{Of, Outline};
use super::repair::repair;
use super::state::State;
use crate::error::Error;
use crate::optimize::PushPull;
use crate::run::{Report, RunContext};
use crate::space::Domain;
use crate::sweep::{Ending, Plan, Sweep};
use crate::triangulation::{Bonds, LiveMesh, Track, Triangulation};

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
/// Repairs, and how many of them may bring nothing.
const MOST_ROUNDS: usize = 40;
const MOST_IN_VAIN: usize = 10;

/// Points in their places, triangulated.
pub(super) struct Settled {
    pub triangulation: Triangulation,
    /// For each vertex where it may go.
    pub tracks: Vec<Track>,
    /// The outline's point that each vertex is.
    pub corners: Vec<u32>,
    /// The edges on the border and lines by their vertices, and the outline's segment on which each lies.
    pub edges: Vec<([u32; 2], u32)>,
    /// The wanted spacing at each vertex, in the domain's units.
    pub sizes: Vec<f64>,
}

/// Where a mesh is made.
#[derive(Clone, Copy)]
pub(super) struct Place<'a> {
    pub domain: &'a Domain,
    pub outline: &'a Outline,
    /// The wanted spacing, in normalised units.
    pub spacing: f64,
}

/// Moves points to what is aimed at, at first and after repairs, and keeps the best of all states.
pub(super) fn settle(
    state: State,
    Place { domain, outline, spacing }: Place,
    (aim, later): (Aim, Aim),
    seed: u64,
    run: &mut RunContext,
    report: &mut Report,
) -> Result<Settled, Error> {
    let may_halve = |rail: u32| outline.segments[rail as usize].of != Of::Base;
    let mut best: Option<(f64, Settled)> = None;
    let (mut state, mut n_in_vain) = (state, 0);
    for round in 0..MOST_ROUNDS {
        let State { points, corners, bonds } = state.in_order(domain);
        let Ok(mesh) = LiveMesh::bounded(domain, &points, bonds, spacing) else { break };
        report.triangulations += 1;
        let mut sweep = Sweep::new(mesh);
        let mut rest = |rule, most| rest(&mut sweep, &rule, (points.len(), most), seed, run, report);
        let ending = if round == 0 {
            match rest(aim.rule(Some(TOLERANCE)), EVEN_PASSES) {
                Ending::Cancelled => Ending::Cancelled,
                _ => rest(aim.rule(None), PASSES),
            }
        } else {
            rest(later.rule(None), LATER_PASSES)
        };
        let mut mesh = sweep.into_mesh();
        mesh.legalize();
        let triangulation = mesh.triangulation();
        let badness = badness(&triangulation, &aim);
        let is_better = best.as_ref().is_none_or(|&(least, _)| badness < least);
        n_in_vain = if is_better { 0 } else { n_in_vain + 1 };
        let is_done = ending == Ending::Cancelled || badness == 0.0 || n_in_vain > MOST_IN_VAIN;
        let repaired = if is_done { None } else { repair(&mesh, corners.clone(), &aim, may_halve) };
        if is_better && let Some((bonds, source)) = mesh.bonds() {
            best = Some((badness, settled(triangulation, &mesh, &bonds, source, &corners)));
        }
        let Some(repaired) = repaired else { break };
        state = repaired;
    }
    let meets_itself = || Error::Degenerate("the border is so fine that points on it meet in rounding; a larger spacing helps".into());
    best.map(|(_, settled)| settled).ok_or_else(meets_itself)
}

/// Sweeps as long as that brings points to rest, and so many passes at most.
fn rest(
    sweep: &mut Sweep,
    rule: &PushPull,
    (n_points, most): (usize, usize),
    seed: u64,
    run: &mut RunContext,
    report: &mut Report,
) -> Ending {
    let end = report.iterations + most;
    let few = FEW_SHARE.max(FEW / n_points as f64);
    let mut restless = 1.0;
    loop {
        let plan = Plan { max_passes: end.min(report.iterations + STRETCH), ..Plan::of_passes(PASSES + MOST_ROUNDS * LATER_PASSES, seed) };
        let ending = sweep.run(rule, &plan, run, report);
        let left = report.stable_share.last().map_or(0.0, |share| 1.0 - share);
        if ending != Ending::PassLimit || report.iterations >= end || left > few.max(HELPED * restless) {
            return ending;
        }
        restless = left;
    }
}

/// How bad all triangles are.
pub(super) fn badness(triangulation: &Triangulation, aim: &Aim) -> f64 {
    let Triangulation { half_edges, positions, .. } = triangulation;
    half_edges.triangles().map(|t| aim.badness(t.map(|v| positions[v as usize]))).sum()
}

/// The state of the mesh, by vertex.
fn settled(triangulation: Triangulation, mesh: &LiveMesh, bonds: &Bonds, source: &[u32], corners: &[u32]) -> Settled {
    // Edges are on rails between vertices as they are between points; a point's several vertices are told apart by the triangulation.
    let rails: HashMap<[u32; 2], u32> = bonds.edges.iter().map(|edge| (edge.ends, edge.rail)).collect();
    let half_edges = &triangulation.half_edges;
    let ends = (0..half_edges.origin.len() as u32).map(|h| [half_edges.origin[h as usize], half_edges.target(h)]);
    let edges = ends.filter_map(|ends| Some((ends, *rails.get(&ends.map(|v| source[v as usize]))?))).collect();
    Settled {
        tracks: source.iter().map(|&point| bonds.tracks[point as usize]).collect(),
        corners: source.iter().map(|&point| corners[point as usize]).collect(),
        edges,
        sizes: (0..source.len() as u32).map(|v| mesh.local_spacing(v)).collect(),
        triangulation,
    }
}
