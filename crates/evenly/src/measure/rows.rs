//! Points in rows of cells, for questions about all that is near.

use glam::DVec2;

use crate::space::Domain;

/// Points by the square cell in which they lie, row by row of cells: what is near lies in few stretches of memory.
pub(super) struct Rows {
    domain: Domain,
    n_cells: [usize; 2],
    cell: DVec2,
    /// Where each cell's points begin.
    starts: Vec<u32>,
    places: Vec<DVec2>,
}

impl Rows {
    /// Cells with `points_a_cell` points on average.
    pub fn new(domain: &Domain, positions: &[DVec2], points_a_cell: f64) -> Self {
        let side = (points_a_cell * domain.area() / positions.len() as f64).sqrt();
        let n_cells = (domain.size / side).to_array().map(|n| (n as usize).max(1));
        let cell = domain.size / DVec2::new(n_cells[0] as f64, n_cells[1] as f64);
        let of = |p: DVec2| {
            let [column, row] = (p / cell).to_array().map(|at| at as usize);
            column.min(n_cells[0] - 1) + n_cells[0] * row.min(n_cells[1] - 1)
        };
        let mut starts = vec![0u32; n_cells[0] * n_cells[1] + 1];
        positions.iter().for_each(|&p| starts[of(p) + 1] += 1);
        (1..starts.len()).for_each(|cell| starts[cell] += starts[cell - 1]);
        let mut next = starts.clone();
        let mut places = vec![DVec2::ZERO; positions.len()];
        for &p in positions {
            let at = &mut next[of(p)];
            places[*at as usize] = p;
            *at += 1;
        }
        Self { domain: domain.clone(), n_cells, cell, starts, places }
    }

    /// Hands on stretches of points that hold all within `reach` of a place, each with the shift that brings it near, and with others. On a torus half its shorter
    /// side is the longest reach.
    pub fn near(&self, place: DVec2, reach: f64, mut take: impl FnMut(&[DVec2], DVec2)) {
        let span = |axis: usize, reach: f64| {
            let at = |x: f64| (x / self.cell[axis]).floor() as i64;
            let n = self.n_cells[axis] as i64;
            // Rounding may put a point of the last row beyond it.
            let (low, high) = (at(place[axis] - reach), at(place[axis] + reach));
            if self.domain.is_periodic { (low, high) } else { (low.clamp(0, n - 1), high.clamp(0, n - 1)) }
        };
        let n_rows = self.n_cells[1] as i64;
        let (bottom, top) = span(1, reach);
        for row in bottom..=top {
            // The row's part of the disk.
            let (low, high) = (row as f64 * self.cell.y, (row + 1) as f64 * self.cell.y);
            let gap = (low - place.y).max(place.y - high).max(0.0);
            let (left, right) = span(0, (reach * reach - gap * gap).max(0.0).sqrt());
            let up = row.div_euclid(n_rows) as f64 * self.domain.size.y;
            let n_columns = self.n_cells[0] as i64;
            for period in left.div_euclid(n_columns)..=right.div_euclid(n_columns) {
                let first = (left - period * n_columns).max(0);
                let last = (right - period * n_columns).min(n_columns - 1);
                let base = row.rem_euclid(n_rows) * n_columns;
                let [start, end] = [base + first, base + last + 1].map(|cell| self.starts[cell as usize] as usize);
                take(&self.places[start..end], DVec2::new(period as f64 * self.domain.size.x, up));
            }
        }
    }

    /// The distances from a point to its `n` nearest others, rising; `None` where they reach beyond half a torus' shorter side.
    pub fn distances_to_nearest(&self, place: DVec2, n: usize) -> Option<Vec<f64>> {
        let most = if self.domain.is_periodic { 0.5 * self.domain.size.min_element() } else { self.domain.size.length() };
        let mut reach = (n as f64 * self.domain.area() / self.places.len() as f64).sqrt().min(most);
        let mut found = Vec::new();
        loop {
            found.clear();
            self.near(place, reach, |others, shift| {
                let place = place - shift;
                found.extend(others.iter().map(|&other| (other - place).length()).filter(|&distance| distance <= reach));
            });
            // It finds itself too.
            if found.len() > n {
                found.sort_unstable_by(f64::total_cmp);
                return Some(found[1..=n].to_vec());
            }
            if reach == most {
                return None;
            }
            reach = (2.0 * reach).min(most);
        }
    }
}
