//! Maximal Poisson-disk sampling: random points, no two nearer than a spacing, no place farther from all of them than that.
//!
//! Ebeida, Mitchell, Patney, Davidson and Owens, "A Simple Algorithm for Maximal Poisson-Disk Sampling in High Dimensions", Computer Graphics Forum 31(2),
//! 2012, doi 10.1111/j.1467-8659.2012.03059.x. Cells that can hold one point each are divided like quadtrees; the squares that one disk covers
//! are left out, and darts fall on the rest, until nothing is left. With two radii after Mitchell, Rand, Ebeida and Bajaj, "Variable Radii Poisson-Disk
//! Sampling", Canadian Conference on Computational Geometry, 2012.
//!
//! What differs from the paper, and why: it throws darts at the whole domain, level by level. Here each cell has a clock that rings at a rate
//! proportional to the area of its squares, and a cell may throw once no cell around it has an earlier time. The points are distributed as those of darts
//! thrown one after the other at the whole domain, but are found in the order in which memory lies.
//!
//! Cost: O(n). The result is maximal to within 1e-13 of the spacing, or to what coordinates far from 0 are rounded by. In a polygon the cells of the frame are
//! gone through, so its parts should not lie far from each other; in passages narrower than a 64th of a cell, and where walls hide points, on the far side of those that are thinner than the spacing,
//! a point may be missing.

mod cells;

use std::collections::HashSet;
use std::sync::Arc;

use glam::DVec2;

use self::cells::Cells;
use super::eliminate::eliminate;
use super::point_set::{MAX_POINTS, PointSet};
use super::random::Random;
use crate::error::Error;
use crate::space::{Boundary, Domain, GRID, Space, snap};

/// What [`poisson_disk`] can be told.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoissonDiskParams {
    /// No two points are nearer to each other than this, in input units. On a torus at most its shorter side.
    pub spacing: f64,
    /// No place is farther from all points than this, in input units; `spacing` or more. `None` for `spacing` itself: more makes points fewer, and
    /// more random.
    pub coverage: Option<f64>,
    /// Whether a polygon's boundary hides points from each other: distances and coverage then count
    /// between places that see each other alone.
    pub is_visible: bool,
    /// The same seed gives the same points.
    pub seed: u64,
}

/// The coverage radius is at most so many times the spacing: all points in its reach are looked at for each dart.
const LOOSEST: f64 = 8.0;

impl PoissonDiskParams {
    /// The spacing with which about `n_points` points fit, and seed 0: on a torus sqrt(0.697 A / n), but no more than its shorter side, in a rectangle a
    /// little more, as its boundary takes more points. How many there will be is chance: in a domain that is many spacings wide with a standard
    /// deviation of 0.23 sqrt(n).
    pub fn for_about(space: &Space, n_points: usize) -> Self {
        // In square roots of the area over n, which do not underflow.
        let unit = space.hex_spacing(n_points.max(1)) * 0.75f64.sqrt().sqrt();
        let boundary = if space.is_periodic() { 0.0 } else { ON_BOUNDARY * space.perimeter() / unit / n_points.max(1) as f64 };
        // n = DENSITY A / spacing^2 + ON_BOUNDARY perimeter / spacing.
        let spacing = unit * 0.5 * (boundary + (boundary * boundary + 4.0 * DENSITY).sqrt());
        let [width, height] = space.size();
        let widest = if space.is_periodic() { width.min(height) } else { f64::INFINITY };
        Self { spacing: spacing.min(widest), coverage: None, is_visible: false, seed: 0 }
    }

    /// Checks the parameters, as [`poisson_disk`] does before it begins.
    ///
    /// # Errors
    /// As there.
    pub fn validate(&self, space: &Space) -> Result<(), Error> {
        let invalid = |name, value: f64, expected| Err(Error::InvalidParameter { name, value: value.to_string(), expected });
        self.validate_spacing()?;
        if space.is_periodic() && self.spacing > f64::min(space.size()[0], space.size()[1]) {
            return invalid("spacing", self.spacing, "at most the torus' shorter side, or a point is too near to itself");
        }
        if let Some(radius) = self.coverage.filter(|&radius| !(radius >= self.spacing && radius <= LOOSEST * self.spacing)) {
            return invalid("coverage", radius, "the spacing or more, and 8 times that at most");
        }
        validate_spacing(space, self.spacing)
    }
}

impl PoissonDiskParams {
    pub(super) fn validate_spacing(&self) -> Result<(), Error> {
        if self.spacing > 0.0 && self.spacing.is_finite() {
            return Ok(());
        }
        Err(Error::InvalidParameter { name: "spacing", value: self.spacing.to_string(), expected: "positive and finite" })
    }
}

/// The points of a maximal set in an area of one squared spacing, and further ones on a boundary as long as the spacing.
const DENSITY: f64 = 0.697;
const ON_BOUNDARY: f64 = 0.228;
/// What rounding may take from a length, relative to it.
const ROUNDING: f64 = 1e-15;

/// Checks that as many points can be made as fit at random with this spacing, positive and finite, in input units.
pub(super) fn validate_spacing(space: &Space, spacing: f64) -> Result<(), Error> {
    let [width, height] = space.size().map(|side| side / spacing);
    let most = DENSITY * width * height * space.fullness() + ON_BOUNDARY * space.perimeter() / spacing;
    // Chance has its way with the last of them.
    if most > 1.001 * MAX_POINTS as f64 {
        return Err(Error::TooManyPoints(most.min(1e15) as usize, MAX_POINTS));
    }
    let resolution = space.resolution();
    if spacing < 64.0 * resolution {
        return Err(Error::TooFine { n_points: most as usize, domain: space.to_string(), spacing, resolution });
    }
    Ok(())
}

/// By which part of itself a spacing must be exceeded, so that rounding to input units brings no points nearer.
pub(super) fn rounding_margin(space: &Space, spacing: f64) -> f64 {
    ROUNDING + 2.0 * space.resolution() / spacing
}

/// Random points that stand in rows of cells: no two nearer than the spacing, and no place of the domain, its boundary included, farther from all of
/// them than the coverage radius.
///
/// # Errors
/// [`Error::InvalidParameter`] for a spacing that is not positive, or more than a torus' shorter side, and for a coverage radius below the spacing;
/// [`Error::TooManyPoints`] and [`Error::TooFine`] for more points than the domain can hold; [`Error::InvalidSpace`] for a polygon that fills next to nothing of its frame.
///
/// # Example
/// ```
/// use evenly::{PoissonDiskParams, Rectangle, measure, poisson_disk};
///
/// let space = Rectangle::new([0.0, 0.0], [1.0, 1.0])?.into();
/// let params = PoissonDiskParams { spacing: 0.02, seed: 7, ..PoissonDiskParams::for_about(&space, 1) };
/// let points = poisson_disk(space, &params)?;
/// let measures = measure(&points)?;
/// assert!(measures.min_distance * measures.hex_spacing >= 0.02 && measures.coverage_radius * measures.hex_spacing <= 0.02);
/// # Ok::<(), evenly::Error>(())
/// ```
pub fn poisson_disk(space: impl Into<Space>, params: &PoissonDiskParams) -> Result<PointSet, Error> {
    poisson_disk_around(&PointSet::new(space, Vec::new())?, params)
}

/// As [`poisson_disk`], in the space of points that are there already, and stay: they come first.
///
/// # Errors
/// As there; [`Error::InvalidParameter`] also for a spacing that is more than the distance of two of these points.
pub fn poisson_disk_around(points: &PointSet, params: &PoissonDiskParams) -> Result<PointSet, Error> {
    let space = points.space();
    params.validate(space)?;
    let (domain, fixed) = points.normalized();
    require_few_cells(&domain, params.spacing / domain.restore_length(1.0))?;
    let mut darts = Darts::new(space, &domain, params);
    for &point in &fixed {
        darts.put_fixed(point)?;
    }
    for cell in darts.cells.own() {
        darts.finish(cell);
    }
    let cells = &darts.cells;
    let taken: HashSet<[u64; 2]> = fixed.iter().map(|point| point.to_array().map(f64::to_bits)).collect();
    let others = points_in(cells).filter(|point| !taken.contains(&point.to_array().map(f64::to_bits)));
    let others = PointSet::from_normalized(space.clone(), others);
    let all = points.positions().iter().chain(others.positions()).copied().collect();
    PointSet::new(space, all)?.with_density(points.density()).with_fixed(points.n_points())
}

/// Cells fill the frame of a polygon, which may have its parts far from each other.
fn require_few_cells(domain: &Domain, spacing: f64) -> Result<(), Error> {
    const MOST: f64 = 2e8;
    let n_cells = 2.0 * domain.size.x / spacing * (domain.size.y / spacing);
    if domain.boundary.is_some() && n_cells > MOST {
        let text =
            format!("maximal sets take {n_cells:.1e} cells here, as the polygon fills so little of its frame: sample its parts one by one");
        return Err(Error::InvalidSpace(text));
    }
    Ok(())
}

fn points_in(cells: &Cells) -> impl Iterator<Item = DVec2> {
    cells.own().map(|cell| cells.points[cell]).filter(|point| !point.is_nan())
}

/// Exactly `n_points` points that are a maximal Poisson-disk sample but for a few gaps: of a slightly denser one those go that are most crowded.
/// In progressive order, as [`eliminate`] leaves them.
///
/// # Errors
/// [`Error::InvalidParameter`] for no points; otherwise as [`poisson_disk`].
pub fn poisson_disk_of(space: impl Into<Space>, n_points: usize, seed: u64) -> Result<PointSet, Error> {
    let space = space.into();
    PointSet::validate(&space, n_points)?;
    // Three standard deviations.
    let mut surplus = 1 + (0.7 * (n_points as f64).sqrt()) as usize;
    loop {
        let points = poisson_disk(&space, &PoissonDiskParams { seed, ..PoissonDiskParams::for_about(&space, n_points + surplus) })?;
        if points.n_points() >= n_points {
            return eliminate(&points, n_points);
        }
        surplus *= 2;
    }
}

/// The state of a sampling.
struct Darts {
    cells: Cells,
    /// In input units.
    spacing: f64,
    /// How often each cell's squares have been divided.
    levels: Vec<u8>,
    /// The squares that no disk covered when they were divided last, a bit each, in rows of eight; of a level beyond [`KEPT`], those of that one.
    squares_kept: Vec<u64>,
    /// Their area, in cells: it sets the pace of the clock.
    areas: Vec<f32>,
    random: Random,
    /// Squared: a little more than the spacing, so that rounding takes nothing away.
    conflict: f64,
    /// Squared: a little less than the coverage radius.
    coverage: f64,
    /// By how much the coverage radius is larger than the spacing: a point that is displaced by less covers where it was.
    slack: f64,
    /// Squares are divided no more often: what they hold is lost in rounding.
    max_level: u8,
    /// Cells that wait for the one behind them.
    waiting: Vec<usize>,
    /// Points near the cell at hand.
    near: Vec<DVec2>,
    /// The centres of its squares.
    squares: Vec<DVec2>,
    divided: Vec<DVec2>,
}

/// Squares smaller than this part of the spacing are taken for covered.
const SMALLEST: f64 = 1e-13;
/// The last level whose squares are kept: they are eight in a row.
const KEPT: u8 = 3;
/// From this level on a square is what its centre is: outside, or seen by who sees that. In passages that are narrower there may be no points.
const FINE: u8 = 6;
/// From this level on it is seen by all that are near.
const FINEST: u8 = 16;
const BEFORE: f64 = 1e-6;
/// So often another place is tried before a point is put where the dart fell.
const TRIES: usize = 100;

impl Darts {
    fn new(space: &Space, domain: &Domain, params: &PoissonDiskParams) -> Self {
        let scale = 1.0 / domain.restore_length(1.0);
        let spacing = params.spacing * scale;
        let coverage = params.coverage.unwrap_or(params.spacing) * scale;
        let margin = rounding_margin(space, params.spacing);
        let slack = (coverage - spacing) * (1.0 - ROUNDING);
        let cells = Cells::new(domain, params.is_visible, spacing, (coverage + slack) * (1.0 + margin));
        let n_cells = cells.points.len();
        let mut darts = Self {
            cells,
            spacing: params.spacing,
            levels: vec![0; n_cells],
            squares_kept: vec![1; n_cells],
            areas: vec![1.0; n_cells],
            random: Random::new(params.seed, 2),
            conflict: (spacing * (1.0 + margin)).powi(2),
            coverage: (coverage * (1.0 - ROUNDING) - GRID).powi(2),
            slack,
            max_level: -libm::log2(margin.max(SMALLEST).max(GRID / spacing)) as u8,
            waiting: Vec::new(),
            near: Vec::new(),
            squares: Vec::new(),
            divided: Vec::new(),
        };
        for cell in darts.cells.own() {
            let corner = darts.cells.corner(cell);
            let is_outside = darts.is_outside(corner + 0.5 * darts.cells.side, 0.5 * darts.cells.side, 0);
            darts.wind(cell, 0.0, if is_outside { 0.0 } else { 1.0 });
        }
        darts
    }

    /// Puts a point where it is.
    fn put_fixed(&mut self, point: DVec2) -> Result<(), Error> {
        let cell = self.cells.at(point);
        if !self.cells.points[cell].is_nan() || !self.is_farther(cell, point, self.conflict) {
            return Err(Error::InvalidParameter {
                name: "spacing",
                value: self.spacing.to_string(),
                expected: "at most the distance of points that stay",
            });
        }
        self.cells.put(point, self.coverage);
        Ok(())
    }

    /// Throws darts at a cell until it is covered, and at those around it as their time comes.
    // By itself it has registers enough: within its caller it is slower.
    #[inline(never)]
    fn finish(&mut self, cell: usize) {
        while self.cells.clocks[cell] < f32::INFINITY {
            self.waiting.push(cell);
            while let Some(&cell) = self.waiting.last() {
                match self.cells.earlier(cell) {
                    Some(earlier) => self.waiting.push(earlier),
                    None => {
                        self.waiting.pop();
                        self.throw(cell);
                    }
                }
            }
        }
    }

    /// Throws a dart at one of a cell's squares; where it is too near to a point, divides them and winds the clock again.
    fn throw(&mut self, cell: usize) {
        let (mut level, time) = (self.levels[cell], self.cells.clocks[cell]);
        if time == f32::INFINITY {
            // While the cell waited, a displaced point has come into it.
            return;
        }
        self.find_squares(cell, level);
        // Since the clock was wound, disks may have covered some squares that are not kept.
        let is_on_square = level <= KEPT || f64::from(self.areas[cell]) * self.random.unit() < self.area(level);
        if is_on_square {
            let dart = self.dart(level);
            let is_inside = self.cells.domain.boundary.as_ref().is_none_or(|boundary| boundary.contains(dart));
            if is_inside && self.is_farther(cell, dart, self.conflict.max(self.coverage)) {
                let point = self.displaced(cell, dart);
                self.cells.put(point, self.coverage);
                if self.cells.clocks[cell] < f32::INFINITY {
                    self.wind(cell, time, self.area(level));
                }
                return;
            }
            self.find_near(cell);
            self.divide(level);
            level += 1;
            self.levels[cell] = level;
            if level <= KEPT {
                self.keep_squares(cell, level);
            }
        }
        self.wind(cell, time, if level > self.max_level { 0.0 } else { self.area(level) });
    }

    /// A place in one of the squares.
    fn dart(&mut self, level: u8) -> DVec2 {
        let square = self.squares[(self.random.unit() * self.squares.len() as f64) as usize];
        let x = self.random.signed();
        snap(square + 0.5 * self.side(level) * DVec2::new(x, self.random.signed()))
    }

    /// Whether all of a square lies beyond a boundary; of a small one its centre.
    fn is_outside(&self, centre: DVec2, half: DVec2, level: u8) -> bool {
        let is = |boundary: &Arc<Boundary>| {
            if level >= FINE { !boundary.contains(snap(centre)) } else { boundary.is_outside(centre - half, centre + half) }
        };
        self.cells.domain.boundary.as_ref().is_some_and(is)
    }

    /// Whether a point sees a square: all of it, or of a small one what matters.
    fn is_seen(&self, point: DVec2, centre: DVec2, half: DVec2, level: u8) -> bool {
        self.cells.walls.as_ref().is_none_or(|boundary| {
            let is_open = !boundary.reaches(point.min(centre - half), point.max(centre + half));
            // A centre on the boundary itself is seen as what lies before it is.
            is_open || level >= FINE && (level >= FINEST || boundary.sees(point, centre + BEFORE * (point - centre)))
        })
    }

    /// Whether no point is nearer to a place than the root of `squared`.
    fn is_farther(&self, cell: usize, place: DVec2, squared: f64) -> bool {
        // No distance from NaN is below anything.
        let is_near = |point: DVec2| point.distance_squared(place) < squared;
        let mut around = self.cells.around(cell);
        match self.cells.walls {
            None => !around.any(is_near),
            Some(_) => !around.any(|point| is_near(point) && self.cells.sees(point, place)),
        }
    }

    /// A place that covers the dart's, and is not too near to a point.
    fn displaced(&mut self, cell: usize, dart: DVec2) -> DVec2 {
        for _ in 0..if self.slack > 0.0 { TRIES } else { 0 } {
            let x = self.random.signed();
            let by = DVec2::new(x, self.random.signed());
            let place = snap(dart + self.slack * by);
            let is_inside = self.cells.domain.is_periodic || self.cells.domain.contains(place);
            if by.length_squared() <= 1.0 && is_inside && self.is_farther(cell, place, self.conflict) {
                return self.cells.domain.land(place);
            }
        }
        dart
    }

    /// Sets a cell's clock to when a dart falls next on so much area; never, on none.
    fn wind(&mut self, cell: usize, time: f32, area: f64) {
        let time = if area > 0.0 { time + (-libm::log(1.0 - self.random.unit()) / area) as f32 } else { f32::INFINITY };
        self.areas[cell] = area as f32;
        self.cells.set_clock(cell, time);
    }

    /// The sides of a square.
    fn side(&self, level: u8) -> DVec2 {
        self.cells.side / (1u64 << level) as f64
    }

    /// The area of the squares, in cells.
    fn area(&self, level: u8) -> f64 {
        self.squares.len() as f64 / ((1u64 << level) as f64).powi(2)
    }

    /// The squares of a cell: as they were kept, and divided from there.
    fn find_squares(&mut self, cell: usize, level: u8) {
        let (corner, side) = (self.cells.corner(cell), self.side(level.min(KEPT)));
        self.squares.clear();
        let mut kept = self.squares_kept[cell];
        while kept != 0 {
            let bit = kept.trailing_zeros();
            self.squares.push(corner + side * (DVec2::new(f64::from(bit & 7), f64::from(bit >> 3)) + 0.5));
            kept &= kept - 1;
        }
        if level > KEPT {
            self.find_near(cell);
        }
        for above in KEPT..level {
            self.divide(above);
        }
    }

    fn keep_squares(&mut self, cell: usize, level: u8) {
        let (corner, side) = (self.cells.corner(cell), self.side(level));
        let bit = |square: &DVec2| {
            let [column, row] = ((*square - corner) / side).as_uvec2().to_array();
            1 << (column | row << 3)
        };
        self.squares_kept[cell] = self.squares.iter().map(bit).sum();
    }

    fn find_near(&mut self, cell: usize) {
        let around = self.cells.around(cell);
        self.near.resize(around.len(), DVec2::NAN);
        let mut n_near = 0;
        // Written whether it is one or not: that is hard to foresee.
        for point in around {
            self.near[n_near] = point;
            n_near += usize::from(!point.is_nan());
        }
        self.near.truncate(n_near);
    }

    /// Divides the squares of a level, and leaves out what one disk covers, and what lies outside.
    fn divide(&mut self, level: u8) {
        let half = 0.5 * self.side(level + 1);
        self.divided.clear();
        for &square in &self.squares {
            for by in [DVec2::NEG_ONE, DVec2::new(1.0, -1.0), DVec2::new(-1.0, 1.0), DVec2::ONE] {
                let centre = square + by * half;
                let is_covered = |near: &DVec2| ((*near - centre).abs() + half).length_squared() <= self.coverage;
                // A loop of its own where nothing hides one place from another: it is most of the work.
                let is_all_covered = match self.cells.walls {
                    None => self.near.iter().any(is_covered),
                    Some(_) => self.near.iter().any(|near| is_covered(near) && self.is_seen(*near, centre, half, level)),
                };
                if !is_all_covered && !self.is_outside(centre, half, level) {
                    self.divided.push(centre);
                }
            }
        }
        std::mem::swap(&mut self.squares, &mut self.divided);
    }
}
