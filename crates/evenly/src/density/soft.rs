//! [`SoftField`]: a density that changes gradually, for methods that look at it in single places.

use glam::DVec2;

use super::field::Field;
use crate::space::Domain;

/// The root of a density's mean over square cells, interpolated between their middles. Places without any density do not count.
pub(crate) struct SoftField {
    columns: usize,
    rows: usize,
    is_periodic: bool,
    /// Cells to a unit along each axis.
    resolution: DVec2,
    /// 0 in a cell without any density.
    roots: Vec<f32>,
}

impl SoftField {
    /// Cells are about so long.
    pub fn new(field: &Field, domain: &Domain, cell: f64) -> Self {
        let n_cells = (domain.size / cell).round().max(DVec2::ONE);
        let (columns, rows) = (n_cells.x as usize, n_cells.y as usize);
        let size = domain.size / n_cells;
        let low = |column: usize, row: usize| DVec2::new(column as f64, row as f64) * size;
        let root = |column: usize, row: usize| {
            let low = low(column, row);
            let area = if field.has_gaps() { field.area_with_some(low, low + size) } else { size.x * size.y };
            if area > 0.0 { (field.mass_in(low, low + size) / area).max(0.0).sqrt() as f32 } else { 0.0 }
        };
        let roots =
            (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row))).map(|(column, row)| root(column, row)).collect();
        Self { columns, rows, is_periodic: domain.is_periodic, resolution: 1.0 / size, roots }
    }

    /// The root of the density at a place.
    #[inline]
    pub fn root(&self, place: DVec2) -> f64 {
        let q = place * self.resolution - 0.5;
        let floor = q.floor();
        let [x, y] = (q - floor).to_array();
        let columns = self.pair(floor.x as i64, self.columns);
        let rows = self.pair(floor.y as i64, self.rows);
        let at = |column: usize, row: usize| f64::from(self.roots[column + row * self.columns]);
        let corners = rows.map(|row| columns.map(|column| at(column, row)));
        if corners.iter().flatten().all(|&root| root > 0.0) {
            let [below, above] = corners.map(|[left, right]| left + x * (right - left));
            return below + y * (above - below);
        }
        // Beside a gap the cells with some density alone tell.
        let weights = [[(1.0 - x) * (1.0 - y), x * (1.0 - y)], [(1.0 - x) * y, x * y]];
        let known = corners.iter().flatten().zip(weights.iter().flatten()).filter(|(root, _)| **root > 0.0);
        let (sum, weight) = known.fold((0.0, 0.0), |(sum, weight), (root, share)| (sum + root * share, weight + share));
        if weight > 0.0 { sum / weight } else { 0.0 }
    }

    /// A cell along an axis, and the next.
    #[inline]
    fn pair(&self, first: i64, n: usize) -> [usize; 2] {
        let last = n as i64 - 1;
        if (0..last).contains(&first) {
            [first as usize, first as usize + 1]
        } else if self.is_periodic {
            [first, first + 1].map(|k| k.rem_euclid(n as i64) as usize)
        } else {
            [first, first + 1].map(|k| k.clamp(0, last) as usize)
        }
    }
}
