//! A kd warp: takes the long density waves out of any points, in O(n log n).
//!
//! The domain is halved again and again, and every part is mapped linearly onto a cell whose area is its share of the points.
//! Large parts are cut in their middle, so that even points stay where they are. The last sixteen points are divided by rank
//! into cells of one point each: white noise becomes much like a jittered grid, but without its long order,
//! which would outlive an optimiser as sharp peaks in the spectrum.
//!
//! Where a density is wanted, cells have a share of its mass in place of the area: points that follow it stay about where they are, and others come to.

use glam::DVec2;
use rayon::prelude::*;

use super::point_set::PointSet;
use super::random::Random;
use crate::density::Field;

/// Groups of up to this many points are divided by rank. More of them in a row would keep step like a grid.
const BLOCK: usize = 16;
/// How far the last points keep from the middle of square cells, of what chance has it: 1 jitters fully, 0 not at all.
const JITTER: f64 = 0.85;
/// Groups larger than this are divided on another thread.
const PARALLEL: usize = 1 << 15;

/// The cells that the last points get.
#[derive(Clone, Copy, PartialEq)]
enum Cells {
    Square,
    Random,
}

type Indexed = (DVec2, u32);

/// How a group is mapped.
#[derive(Clone, Copy)]
struct Plan<'a> {
    cells: Cells,
    /// The density that is wanted, where it varies.
    field: Option<&'a Field>,
}

impl Plan<'_> {
    /// Where a cell is to be cut so that this share of it lies below.
    fn cut(self, cell: Cell, axis: usize, share: f64) -> f64 {
        let by_area = || cell.low[axis] + share * cell.size()[axis];
        self.field.map_or_else(by_area, |field| field.cut(cell.low, cell.high, axis, share))
    }
}

/// A box.
#[derive(Clone, Copy)]
struct Cell {
    low: DVec2,
    high: DVec2,
}

impl Cell {
    /// The part below `high` along `axis`, and the part above `low`.
    fn parts(self, axis: usize, high: f64, low: f64) -> [Self; 2] {
        let (mut lower, mut upper) = (self, self);
        lower.high[axis] = high;
        upper.low[axis] = low;
        [lower, upper]
    }

    fn size(self) -> DVec2 {
        self.high - self.low
    }
}

/// Spreads the points evenly over the domain: every part gets area, or mass of the density that is wanted, in proportion to its points. Fewer than three stay, and
/// those of a polygon.
///
/// The last points get nearly square cells. An optimiser keeps some of their alignment: the main ring of the power spectrum is then 1.2 to
/// 1.4 times as strong along the axes as on average. [`warp_isotropic`] prefers no direction.
pub fn warp(points: &mut PointSet) {
    warp_into(points, Cells::Square);
}

/// As [`warp`], but the last points get cells of chance proportions, so that no direction is preferred; the start is slightly less even.
pub fn warp_isotropic(points: &mut PointSet) {
    warp_into(points, Cells::Random);
}

fn warp_into(points: &mut PointSet, cells: Cells) {
    if points.n_points() < 3 || points.space().region().is_some() {
        return;
    }
    let (domain, positions) = points.normalized();
    let field = points.field(&domain);
    let plan = Plan { cells, field: field.as_ref() };
    let mut indexed: Vec<Indexed> = positions.into_iter().zip(0..).collect();
    let cell = Cell { low: DVec2::ZERO, high: domain.size };
    warp_group(&mut indexed, plan, cell, cell);
    let order: Vec<u32> = indexed.iter().map(|&(_, index)| index).collect();
    let moved: Vec<DVec2> = indexed.par_iter().map(|&(p, _)| domain.land(p)).collect();
    points.place(&domain, &order, &moved);
}

/// Maps the points of `source` onto `target`.
fn warp_group(points: &mut [Indexed], plan: Plan, source: Cell, target: Cell) {
    let n = points.len();
    if let [(p, _)] = points {
        // A source without width holds coincident coordinates: its point goes to the middle.
        let share = (*p - source.low) / source.size();
        let share = DVec2::select(share.is_finite_mask(), share, DVec2::splat(0.5)).clamp(DVec2::ZERO, DVec2::ONE);
        let jitter = if plan.cells == Cells::Square { JITTER } else { 1.0 };
        *p = target.low + (0.5 + jitter * (share - 0.5)) * target.size();
        return;
    }
    if n == 0 {
        return;
    }
    let axis = long_axis(source.size(), target.size());
    let (n_below, sources) = if n > BLOCK {
        cut_in_the_middle(points, plan, source, axis)
    } else {
        cut_by_rank(points, share_below(points, plan.cells, target.size(), axis), source, axis)
    };
    let boundary = plan.cut(target, axis, n_below as f64 / n as f64);
    let targets = target.parts(axis, boundary, boundary);
    let (below, above) = points.split_at_mut(n_below);
    let mut lower = || warp_group(below, plan, sources[0], targets[0]);
    let mut upper = || warp_group(above, plan, sources[1], targets[1]);
    if n > PARALLEL {
        rayon::join(lower, upper);
    } else {
        lower();
        upper();
    }
}

/// The axis to cut across: the longer side of the target; of a nearly square one that of the source, so that neither axis is preferred.
fn long_axis(source: DVec2, target: DVec2) -> usize {
    let is_square = target.max_element() < 1.5 * target.min_element();
    let size = if is_square { source } else { target };
    usize::from(size.y > size.x)
}

/// Sorts out the `n_below` lowest points; returns the coordinates of the last of them and of the first above.
fn select(points: &mut [Indexed], n_below: usize, axis: usize) -> [f64; 2] {
    let by_axis = |a: &Indexed, b: &Indexed| a.0[axis].total_cmp(&b.0[axis]).then(a.1.cmp(&b.1));
    let (below, first_above, _) = points.select_nth_unstable_by(n_below, by_axis);
    [below.iter().map(|(p, _)| p[axis]).fold(f64::MIN, f64::max), first_above.0[axis]]
}

/// Divides a group at the middle of its source; where that leaves too few on one side, by rank, so that the depth is bounded.
fn cut_in_the_middle(points: &mut [Indexed], plan: Plan, source: Cell, axis: usize) -> (usize, [Cell; 2]) {
    let middle = plan.cut(source, axis, 0.5);
    let found = points.iter().filter(|(p, _)| p[axis] < middle).count();
    let n_below = found.clamp(points.len() / 4, points.len() - points.len() / 4);
    let [last_below, first_above] = select(points, n_below, axis);
    let boundary = if n_below == found { middle } else { 0.5 * (last_below + first_above) };
    (n_below, source.parts(axis, boundary, boundary))
}

/// The share of a small group that goes below the cut: two to three fifths by chance, or, as if its points stood in columns of square
/// cells, half of the columns.
fn share_below(points: &[Indexed], cells: Cells, target: DVec2, axis: usize) -> f64 {
    match cells {
        Cells::Random => {
            // Chance lies in the points, whatever their order.
            let bits = points.iter().fold(0, |bits, (p, _)| bits ^ p.x.to_bits() ^ p.y.to_bits().rotate_left(32));
            0.4 + 0.2 * Random::new(bits, 5).unit()
        }
        Cells::Square => {
            let n_columns = (points.len() as f64 * target[axis] / target[1 - axis]).sqrt().round().max(2.0);
            (n_columns / 2.0).floor() / n_columns
        }
    }
}

/// Divides a small group by rank: this share below, and the others above.
///
/// Uniform points stay uniform in both sources, and those of one half do not depend on the other's: the two would crowd at
/// their common boundary otherwise.
fn cut_by_rank(points: &mut [Indexed], share: f64, source: Cell, axis: usize) -> (usize, [Cell; 2]) {
    let n = points.len();
    let n_below = ((n as f64 * share).round() as usize).clamp(1, n - 1);
    let [_, first_above] = select(points, n_below, axis);
    // Given the first point above, those below are uniform up to it; those above are stretched so that it comes where
    // the first of as many uniform points would.
    let (low, width) = (source.low[axis], source.size()[axis].max(f64::MIN_POSITIVE));
    let first = (first_above - low) / width;
    let stretch = (1.0 - freed_minimum(first, n_below, n)) / (1.0 - first).max(f64::MIN_POSITIVE);
    for (p, _) in &mut points[n_below..] {
        p[axis] = low + width * (1.0 - stretch * (1.0 - (p[axis] - low) / width));
    }
    let [lower, _] = source.parts(axis, first_above, first_above);
    (n_below, [lower, source])
}

/// Of `n` sorted uniform numbers, takes the one with `n_below` below it, and gives the smallest of `n - n_below` uniform numbers that do
/// not depend on those below: equal in distribution function, which is a binomial tail.
fn freed_minimum(x: f64, n_below: usize, n: usize) -> f64 {
    let mut choose = 1.0;
    let mut at_most_below = 0.0;
    for j in 0..=n_below {
        at_most_below += choose * x.powi(j as i32) * (1.0 - x).powi((n - j) as i32);
        choose *= (n - j) as f64 / (j + 1) as f64;
    }
    1.0 - libm::pow(at_most_below, 1.0 / (n - n_below) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Torus, white};

    #[test]
    fn the_freed_minimum_of_two_is_the_square() {
        for x in [0.0, 0.3, 0.9, 1.0] {
            assert!((freed_minimum(x, 1, 2) - x * x).abs() < 1e-12);
        }
    }

    #[test]
    fn every_block_of_the_domain_gets_its_share_of_any_points() {
        // Dense in one corner.
        let torus = Torus::new([0.0, 0.0], [1.0, 1.0]).unwrap();
        let skewed = white(torus, 4096, 1).unwrap().positions().iter().map(|p| p.map(|x| x * x * x)).collect();
        let points = PointSet::new(torus, skewed).unwrap();
        for cells in [Cells::Square, Cells::Random] {
            let mut warped = points.clone();
            warp_into(&mut warped, cells);
            let mut counts = [0usize; 64];
            for p in warped.positions() {
                counts[(8.0 * p[0]) as usize + 8 * (8.0 * p[1]) as usize] += 1;
            }
            assert!(counts.iter().all(|&n| n.abs_diff(64) <= 16), "{counts:?}");
        }
    }
}
