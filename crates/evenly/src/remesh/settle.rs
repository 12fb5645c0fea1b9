//! Vertices find their places.

use std::ops::Range;

use super::RemeshParams;
use super::ground::State;
use super::live::LiveSurface;
use super::polish::Bounds;
use crate::error::Error;
use crate::methods::{ByRule, Local, OptBetaParams, PushPull, PushPullParams};
use crate::points::Random;
use crate::run::{Outcome, Report, RunContext};
use crate::star::Rule;
use crate::sweep::{Ending, Ground as _, Order, Plan, Sweep};

/// In the first passes triangles change much, and with them the area that chords enclose: the spacing is recomputed after each of these.
const RENEWALS: [usize; 7] = [1, 2, 4, 8, 12, 20, 30];
/// After so many passes the last restless vertices are left to themselves, in stages of some passes.
const EVEN_PASSES: usize = 140;
const STAGE: usize = 30;
/// Moves are so much longer then: that takes about a seventh of the passes less. With 1.35 some vertices never come to rest.
const STRETCH: f64 = 1.15;
/// How far those are pushed to the side between stages that were blocked, in spacings.
const KICK: f64 = 0.05;
/// After so many stages all are, farther.
const GENTLE_STAGES: usize = 3;
const HARD_KICK: f64 = 0.1;
/// And after so many, anchors among them are let go.
const PATIENCE: usize = 5;
/// A stage is in vain that leaves more than this part of the fewest restless vertices so far; on a surface with creases or boundaries so many of them end a run.
const BETTER: f64 = 0.9;
const IN_VAIN: usize = 6;
/// In these stages vertices go from where a crease has too many to where it has too few.
const TRANSPLANTS: Range<usize> = 1..10;
/// So often vertices are put where the surface stands out.
const ANCHORINGS: usize = 2;
/// So often those are let go that keep others from their places.
const RELEASES: usize = 3;
/// Passes at most, if none are given; as many again after each time.
const MOST_PASSES: usize = 1000;

/// Moves vertices by the wanted method, with a seed in place of the parameters', and says in the report how that has ended.
pub(super) fn settle<'a>(
    mut live: LiveSurface<'a>,
    params: &RemeshParams,
    seed: u64,
    run: &mut RunContext,
    report: &mut Report,
) -> Result<LiveSurface<'a>, Error> {
    let local = params.method.local();
    if matches!(local, Local::Stay) {
        live.legalize();
        report.outcome = Outcome::Converged;
        return Ok(live);
    }
    if !matches!(local, Local::Targets(_)) {
        live.loosen_rows();
    }
    let mut sweep = Sweep::new(live);
    find_places(&mut sweep, &local, seed, run, report)?;
    // Where the surface stands out, a vertex stays, and the others find their places around it.
    for _ in 0..ANCHORINGS {
        let n_anchored = params.max_deviation.filter(|_| !run.is_cancelled()).map_or(0, |length| sweep.ground_mut().anchor(length));
        if n_anchored == 0 {
            break;
        }
        sweep.change_rule(report.iterations);
        find_places(&mut sweep, &local, seed, run, report)?;
    }
    // What is fixed does not move, though it may be too near to others that are: off the creases it is let go.
    let targets = if let Local::Targets(targets) = &local { Some(*targets) } else { None };
    for _ in 0..RELEASES {
        let has_missed = |targets: &PushPullParams| report.outcome == Outcome::Converged && !sweep.ground_mut().meets(targets);
        let Some(missed) = targets.filter(has_missed) else { break };
        if sweep.ground_mut().release_missed(&missed) == 0 {
            break;
        }
        sweep.change_rule(report.iterations);
        find_places(&mut sweep, &local, seed, run, report)?;
    }
    let mut live = sweep.into_mesh();
    let n_released = live.n_released;
    if n_released > 0 {
        report.notes.push(format!(
            "{n_released} vertices on tips, and where the surface stands out, were let go: they kept the targets from being reached"
        ));
    }
    let Some(targets) = targets else {
        report.note_limit();
        return Ok(live);
    };
    let is_cut_short = report.outcome == Outcome::IterationLimit;
    if report.outcome == Outcome::Converged && !live.meets(&targets) {
        report.outcome = Outcome::IterationLimit;
    }
    if let Some(beta) = params.method.beta()
        && report.outcome == Outcome::IterationLimit
    {
        // Beside creases some triangles may still be obtuse, though they need not be.
        let bounds = Bounds::of_beta(beta);
        live.polish(bounds, seed);
        live.square_up();
        conclude(&mut live, bounds, report);
    }
    if is_cut_short {
        report.note_limit();
    }
    Ok(live)
}

/// Says which triangles the input forces to miss the bounds; where there are no others, the run has done what can be done.
fn conclude(live: &mut LiveSurface, bounds: Bounds, report: &mut Report) {
    let missed = live.missed(bounds);
    if missed.n_others > 0 {
        report.notes.push("vertices that stay where they are, on creases, boundaries and tips, keep the targets from being reached".into());
    } else {
        report.outcome = if missed.forced.is_empty() { Outcome::Converged } else { Outcome::Forced };
    }
    if !missed.forced.is_empty() {
        let [least, most] = bounds.degrees();
        report.notes.push(format!(
            "forced: {} triangles at {} corners of the input, whose angles no division brings within {least:.2} and {most:.2} degrees",
            missed.forced.len(),
            missed.n_corners
        ));
    }
    (live.forced, live.n_missed) = (missed.forced, missed.n_others);
}

fn find_places(sweep: &mut Sweep<LiveSurface>, local: &Local, seed: u64, run: &mut RunContext, report: &mut Report) -> Result<(), Error> {
    match local {
        Local::Targets(targets) => push_and_pull(sweep, targets, seed, run, report)?,
        Local::Passes(rule, n_passes) => relax(sweep, &ByRule(&**rule), *n_passes, seed, run, report),
        Local::LeastRatio(wanted) => to_least_ratio(sweep, wanted, seed, run, report)?,
        Local::Stay => {}
    }
    Ok(())
}

fn push_and_pull(
    sweep: &mut Sweep<LiveSurface>,
    targets: &PushPullParams,
    seed: u64,
    run: &mut RunContext,
    report: &mut Report,
) -> Result<(), Error> {
    let rule = targets.rule();
    let begin = report.iterations;
    let max_passes = begin + targets.max_passes.unwrap_or(MOST_PASSES);
    let plan = Plan { schedule: targets.schedule, keeps_best: true, ..Plan::of_passes(max_passes, seed) };
    // 1. All rules, while most vertices find their places; later only few have lost theirs.
    let mut ending = Ending::PassLimit;
    if begin == 0 {
        ending = renew(sweep, &rule, &plan, run, report);
        if ending == Ending::PassLimit {
            ending = sweep.run(&rule, &Plan { max_passes: max_passes.min(EVEN_PASSES), ..plan }, run, report);
        }
    }
    sweep.ground_mut().loosen_rows();
    // 2. In narrow folds a few may not come to rest: without the rule of areas, with longer moves, and after a push to the side they do.
    let capacity_tolerance = if rule.min_distance.or(rule.coverage_radius).is_some() { None } else { rule.capacity_tolerance };
    let rule = PushPull { capacity_tolerance, relaxation: STRETCH * rule.relaxation, ..rule };
    let has_creases = !sweep.ground_mut().bonds.is_empty();
    let lengths = targets.coverage_radius.zip(targets.min_distance).filter(|_| has_creases);
    let bounds = lengths.map(|(radius, distance)| Bounds::of_beta(radius / distance));
    let mut best: Option<((f64, usize), State)> = None;
    let (mut n_stages, mut fewest, mut n_in_vain) = (0, 1.0, 0);
    while ending == Ending::PassLimit && report.iterations < max_passes {
        ending = sweep.run(&rule, &Plan { max_passes: max_passes.min(report.iterations + STAGE), ..plan }, run, report);
        if ending != Ending::PassLimit {
            break;
        }
        // Creases, unlike a smooth surface, may keep some from rest for good; where these are but in corners that force it, nothing is left to do.
        let live = sweep.ground_mut();
        if let Some(bounds) = bounds {
            let missed = (live.misfit(), live.missed(bounds).n_others);
            if best.as_ref().is_none_or(|&(least, _)| missed < least) {
                best = Some((missed, live.state()));
            }
            if missed.1 == 0 {
                break;
            }
        }
        let restless = report.stable_share.last().map_or(0.0, |share| 1.0 - share);
        if restless < BETTER * fewest {
            (fewest, n_in_vain) = (restless, 0);
        } else {
            n_in_vain += 1;
        }
        if has_creases && n_in_vain >= IN_VAIN || report.iterations >= max_passes {
            break;
        }
        let is_gentle = n_stages < GENTLE_STAGES;
        live.kick(if is_gentle { KICK } else { HARD_KICK }, !is_gentle, &mut Random::new(seed, n_stages as u64));
        if n_stages >= PATIENCE {
            live.release_restless();
        }
        let has_moved = |bounds| TRANSPLANTS.contains(&n_stages) && live.transplant(bounds) > 0;
        if bounds.is_some_and(has_moved) {
            (fewest, n_in_vain) = (1.0, 0);
        }
        n_stages += 1;
    }
    report.outcome = outcome(ending, Outcome::IterationLimit);
    if report.outcome == Outcome::IterationLimit {
        match best {
            Some((_, state)) => sweep.ground_mut().restore(state)?,
            None => sweep.return_to_best()?,
        }
    }
    Ok(())
}

fn relax(sweep: &mut Sweep<LiveSurface>, rule: &impl Rule, n_passes: usize, seed: u64, run: &mut RunContext, report: &mut Report) {
    let plan = Plan::of_passes(report.iterations + n_passes, seed);
    let mut ending = renew(sweep, rule, &plan, run, report);
    if ending == Ending::PassLimit && report.iterations < plan.max_passes {
        ending = sweep.run(rule, &plan, run, report);
    }
    report.outcome = outcome(ending, Outcome::IterationsDone);
}

/// Sweeps by rows until the ratio is reached, and keeps the state in which it is least.
fn to_least_ratio(
    sweep: &mut Sweep<LiveSurface>,
    wanted: &OptBetaParams,
    seed: u64,
    run: &mut RunContext,
    report: &mut Report,
) -> Result<(), Error> {
    let rule = wanted.rule();
    let end = report.iterations + wanted.iterations;
    let mut best = (sweep.ground_mut().beta(), sweep.ground_mut().state());
    report.energy.push(best.0);
    report.outcome = loop {
        if best.0 <= wanted.wanted() {
            break Outcome::Converged;
        }
        if report.iterations >= end {
            break Outcome::IterationLimit;
        }
        let plan = Plan { order: Order::Rows, max_passes: report.iterations + 1, ..Plan::of_passes(end, seed) };
        if sweep.run(&rule, &plan, run, report) == Ending::Cancelled {
            break Outcome::Cancelled;
        }
        let reached = sweep.ground_mut().beta();
        report.energy.push(reached);
        if reached < best.0 {
            best = (reached, sweep.ground_mut().state());
        }
    };
    sweep.ground_mut().restore(best.1)
}

/// The first passes, with the spacing recomputed.
fn renew(sweep: &mut Sweep<LiveSurface>, rule: &impl Rule, plan: &Plan, run: &mut RunContext, report: &mut Report) -> Ending {
    let (begin, mut ending) = (report.iterations, Ending::PassLimit);
    for max_passes in RENEWALS.map(|passes| begin + passes).into_iter().take_while(|&passes| passes <= plan.max_passes) {
        ending = sweep.run(rule, &Plan { max_passes, keeps_best: false, ..*plan }, run, report);
        if ending == Ending::Cancelled {
            return ending;
        }
        sweep.ground_mut().renew_spacing();
        sweep.change_rule(report.iterations);
        ending = Ending::PassLimit;
    }
    ending
}

fn outcome(ending: Ending, otherwise: Outcome) -> Outcome {
    match ending {
        Ending::Converged => Outcome::Converged,
        Ending::Cancelled => Outcome::Cancelled,
        Ending::PassLimit | Ending::Diverging | Ending::Stuck => otherwise,
    }
}
