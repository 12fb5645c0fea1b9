//! Passes over what is dirty, until one finds nothing to do.

use glam::DVec2;
use rayon::prelude::*;
use serde::Serialize;

use super::cells::Cells;
use super::ground::{Buffer, Ground};
use super::summed::summed_pass;
use super::visit::{Work, visit};
use crate::error::Error;
use crate::points::Random;
use crate::run::{Phase, Progress, Report, RunContext};
use crate::star::Rule;
use crate::triangulation::{Distances, LiveMesh};

/// When the moves are made that a pass asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Schedule {
    /// At each visit, before the next: each point sees what the others have done (Gauss-Seidel).
    #[default]
    InTurn,
    /// At the end of the pass, all together, each point by the sum of what its neighbours asked of it (Jacobi).
    Summed,
}

/// In which order the points of a cell are visited.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Order {
    /// At random, in a new order each pass.
    Shuffled,
    /// By rows of half a spacing, and along them.
    Rows,
}

/// How a sweep is to go.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Plan {
    pub schedule: Schedule,
    pub order: Order,
    /// The run ends after so many passes in any case, those of earlier runs included.
    pub max_passes: usize,
    /// So many passes may be made in all, for the progress.
    pub total_passes: usize,
    /// The order of visits depends on it, on the pass and on the cell.
    pub seed: u64,
    /// Whether the state with the least unrest is kept; otherwise the last one counts.
    pub keeps_best: bool,
    /// Whether the sweep ends where it gets worse and worse.
    pub ends_if_diverging: bool,
    /// Whether it ends where no state better than the best has come for long.
    pub ends_if_stuck: bool,
}

impl Plan {
    /// So many passes, from which the last state counts.
    pub fn of_passes(n_passes: usize, seed: u64) -> Self {
        Self {
            schedule: Schedule::InTurn,
            order: Order::Shuffled,
            max_passes: n_passes,
            total_passes: n_passes,
            seed,
            keeps_best: false,
            ends_if_diverging: false,
            ends_if_stuck: false,
        }
    }
}

/// How a sweep has ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ending {
    /// A pass found nothing to do and left no dirt, and all of the mesh is Delaunay.
    Converged,
    PassLimit,
    Cancelled,
    Diverging,
    Stuck,
}

/// Points on their way.
pub(crate) struct Sweep<G: Ground = LiveMesh> {
    mesh: G,
    cells: Cells<G::Territory>,
    /// What each pass wanted to move: squared, in spacings, on average of the points.
    unrest: Vec<f64>,
    best: Best<G::State>,
    /// How many visits the last pass put off.
    n_deferred: usize,
    /// How far the sweep has come, as it was last shown.
    fraction: f64,
}

/// The state after the pass that found the least wrong.
struct Best<S> {
    wrong: f64,
    /// The pass, counted from 1; 0 for the start.
    pass: usize,
    state: S,
}

/// A state is kept as the best if it has less than this share of what is wrong with the one that is kept: copies cost time.
const BETTER: f64 = 0.9;
/// A sweep is stuck that has found nothing better in this many passes, and in as many as it took to the best.
const LONG: usize = 500;
/// Before so many passes no sweep is said to diverge.
const PATIENCE: usize = 400;
/// The passes over which its unrest is averaged then.
const WINDOW: usize = 64;
/// The unrest a point, squares of spacings, above which it diverges. Sweeps that converge in the end have come below by then.
const RESTLESS: f64 = 0.007;
/// After this many passes, and at the powers of two before, points are put into the cells where they are by then.
const RENEWAL: usize = 64;

impl<S> Best<S> {
    /// The state of the mesh after so many passes, of which nothing is known yet.
    fn start(mesh: &impl Ground<State = S>, pass: usize) -> Self {
        Self { wrong: f64::INFINITY, pass, state: mesh.state() }
    }
}

impl<G: Ground> Sweep<G> {
    pub fn new(mut mesh: G) -> Self {
        let cells = mesh.cells();
        let best = Best::start(&mesh, 0);
        Self { mesh, cells, unrest: Vec::new(), best, n_deferred: 0, fraction: 0.0 }
    }

    /// Sweeps until nothing moves, and adds to the report what it did.
    pub fn run(&mut self, rule: &impl Rule, plan: &Plan, run: &mut RunContext, report: &mut Report) -> Ending {
        self.unrest.clear();
        let mut is_sure = false;
        while report.iterations < plan.max_passes {
            if run.is_cancelled() {
                return Ending::Cancelled;
            }
            let pass = self.unrest.len();
            if pass.is_power_of_two() || pass.is_multiple_of(RENEWAL) {
                debug_assert_eq!(self.mesh.check(), Ok(()));
                if !self.mesh.keeps_cells(self.n_deferred) {
                    self.cells = self.mesh.cells();
                }
            }
            let work = match plan.schedule {
                Schedule::InTurn => self.pass(rule, plan.order, Random::derived(plan.seed, report.iterations), run),
                Schedule::Summed => Some(summed_pass(&mut self.mesh, rule)),
            };
            let Some(work) = work else { return Ending::Cancelled };
            report.iterations += 1;
            report.visits += work.n_visits;
            report.flips += work.n_flips;
            report.stable_share.push(1.0 - work.n_unstable as f64 / self.mesh.n_points() as f64);
            self.unrest.push(work.unrest.squares / self.mesh.n_points() as f64);
            if plan.keeps_best {
                self.keep_best(&work, report.iterations);
            }
            self.show(plan, run, report);
            // Flips, and visits put off halfway, leave dirt that the pass has not seen.
            let is_still = work.n_unstable == 0 && (0..self.mesh.n_points() as u32).all(|v| !self.mesh.is_dirty(v));
            let n_late_flips = if is_still { self.mesh.legalize() } else { 0 };
            report.flips += n_late_flips;
            // Points that a density's edge has put nearly on one line may have no triangulation: what is best so far counts then.
            let Ok(was_torn) = self.mesh.mend() else { return Ending::Stuck };
            if was_torn {
                report.triangulations += 1;
                self.cells = self.mesh.cells();
            }
            if is_still && n_late_flips == 0 && !was_torn {
                // A point may see others than its neighbours in the mesh, and have been clean while they moved.
                if is_sure || !self.mesh.sees_beyond() {
                    return Ending::Converged;
                }
                self.mesh.soil_all();
                is_sure = true;
            } else {
                is_sure = false;
            }
            if plan.ends_if_diverging && self.is_diverging() {
                return Ending::Diverging;
            }
            let n_worse = report.iterations - self.best.pass;
            if plan.ends_if_stuck && n_worse > LONG.max(self.best.pass) {
                return Ending::Stuck;
            }
        }
        Ending::PassLimit
    }

    /// Visits what is dirty: cell by cell, colour by colour, then what reaches too far. `None` if cancelled on the way.
    fn pass(&mut self, rule: &impl Rule, order: Order, seed: u64, run: &RunContext) -> Option<Work> {
        let mut total = Work::default();
        for colour in self.cells.colours() {
            if run.is_cancelled() {
                return None;
            }
            let cells = colour.par_iter();
            let done: Vec<Work> = cells
                .map_init(|| G::Buffer::sensing(rule.senses()), |buffer, &cell| self.visit_cell(rule, cell, order, seed, buffer))
                .collect();
            done.iter().for_each(|work| total.add(work));
        }
        let deferred = std::mem::take(&mut total.deferred);
        self.n_deferred = deferred.len();
        total.add(&self.visit_all(rule, &deferred, G::EVERYTHING, &mut G::Buffer::sensing(rule.senses())));
        Some(total)
    }

    fn visit_cell(&self, rule: &impl Rule, cell: u32, order: Order, seed: u64, buffer: &mut G::Buffer) -> Work {
        let mut dirty: Vec<u32> = self.cells.members(cell).iter().copied().filter(|&v| self.mesh.is_dirty(v)).collect();
        match order {
            Order::Shuffled => Random::new(seed, u64::from(cell)).shuffle(&mut dirty),
            Order::Rows => self.mesh.sort_by_rows(&mut dirty, 0.5),
        }
        self.visit_all(rule, &dirty, self.cells.territory(cell), buffer)
    }

    fn visit_all(&self, rule: &impl Rule, points: &[u32], territory: G::Territory, buffer: &mut G::Buffer) -> Work {
        let mut work = Work::default();
        let n_flips = buffer.n_flips();
        let is_plain = G::MAY_BE_PLAIN && self.mesh.is_plain();
        for &v in points {
            let visited = match is_plain {
                true if G::MAY_BE_PLAIN => visit::<_, _, true>(&self.mesh, rule, v, territory, buffer),
                _ => visit::<_, _, false>(&self.mesh, rule, v, territory, buffer),
            };
            match visited {
                Ok(unrest) => work.count(unrest),
                Err(_) => work.deferred.push(v),
            }
        }
        work.n_flips = buffer.n_flips() - n_flips;
        work
    }

    fn keep_best(&mut self, work: &Work, pass: usize) {
        // The longest move that was asked for is about the worst miss; but while points find their places, the rest counts as well. Where the density varies
        // the worst spot may be one where targets cannot be met: the rest alone counts.
        let worst = if self.mesh.has_density() { work.unrest.squares.sqrt() } else { work.unrest.longest };
        let wrong = worst * work.unrest.squares.sqrt();
        if wrong < BETTER * self.best.wrong || work.unrest.is_none() {
            self.best = Best { wrong, pass, state: self.mesh.state() };
        }
    }

    fn is_diverging(&self) -> bool {
        let last = &self.unrest[self.unrest.len().saturating_sub(WINDOW)..];
        self.unrest.len() > PATIENCE && last.iter().sum::<f64>() > RESTLESS * WINDOW as f64
    }

    /// The best state, if the sweep goes on with another rule: all points are visited again.
    pub fn change_rule(&mut self, n_passes: usize) -> G::State {
        self.mesh.soil_all();
        std::mem::replace(&mut self.best, Best::start(&self.mesh, n_passes)).state
    }

    /// Goes back to the best state.
    pub fn return_to_best(&mut self) -> Result<(), Error> {
        self.mesh.restore(self.best.state.clone())
    }

    pub fn n_points(&self) -> usize {
        self.mesh.n_points()
    }

    pub fn ground_mut(&mut self) -> &mut G {
        &mut self.mesh
    }

    /// The mesh as it is.
    pub fn into_mesh(self) -> G {
        self.mesh
    }

    /// Unstable points become fewer about exponentially.
    fn show(&mut self, plan: &Plan, run: &mut RunContext, report: &Report) {
        let n_points = self.mesh.n_points() as f64;
        let stable_share = report.stable_share.last().copied();
        let n_unstable = n_points * (1.0 - stable_share.unwrap_or(0.0));
        let of_passes = report.iterations as f64 / plan.total_passes as f64;
        self.fraction = self.fraction.max(1.0 - libm::log(1.0 + n_unstable) / libm::log(1.0 + n_points)).max(of_passes);
        run.show(|| self.mesh.shown());
        run.report(Progress { phase: Phase::Optimize, iteration: report.iterations, energy: None, stable_share, fraction: self.fraction });
    }
}

impl Sweep {
    /// The caller's index of each point, and its place in the best state.
    pub fn into_best(self) -> (Vec<u32>, Vec<DVec2>) {
        (self.mesh.into_order(), self.best.state)
    }

    /// As [`LiveMesh::distances`].
    ///
    /// # Errors
    /// As there.
    pub fn distances(&mut self) -> Result<Distances, Error> {
        self.mesh.distances()
    }

    /// The places of the points, as the mesh has them.
    pub fn places(&self) -> Vec<DVec2> {
        self.mesh.points()
    }

    /// The caller's index of each point, and its place in the last state.
    pub fn into_last(self) -> (Vec<u32>, Vec<DVec2>) {
        let places = self.mesh.points();
        (self.mesh.into_order(), places)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::points::{PointSet, hilbert_order};
    use crate::star::Star;
    use crate::{CancelToken, Rectangle, Space, Torus, measure, white};

    /// Each point goes half the way to the mean of its neighbours: a rule that knows nothing of pushing and pulling.
    struct Smooth;

    impl Rule for Smooth {
        fn visit(&self, star: &mut Star) -> bool {
            let share = 0.5 / star.n_spokes() as f64;
            star.weights.resize(star.n_spokes(), share);
            true
        }
    }

    fn sweep(points: &PointSet) -> Sweep {
        let (domain, positions) = points.normalized();
        let order = hilbert_order(&positions, domain.size);
        let sorted = order.iter().map(|&index| positions[index as usize]).collect();
        Sweep::new(LiveMesh::new(&domain, None, sorted, order, domain.hex_spacing(positions.len())).unwrap())
    }

    fn smooth(space: &Space, schedule: Schedule, n_threads: usize) -> (PointSet, Report) {
        let mut points = white(space, 3000, 5).unwrap();
        let plan = Plan { schedule, keeps_best: true, ..Plan::of_passes(30, 1) };
        let mut report = Report::new("smooth", 3000);
        let mut sweep = sweep(&points);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().unwrap();
        let ending = pool.install(|| sweep.run(&Smooth, &plan, &mut RunContext::default(), &mut report));
        assert_eq!((ending, report.iterations), (Ending::PassLimit, 30));
        let (order, places) = sweep.into_best();
        points.place(&points.space().domain(), &order, &places);
        (points, report)
    }

    #[test]
    fn another_rule_runs_in_every_space_with_the_same_bits_on_any_threads() {
        let spaces: [Space; 2] =
            [Torus::new([0.0, 0.0], [1.0, 1.0]).unwrap().into(), Rectangle::new([0.0, 0.0], [5.0, 1.0]).unwrap().into()];
        for space in spaces {
            for schedule in [Schedule::InTurn, Schedule::Summed] {
                let one = smooth(&space, schedule, 1);
                assert!(smooth(&space, schedule, 3) == one);
                let before = measure(&white(&space, 3000, 5).unwrap()).unwrap();
                let after = measure(&one.0).unwrap();
                assert!(after.angle_rms_deg < 0.5 * before.angle_rms_deg, "{} {}", after.angle_rms_deg, before.angle_rms_deg);
            }
        }
    }

    #[test]
    fn a_sweep_that_is_cancelled_at_once_leaves_the_points_where_they_are() {
        let points = white(Torus::new([0.0, 0.0], [1.0, 1.0]).unwrap(), 100, 2).unwrap();
        let cancel = CancelToken::default();
        cancel.cancel();
        let mut sweep = sweep(&points);
        let mut report = Report::new("smooth", 100);
        let plan = Plan { keeps_best: true, ..Plan::of_passes(9, 0) };
        let ending = sweep.run(&Smooth, &plan, &mut RunContext::default().with_cancel(cancel), &mut report);
        assert_eq!((ending, report.iterations), (Ending::Cancelled, 0));
        let mut after = points.clone();
        let (order, places) = sweep.into_best();
        after.place(&points.space().domain(), &order, &places);
        assert_eq!(after, points);
    }
}
