//! Waves of many points by a non-uniform fast Fourier transform: each point is spread over a fine grid by a smooth kernel, the grid is transformed, and the
//! kernel's own transform is divided out.
//!
//! The kernel is that of Barnett, Magland and af Klinteberg, "A Parallel Nonuniform Fast Fourier Transform Library Based on an 'Exponential of Semicircle'
//! Kernel", SIAM Journal on Scientific Computing 41(5), 2019, doi 10.1137/18M120885X. It is 14 cells wide on a grid a quarter finer than needed, which leaves an error
//! of 2e-7 of a power, or of that of white noise where that is more. The grid is held in rows of which only the frequencies that are asked for are kept, so that memory
//! is some 20 bytes a frequency more than the result.

use rayon::prelude::*;
use realfft::RealFftPlanner;
use realfft::num_complex::Complex64;
use rustfft::FftPlanner;

use super::waves::Waves;

/// Cells under a kernel.
const WIDTH: usize = 14;
/// How much finer the grid is than the frequencies need.
const UPSAMPLING: f64 = 1.25;
/// Rows of the grid that are filled together.
const BAND: usize = 64;
/// Columns of the grid that are transformed together: what lies side by side in memory is read together.
const COLUMNS: usize = 8;

/// Adds `share` of the power of every frequency.
pub(super) fn add_power(waves: &Waves, share: f64, power: &mut [f64]) {
    let kernel = Kernel::new();
    let needed = waves.half.map(|half| (UPSAMPLING * (2 * half + 1) as f64).ceil() as usize);
    let width = smooth(needed[0].max(2 * WIDTH));
    let height = BAND * smooth(needed[1].div_ceil(BAND));
    let rows = transform_rows(waves, &kernel, width, height);
    // What the kernel makes of each frequency.
    let loss = |half: usize, cells: usize| (0..=half).map(|k| kernel.transform(k as f64 / cells as f64)).collect();
    let (loss_x, loss_y): (Vec<f64>, Vec<f64>) = (loss(waves.half[0], width), loss(waves.half[1], height));

    let n_kept = waves.half[0] + 1;
    let n_columns = 2 * waves.half[1] + 1;
    let fft = FftPlanner::new().plan_fft_forward(height);
    power.par_chunks_mut(COLUMNS * n_columns).enumerate().for_each(|(block, power)| {
        let first = block * COLUMNS;
        let n = power.len() / n_columns;
        let mut columns = vec![Complex64::default(); n * height];
        for (row, kept) in rows.chunks(n_kept).enumerate() {
            for (column, &value) in kept[first..first + n].iter().enumerate() {
                columns[column * height + row] = value;
            }
        }
        fft.process(&mut columns);
        for ((column, waves_of), power) in columns.chunks(height).enumerate().zip(power.chunks_mut(n_columns)) {
            let a = first + column;
            for (at, power) in power.iter_mut().enumerate() {
                let b = at as i64 - waves.half[1] as i64;
                let sum = waves_of[b.rem_euclid(height as i64) as usize] / (loss_x[a] * loss_y[b.unsigned_abs() as usize]);
                *power += share * (sum - waves.of_density(a, b)).norm_sqr();
            }
        }
    });
}

/// The grid with the points spread over it, each row transformed; of each row the frequencies from 0 to the largest that is asked for.
fn transform_rows(waves: &Waves, kernel: &Kernel, width: usize, height: usize) -> Vec<Complex64> {
    let n_kept = waves.half[0] + 1;
    let n_bands = height / BAND;
    let bands = bands(waves, width, height);
    let fft = RealFftPlanner::new().plan_fft_forward(width);
    let mut rows = vec![Complex64::default(); height * n_kept];
    rows.par_chunks_mut(BAND * n_kept).enumerate().for_each(|(band, rows)| {
        let mut grid = vec![0.0; BAND * width];
        let before = (band + n_bands - 1) % n_bands;
        let reaching = bands[band].iter().chain(if before == band { &[][..] } else { &bands[before][..] });
        for &point in reaching {
            let index = point as usize;
            spread(waves.x[index] * width as f64, waves.y[index] * height as f64, waves.weight[index], kernel, band, height, &mut grid);
        }
        let (mut spectrum, mut scratch) = (fft.make_output_vec(), fft.make_scratch_vec());
        for (grid, kept) in grid.chunks_mut(width).zip(rows.chunks_mut(n_kept)) {
            // The lengths are the plan's own, so that this cannot fail.
            let _ = fft.process_with_scratch(grid, &mut spectrum, &mut scratch);
            kept.copy_from_slice(&spectrum[..n_kept]);
        }
    });
    rows
}

/// The points by the band in which their kernels begin, each band from left to right.
fn bands(waves: &Waves, width: usize, height: usize) -> Vec<Vec<u32>> {
    let mut bands = vec![Vec::new(); height / BAND];
    for (point, &y) in waves.y.iter().enumerate() {
        let row = first_cell(y * height as f64).rem_euclid(height as i64) as usize;
        bands[row / BAND].push(point as u32);
    }
    let column = |point: u32| (waves.x[point as usize] * width as f64) as usize;
    bands.par_iter_mut().for_each(|band| band.sort_unstable_by_key(|&point| (column(point), point)));
    bands
}

/// The first cell under a kernel.
fn first_cell(place: f64) -> i64 {
    (place - 0.5 * WIDTH as f64).ceil() as i64
}

/// Adds a point's kernel to those of its rows that lie in the band.
fn spread(x: f64, y: f64, weight: f64, kernel: &Kernel, band: usize, height: usize, grid: &mut [f64]) {
    let width = grid.len() / BAND;
    let (first_x, first_y) = (first_cell(x), first_cell(y));
    let (of_x, of_y) = (kernel.values(first_x as f64 - x), kernel.values(first_y as f64 - y));
    let start = first_x.rem_euclid(width as i64) as usize;
    for (step, &value) in of_y.iter().enumerate() {
        let row = (first_y + step as i64).rem_euclid(height as i64) as usize;
        if row / BAND != band {
            continue;
        }
        let row = &mut grid[row % BAND * width..][..width];
        let value = weight * value;
        let n_before_seam = WIDTH.min(width - start);
        let (here, beyond) = of_x.split_at(n_before_seam);
        row[start..].iter_mut().zip(here).for_each(|(cell, x)| *cell += value * x);
        row.iter_mut().zip(beyond).for_each(|(cell, x)| *cell += value * x);
    }
}

/// exp(b (sqrt(1 - z^2) - 1)), z in [-1, 1].
struct Kernel {
    sharpness: f64,
}

impl Kernel {
    fn new() -> Self {
        Self { sharpness: 0.97 * std::f64::consts::PI * WIDTH as f64 * (1.0 - 0.5 / UPSAMPLING) }
    }

    /// At cells that follow each other, the first `offset` cells from the middle.
    fn values(&self, offset: f64) -> [f64; WIDTH] {
        std::array::from_fn(|cell| {
            let z = (offset + cell as f64) / (0.5 * WIDTH as f64);
            libm::exp(self.sharpness * ((1.0 - z * z).max(0.0).sqrt() - 1.0))
        })
    }

    /// Its Fourier transform at a frequency, in turns a cell: trapezia over the angle whose sine is z, where all that is summed vanishes at both ends.
    fn transform(&self, frequency: f64) -> f64 {
        use std::f64::consts::{FRAC_PI_2, PI};
        const STEPS: usize = 200;
        let sum: f64 = (1..STEPS)
            .map(|step| {
                let (z, cosine) = libm::sincos(step as f64 / STEPS as f64 * PI - FRAC_PI_2);
                libm::exp(self.sharpness * (cosine - 1.0)) * libm::cos(PI * frequency * WIDTH as f64 * z) * cosine
            })
            .sum();
        0.5 * WIDTH as f64 * sum * PI / STEPS as f64
    }
}

/// The least number from here on without a prime factor above 5: what is transformed fast.
fn smooth(least: usize) -> usize {
    let rest = |mut n: usize| {
        for factor in [2, 3, 5] {
            while n.is_multiple_of(factor) {
                n /= factor;
            }
        }
        n
    };
    (least.max(1)..).find(|&n| rest(n) == 1).unwrap_or(least)
}
