//! Cells so small that each holds one point at most: who is near, and whose dart falls first.

use std::sync::Arc;

use glam::DVec2;

use crate::space::{Boundary, Domain};

/// A grid of cells so small that each holds one point at most; around it, as far as disks reach, on a torus copies, and in a rectangle nothing.
pub(super) struct Cells {
    pub domain: Domain,
    /// What hides points from each other, if anything does.
    pub walls: Option<Arc<Boundary>>,
    pub side: DVec2,
    /// Cells of the domain along each axis, and how many more stand on each side.
    n_own: [usize; 2],
    margin: [usize; 2],
    stride: usize,
    /// The point in each cell, NaN where there is none.
    pub points: Vec<DVec2>,
    /// When a dart is thrown next; infinite where all is covered.
    pub clocks: Vec<f32>,
    /// From a cell to those whose points may be nearer than the larger radius to one of its own.
    around: Vec<isize>,
}

/// From a cell to those beside it.
const BESIDE: [[isize; 2]; 8] = [[-1, -1], [0, -1], [1, -1], [-1, 0], [1, 0], [-1, 1], [0, 1], [1, 1]];

impl Cells {
    pub fn new(domain: &Domain, is_visible: bool, spacing: f64, reach: f64) -> Self {
        let n_own = (domain.size * (std::f64::consts::SQRT_2 / spacing)).ceil().max(DVec2::ONE);
        let side = domain.size / n_own;
        let n_own = n_own.to_array().map(|n| n as usize);
        let margin = (reach / side).ceil().to_array().map(|n| n as usize);
        // In a rectangle nothing lies further than its far side.
        let margin = if domain.is_periodic { margin } else { [margin[0].min(n_own[0]), margin[1].min(n_own[1])] };
        let stride = n_own[0] + 2 * margin[0];
        let n_cells = stride * (n_own[1] + 2 * margin[1]);
        let [width, height] = margin.map(|n| n as isize);
        // The nearest places of two cells that stand so far apart.
        let gap = |cells: isize, side: f64| (cells.abs() - 1).max(0) as f64 * side;
        let around = (-height..=height).flat_map(|y| (-width..=width).map(move |x| [x, y]));
        let around = around.filter(|&[x, y]| [x, y] != [0, 0] && libm::hypot(gap(x, side.x), gap(y, side.y)) < reach);
        // The nearest first: their disks cover most.
        let mut around: Vec<[isize; 2]> = around.collect();
        around.sort_by_key(|[x, y]| x * x + y * y);
        let around = around.into_iter().map(|[x, y]| x + y * stride as isize).collect();
        let (points, clocks) = (vec![DVec2::NAN; n_cells], vec![f32::INFINITY; n_cells]);
        let walls = domain.boundary.clone().filter(|_| is_visible);
        Self { domain: domain.clone(), walls, side, n_own, margin, stride, points, clocks, around }
    }

    /// Whether no wall stands between two places.
    pub fn sees(&self, a: DVec2, b: DVec2) -> bool {
        self.walls.as_ref().is_none_or(|boundary| boundary.sees(a, b))
    }

    /// The cells of the domain, row by row.
    pub fn own(&self) -> impl Iterator<Item = usize> + use<> {
        let (Self { margin, stride, .. }, [width, height]) = (self, self.n_own);
        let (first, stride) = (margin[0] + margin[1] * stride, *stride);
        (0..height).flat_map(move |row| first + row * stride..first + row * stride + width)
    }

    /// Column and row in the domain; of a copy, beyond it.
    #[inline]
    fn place(&self, cell: usize) -> [isize; 2] {
        let (cell, stride) = (cell as u32, self.stride as u32);
        [(cell % stride) as isize - self.margin[0] as isize, (cell / stride) as isize - self.margin[1] as isize]
    }

    /// The lower left corner of a cell.
    #[inline]
    pub fn corner(&self, cell: usize) -> DVec2 {
        let [column, row] = self.place(cell);
        DVec2::new(column as f64, row as f64) * self.side
    }

    /// What stands in the cells around, NaN where nothing does.
    #[inline]
    pub fn around(&self, cell: usize) -> impl ExactSizeIterator<Item = DVec2> {
        self.around.iter().map(move |&by| self.points[(cell as isize + by) as usize])
    }

    /// A cell around whose dart falls earlier, if there is one.
    #[inline]
    pub fn earlier(&self, cell: usize) -> Option<usize> {
        let time = self.clocks[cell];
        let mut others = self.around.iter().map(|&by| (cell as isize + by) as usize);
        others.find(|&other| self.clocks[other] < time && time < f32::INFINITY).map(|other| self.original(other))
    }

    /// The cell that holds a place of the domain.
    pub fn at(&self, place: DVec2) -> usize {
        let [column, row] = (place / self.side).as_uvec2().to_array().map(|n| n as usize);
        // On the far side, or next to it, rounding may be one cell off.
        let [column, row] = [column.min(self.n_own[0] - 1), row.min(self.n_own[1] - 1)];
        column + self.margin[0] + (row + self.margin[1]) * self.stride
    }

    /// Puts a point into its cell; cells beside it that lie within the root of `coverage` of it throw no more darts.
    pub fn put(&mut self, point: DVec2, coverage: f64) {
        let cell = self.at(point);
        self.points[cell] = point;
        self.copies(cell).for_each(|(copy, period)| self.points[copy] = point + period);
        self.set_clock(cell, f32::INFINITY);
        let (half, centre) = (0.5 * self.side, self.corner(cell) + 0.5 * self.side);
        for [x, y] in BESIDE {
            let to_far_side = (centre + DVec2::new(x as f64, y as f64) * self.side - point).abs() + half;
            let beside = (cell as isize + x + y * self.stride as isize) as usize;
            let is_seen = self.walls.as_ref().is_none_or(|boundary| boundary.clearance(point) * boundary.clearance(point) > coverage);
            if is_seen && to_far_side.length_squared() <= coverage && self.clocks[beside] < f32::INFINITY {
                self.set_clock(self.original(beside), f32::INFINITY);
            }
        }
    }

    #[inline]
    pub fn set_clock(&mut self, cell: usize, time: f32) {
        self.clocks[cell] = time;
        self.copies(cell).for_each(|(copy, _)| self.clocks[copy] = time);
    }

    /// The cell of the domain that this one is, or is a copy of.
    fn original(&self, cell: usize) -> usize {
        let [x, y] = self.place(cell);
        let [width, height] = self.n_own.map(|n| n as isize);
        (x.rem_euclid(width) as usize + self.margin[0]) + (y.rem_euclid(height) as usize + self.margin[1]) * self.stride
    }

    /// The copies of a cell of the domain, and the periods to them.
    #[inline]
    fn copies(&self, cell: usize) -> impl Iterator<Item = (usize, DVec2)> + use<> {
        let &Self { n_own, margin, stride, .. } = self;
        let (is_periodic, size) = (self.domain.is_periodic, self.domain.size);
        let place = self.place(cell);
        // In periods, from the first copy beyond the near side to the last beyond the far one.
        let periods = |axis: usize| {
            let [n, margin] = [n_own[axis], margin[axis]].map(|n| n as isize);
            if is_periodic { -((place[axis] + margin) / n)..=(n + margin - 1 - place[axis]) / n } else { 0..=0 }
        };
        let (columns, rows) = (periods(0), periods(1));
        let all = rows.flat_map(move |y| columns.clone().map(move |x| [x, y])).filter(|&periods| periods != [0, 0]);
        all.map(move |[x, y]| {
            let by = x * n_own[0] as isize + y * (n_own[1] * stride) as isize;
            ((cell as isize + by) as usize, DVec2::new(x as f64, y as f64) * size)
        })
    }
}
