//! The curves of blue noise, each in its chart.

use evenly::{PowerSpectrum, RadialSpectrum, Tessellation};

use super::chart::{Axis, Chart, round_up};

const BLACK: &str = "#000000";
const BLUE: &str = "#56b4e9";
const FREQUENCY: &str = "frequency (inverse mean spacings)";

/// The radial mean of the power: by distances, and below it over rings of the lattice.
pub(super) fn radial_power(size: [f64; 2], radial: &RadialSpectrum, power: Option<&PowerSpectrum>) -> Chart<'static> {
    let most = power.map_or(4.0, |power| power.max_frequency);
    let shown = || radial.frequencies.iter().copied().zip(radial.radial_power.iter().copied()).filter(|&(f, _)| f <= most);
    let high = shown().map(|(_, power)| power).fold(2.0, f64::max);
    let ring = power.iter().flat_map(|power| &power.ring_power).copied().fold(high, f64::max);
    // A lattice's peaks would leave nothing else to see.
    let high = round_up(ring.min(1.5 * high));
    let mut chart = Chart::new(size, Axis::new(FREQUENCY, [0.0, most]), Axis::new("power", [0.0, high]));
    chart.level(1.0);
    if let Some(power) = power {
        chart.curve(power.ring_frequencies.iter().copied().zip(power.ring_power.iter().copied()), BLUE, 1.0, "none");
    }
    chart.curve(shown(), BLACK, 1.4, "none");
    chart.upright(radial.effective_nyquist);
    chart.note(0, &format!("effective Nyquist {:.3}", radial.effective_nyquist));
    chart.note(1, &format!("oscillation {:.3}", radial.oscillation));
    chart
}

pub(super) fn anisotropy(size: [f64; 2], power: &PowerSpectrum) -> Chart<'static> {
    let none = -10.0 * (power.n_sets as f64).log10();
    let (x, y) = (Axis::new(FREQUENCY, [0.0, power.max_frequency]), Axis::new("anisotropy (dB)", [none - 10.0, none + 15.0]));
    let mut chart = Chart::new(size, x, y);
    chart.level(none);
    chart.curve(power.ring_frequencies.iter().copied().zip(power.anisotropy_db.iter().copied()), BLACK, 1.0, "none");
    chart
}

/// The pair correlation, up to five spacings, in bins of a twentieth: finer ones are mostly chance.
pub(super) fn pair_correlation(size: [f64; 2], radial: &RadialSpectrum) -> Chart<'static> {
    const WIDTH: f64 = 0.05;
    let mut bins: Vec<[f64; 2]> = Vec::new();
    for (&r, &g) in radial.distances.iter().zip(&radial.pair_correlation).take_while(|(r, _)| **r < 5.0) {
        let bin = (r / WIDTH + 1e-6) as usize;
        bins.resize(bin + 1, [0.0; 2]);
        // A ring's share of the plane grows with its radius.
        bins[bin][0] += g * (r + 1e-9);
        bins[bin][1] += r + 1e-9;
    }
    let means = || bins.iter().enumerate().map(|(bin, [sum, weight])| ((bin as f64 + 0.5) * WIDTH, sum / weight));
    let high = round_up(means().map(|(_, g)| g).fold(2.0, f64::max));
    let (x, y) = (Axis::new("distance (mean spacings)", [0.0, 5.0]), Axis::new("pair correlation", [0.0, high]));
    let mut chart = Chart::new(size, x, y);
    chart.level(1.0);
    chart.curve(means(), BLACK, 1.4, "none");
    chart
}

/// How the angles of all triangles are spread, in bins of two degrees.
pub(super) fn angles(size: [f64; 2], tessellation: &Tessellation) -> Chart<'static> {
    const WIDTH: f64 = 2.0;
    let mut counts = [0usize; 90];
    for corners in &tessellation.corners {
        for corner in 0..3 {
            let [p, q, r] = [0, 1, 2].map(|step| corners[(corner + step) % 3]);
            // Of length 1, so that products of tiny lengths do not vanish.
            let way = |to: [f64; 2]| {
                let (x, y) = (to[0] - p[0], to[1] - p[1]);
                [x / x.hypot(y), y / x.hypot(y)]
            };
            let ([ux, uy], [vx, vy]) = (way(q), way(r));
            let angle = (ux * vy - uy * vx).abs().atan2(ux * vx + uy * vy).to_degrees();
            counts[((angle / WIDTH) as usize).min(89)] += 1;
        }
    }
    let all = counts.iter().sum::<usize>().max(1) as f64;
    let share = |n: usize| 100.0 * n as f64 / all / WIDTH;
    let high = round_up(share(counts.iter().copied().max().unwrap_or(1)).max(1.0));
    let (x, y) = (Axis::new("angle (degrees)", [0.0, 180.0]), Axis::new("angles (% per degree)", [0.0, high]));
    let mut chart = Chart::new(size, x, y);
    chart.bars(WIDTH, counts.iter().enumerate().map(|(bin, &n)| (bin as f64 * WIDTH, share(n))), "#4477aa");
    chart.upright(90.0);
    chart
}
