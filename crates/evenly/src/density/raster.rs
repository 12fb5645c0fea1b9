//! Pixels of density, held as the sums of what lies before them: masses are found without adding pixels.

/// Pixels that share a sum of moments.
const BLOCK: usize = 4;
/// The side of the squares of pixels of which the extremes are known.
const TILE: usize = 4;

/// A grid of densities, rows from the bottom.
#[derive(Debug)]
pub(super) struct Raster {
    pub columns: usize,
    pub rows: usize,
    /// For each row the sum of what lies before each pixel, and last the row's: a pixel is the difference of two.
    before: Vec<f64>,
    /// For each row the sum of pixel times the column of its middle, before each block.
    moments: Vec<f64>,
    /// The sum of all rows below each; and of all.
    below: Vec<f64>,
    /// The smallest and the largest density of each tile.
    extremes: Vec<[f32; 2]>,
    pub has_zeros: bool,
}

impl Raster {
    /// Takes `rows` rows of `columns` densities from the bottom, none negative or infinite.
    pub fn new<'a>(columns: usize, rows: impl ExactSizeIterator<Item = &'a [f32]>) -> Self {
        let mut raster = Self {
            columns,
            rows: rows.len(),
            before: Vec::with_capacity((columns + 1) * rows.len()),
            moments: Vec::with_capacity(columns.div_ceil(BLOCK) * rows.len()),
            below: Vec::with_capacity(rows.len() + 1),
            extremes: Vec::with_capacity(columns.div_ceil(TILE) * rows.len().div_ceil(TILE)),
            has_zeros: false,
        };
        let mut total = 0.0;
        for (k, row) in rows.enumerate() {
            raster.below.push(total);
            let (mut sum, mut moment) = (0.0, 0.0);
            for (column, &value) in row.iter().enumerate() {
                if column.is_multiple_of(BLOCK) {
                    raster.moments.push(moment);
                }
                raster.before.push(sum);
                sum += f64::from(value);
                moment += (column as f64 + 0.5) * f64::from(value);
            }
            raster.before.push(sum);
            total += sum;
            // Also what is lost in rounding beside the rest.
            raster.has_zeros |= raster.before[raster.before.len() - columns - 1..].windows(2).any(|pair| pair[0] == pair[1]);
            if k.is_multiple_of(TILE) {
                raster.extremes.resize(raster.extremes.len() + columns.div_ceil(TILE), [f32::INFINITY, 0.0]);
            }
            let tiles = &mut raster.extremes[k / TILE * columns.div_ceil(TILE)..];
            for ([least, most], pixels) in tiles.iter_mut().zip(row.chunks(TILE)) {
                *least = pixels.iter().copied().fold(*least, f32::min);
                *most = pixels.iter().copied().fold(*most, f32::max);
            }
        }
        raster.below.push(total);
        raster
    }

    /// The sum of all pixels.
    pub fn total(&self) -> f64 {
        self.below[self.rows]
    }

    /// Of a row, the sum of the pixels before a column.
    #[inline]
    pub fn before(&self, column: usize, row: usize) -> f64 {
        self.before[column + row * (self.columns + 1)]
    }

    /// All sums before pixels, row by row; each row has one more than it has pixels.
    #[inline]
    pub fn sums(&self) -> &[f64] {
        &self.before
    }

    #[inline]
    pub fn value(&self, column: usize, row: usize) -> f64 {
        let index = column + row * (self.columns + 1);
        self.before[index + 1] - self.before[index]
    }

    /// Of a row, the sum of the pixels before a column, each times the column of its middle.
    pub fn moment_before(&self, column: usize, row: usize) -> f64 {
        let block = column.min(self.columns - 1) / BLOCK;
        let rest: f64 = (block * BLOCK..column).map(|other| (other as f64 + 0.5) * self.value(other, row)).sum();
        self.moments[block + row * self.columns.div_ceil(BLOCK)] + rest
    }

    /// Of a row, the integral from its start to `x`, in pixels.
    pub fn up_to(&self, x: f64, row: usize) -> f64 {
        let column = (x as usize).min(self.columns - 1);
        self.before(column, row) + self.value(column, row) * (x - column as f64)
    }

    /// The smallest and the largest density of all tiles that lie, in part, between two pixels, these included.
    pub fn extremes(&self, low: [usize; 2], high: [usize; 2]) -> [f64; 2] {
        let n_across = self.columns.div_ceil(TILE);
        let (mut least, mut most) = (f32::INFINITY, 0.0f32);
        for row in low[1] / TILE..=high[1] / TILE {
            for &[min, max] in &self.extremes[row * n_across + low[0] / TILE..=row * n_across + high[0] / TILE] {
                // Neither is NaN.
                least = if min < least { min } else { least };
                most = if max > most { max } else { most };
            }
        }
        [f64::from(least), f64::from(most)]
    }

    /// The largest density.
    pub fn largest(&self) -> f64 {
        self.extremes.iter().map(|tile| f64::from(tile[1])).fold(0.0, f64::max)
    }

    /// Where the sums of all pixels, row by row, reach `sum`: a place in a pixel that is not zero, and its row.
    pub fn place(&self, sum: f64) -> (f64, usize) {
        let sum = sum.min(self.total().next_down());
        let row = self.below.partition_point(|&below| below <= sum).clamp(1, self.rows) - 1;
        let sums = self.row(row);
        // Rounding may lead past the row's end.
        let rest = (sum - self.below[row]).min(sums[self.columns].next_down());
        let column = sums.partition_point(|&before| before <= rest).max(1) - 1;
        (column as f64 + (rest - sums[column]) / (sums[column + 1] - sums[column]), row)
    }

    fn row(&self, row: usize) -> &[f64] {
        &self.before[row * (self.columns + 1)..(row + 1) * (self.columns + 1)]
    }

    /// The first column from `column` on, and the last up to it, whose pixels in `row` are not zero.
    pub fn nearest_in_row(&self, column: usize, row: usize) -> [Option<usize>; 2] {
        let sums = self.row(row);
        let after = sums.partition_point(|&before| before <= sums[column]);
        let before = sums.partition_point(|&before| before < sums[column + 1]);
        [(after <= self.columns).then(|| after - 1), before.checked_sub(1)]
    }
}
