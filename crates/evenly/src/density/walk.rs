//! The way of a segment through pixels, exact in each of them: after Amanatides and Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing",
//! Eurographics 1987.

use glam::DVec2;

/// The pixels that a segment crosses, and where; lengths in pixels, the segment's own parameter from 0 to 1.
pub(super) struct Walk {
    /// The pixel in which it begins, perhaps outside of the picture.
    pub column: i64,
    pub row: i64,
    /// How many boundaries between pixels it crosses.
    pub n_crossings: usize,
    /// Where it is to cross the next column, and the next row.
    pub next: [f64; 2],
    /// What lies between two crossings of columns, and of rows.
    pub stride: [f64; 2],
    /// The next column and row, relative to the one at hand.
    pub step: [i64; 2],
}

/// Adding this to a number below 2^51 leaves its nearest integer in the low bits.
const ROUND: f64 = 1.5 * (1u64 << 52) as f64;

/// The pixel of a coordinate. One on the boundary of two counts to either.
#[inline]
fn pixel(x: f64) -> i64 {
    (x - 0.5 + ROUND).to_bits() as i64 - ROUND.to_bits() as i64
}

impl Walk {
    /// The way between two places.
    #[inline]
    pub fn new(from: DVec2, to: DVec2) -> Self {
        let axis = |from: f64, to: f64| {
            let (first, last) = (pixel(from), pixel(to));
            let stride = 1.0 / (to - from).abs();
            let is_up = last > first;
            let boundary = first + i64::from(is_up);
            // Where no boundary is crossed, none is ever next.
            let next = if first == last { f64::INFINITY } else { (boundary as f64 - from).abs() * stride };
            (first, last.abs_diff(first) as usize, next, stride, if is_up { 1 } else { -1 })
        };
        let (column, n_columns, next_x, stride_x, step_x) = axis(from.x, to.x);
        let (row, n_rows, next_y, stride_y, step_y) = axis(from.y, to.y);
        Self { column, row, n_crossings: n_columns + n_rows, next: [next_x, next_y], stride: [stride_x, stride_y], step: [step_x, step_y] }
    }

    /// Goes to the next crossing, and past it: where it was, and whether it was one of columns.
    #[inline]
    pub fn cross(&mut self) -> (f64, bool) {
        let [x, y] = self.next;
        let is_column = x < y;
        self.next[0] += if is_column { self.stride[0] } else { 0.0 };
        self.next[1] += if is_column { 0.0 } else { self.stride[1] };
        (if is_column { x } else { y }, is_column)
    }
}
