//! The mean power over rings of frequencies, and how much it differs by direction.

/// By ring.
pub(super) struct Rings {
    pub frequencies: Vec<f64>,
    pub power: Vec<f64>,
    pub anisotropy_db: Vec<f64>,
}

/// Rings as wide as the lattice's larger step; the frequency 0 is in none.
pub(super) fn of(power: &[f64], half: [usize; 2], step: [f64; 2], max_frequency: f64) -> Rings {
    let width = step[0].max(step[1]);
    let n_rings = (max_frequency / width) as usize;
    let mut sums = vec![[0.0f64; 3]; n_rings + 1];
    let n_columns = 2 * half[1] + 1;
    for (a, row) in power.chunks(n_columns).enumerate() {
        for (column, &power) in row.iter().enumerate() {
            let b = column as f64 - half[1] as f64;
            // Of a = 0 both directions are in the lattice, and of all else one.
            if a == 0 && b <= 0.0 {
                continue;
            }
            let frequency = libm::hypot(a as f64 * step[0], b * step[1]);
            if let Some([n, sum, squares]) = sums.get_mut((frequency / width).round() as usize) {
                *n += 1.0;
                *sum += power;
                *squares += power * power;
            }
        }
    }
    let rings = || sums.iter().enumerate().skip(1);
    let anisotropy = |&[n, sum, squares]: &[f64; 3]| {
        let mean = sum / n;
        let variance = (squares - n * mean * mean).max(0.0) / (n - 1.0);
        // What is left of no power, or of no difference, is rounding.
        let is_known = n > 1.0 && mean > 1e-9 && variance > 1e-18 * mean * mean;
        if is_known { 10.0 * libm::log10(variance / (mean * mean)) } else { f64::NAN }
    };
    Rings {
        frequencies: rings().map(|(ring, _)| ring as f64 * width).collect(),
        power: rings().map(|(_, [n, sum, _])| sum / n).collect(),
        anisotropy_db: rings().map(|(_, sums)| anisotropy(sums)).collect(),
    }
}
