//! How values are spread, as a curve over bins.

use evenly_io::Curve;

/// How often values fall in each of the bins between `low` and `high`, as a share of all values.
pub fn spread(name: &str, values: &[f64], [low, high]: [f64; 2], n_bins: usize) -> Curve {
    let width = (high - low) / n_bins as f64;
    let mut counts = vec![0.0; n_bins];
    for value in values {
        let bin = ((value - low) / width).floor();
        if let Some(count) = counts.get_mut(bin as usize).filter(|_| bin >= 0.0) {
            *count += 100.0 / values.len() as f64;
        }
    }
    let points = counts.iter().enumerate().map(|(bin, count)| [low + (bin as f64 + 0.5) * width, *count]).collect();
    Curve { name: name.into(), points }
}
