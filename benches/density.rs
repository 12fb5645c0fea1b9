//! What a density costs, and how well points follow it.

use std::f64::consts::TAU;
use std::time::Instant;

use evenly::{
    Density, Image, LloydParams, Outcome, PointSet, ProcrustesParams, PushPullParams, Rectangle, RunContext, Space, dot_coverage, lloyd,
    measure, procrustes, push_pull, tour, warp, warp_isotropic, white, white_by_density,
};

use super::densities::{blobs, hash, waves};
use super::{best, pool, torus};

pub fn of_density(is_quick: bool) {
    converging();
    nineteen_to_one();
    for n in if is_quick { &[10_000][..] } else { &[10_000, 100_000] } {
        cost(*n);
    }
    tone();
    touring();
}

/// A density at so many pixels a spacing.
fn function(n_points: usize, density: impl Fn([f64; 2]) -> f64) -> Density {
    const PER_SPACING: f64 = 5.0;
    let width = (PER_SPACING / torus().hex_spacing(n_points)).round() as usize;
    Density::function(&torus(), width, width, density).unwrap()
}

fn pushed(space: Space, density: &Density, n_points: usize, seed: u64) -> (PointSet, Outcome, f64) {
    let mut points = white_by_density(space, density, n_points, seed).unwrap();
    warp_isotropic(&mut points);
    let report = push_pull(&mut points, &PushPullParams::default(), &mut RunContext::default()).unwrap();
    (points, report.outcome, report.visits as f64 / n_points as f64)
}

fn converging() {
    const SEEDS: u64 = 5;
    for (name, density) in [
        ("9:1 waves", function(2500, waves(0.8))),
        ("9:1 ramp with a jump", function(2500, |p| 1.0 + 8.0 * p[0])),
        ("21:1 blobs", function(2500, blobs(0.05))),
        ("100:1 blobs", function(2500, blobs(0.01))),
        ("waves with noise of 3:1 on every pixel", function(2500, |p| waves(0.8)(p) * (0.5 + hash(p)))),
    ] {
        let runs: Vec<_> = (0..SEEDS).map(|seed| pushed(torus(), &density, 2500, seed)).collect();
        let n_converged = runs.iter().filter(|run| run.1 == Outcome::Converged).count();
        let errors = runs.iter().filter_map(|run| measure(&run.0).unwrap().density_error);
        let visits = runs.iter().map(|run| run.2).fold(0.0, f64::max);
        println!(
            "| Push-Pull {{0.85, 0.67}} on {name}, n = 2500 | converges, density within 5 % rms | {n_converged} of {SEEDS} converge, density within {:.1} %, \
             <= {visits:.0} visits a point |",
            100.0 * errors.fold(0.0, f64::max)
        );
    }
}

fn nineteen_to_one() {
    let density = Density::function(&torus(), 500, 500, |p| 1.0 + 0.9 * (TAU * p[0]).sin() * (TAU * p[1]).sin()).unwrap();
    let (mut error, mut angle, mut n_inverted) = (0.0f64, 0.0f64, 0);
    for seed in 0..5 {
        let mut points = white_by_density(torus(), &density, 10_000, seed).unwrap();
        warp(&mut points);
        n_inverted += procrustes(&mut points, &ProcrustesParams::default(), &mut RunContext::default()).unwrap().inverted_triangles;
        let measures = measure(&points).unwrap();
        error = error.max(measures.density_error.unwrap());
        angle = angle.max(measures.angle_rms_deg);
    }
    println!(
        "| Procrustes on a 19:1 density, n = 10000 | cell error <= 5 %, 0 inverted, angle rms <= 12.3 | {:.1} %, {n_inverted} inverted, {angle:.2} |",
        100.0 * error
    );
}

fn cost(n: usize) {
    let seconds = |density: &Density| {
        let mut start = white_by_density(torus(), density, n, 1).unwrap();
        warp_isotropic(&mut start);
        let once = || push_pull(&mut start.clone(), &PushPullParams::default(), &mut RunContext::default()).unwrap();
        pool(1).install(|| best(5, once)).as_secs_f64()
    };
    let uniform = seconds(&Density::uniform());
    let ratios = [function(n, waves(0.8)), function(n, blobs(0.05)), function(n, blobs(0.01))].map(|density| seconds(&density) / uniform);
    println!(
        "| cost of a density at 5 pixels a spacing, one thread, n = {n} | <= 3 uniform runs | {:.2} (9:1 waves), {:.2} (21:1 blobs), {:.2} (100:1 blobs) |",
        ratios[0], ratios[1], ratios[2]
    );
}

/// The drawing's tone after a Gaussian of four dot spacings, against Lloyd's method to convergence.
fn tone() {
    let space: Space = Rectangle::new([0.0, 0.0], [1.0, 1.0]).unwrap().into();
    let n = 20_000;
    let edges = |p: [f64; 2]| if (p[0] - 0.5).hypot(p[1] - 0.5) < 0.3 { 0.9 - 0.8 * p[1] } else { 0.15 + 0.5 * p[0] };
    let density = Density::function(&space, 1000, 1000, edges).unwrap();
    let side = 2 * (n as f64).sqrt() as usize;
    let grey = |values: Vec<f64>| Image::new(side, side, 1, values).unwrap().blurred(8.0).unwrap();
    let wanted = grey(density.resampled(side, side).into_iter().map(|value| 1.0 - 0.4 * value).collect());
    let seen = |points: &PointSet| {
        let dots = dot_coverage(points, &vec![0.25 * points.hex_spacing(); n], side, side).unwrap();
        let mean = dots.values().iter().sum::<f64>() / dots.values().len() as f64;
        wanted.similarity(&grey(dots.values().iter().map(|value| 1.0 - 0.4 * value / mean).collect())).unwrap().ssim
    };
    let mut start = white_by_density(space, &density, n, 1).unwrap();
    warp_isotropic(&mut start);
    let [pushed, rested] = [true, false].map(|is_pushed| {
        let mut points = start.clone();
        let begin = Instant::now();
        if is_pushed {
            let params = PushPullParams { max_passes: Some(60), ..PushPullParams::default() };
            push_pull(&mut points, &params, &mut RunContext::default()).unwrap();
        } else {
            lloyd(&mut points, &LloydParams { iterations: 1000, ..LloydParams::default() }, &mut RunContext::default()).unwrap();
        }
        (begin.elapsed().as_secs_f64(), seen(&points))
    });
    println!(
        "| tone of 20000 dots, a disk on a ramp | SSIM no worse than weighted Lloyd's, in less time | {:.4} in {:.2} s, Lloyd's {:.4} in {:.1} s |",
        pushed.1, pushed.0, rested.1, rested.0
    );
}

fn touring() {
    let n = 20_000;
    let points = white(Rectangle::new([0.0, 0.0], [1.0, 1.0]).unwrap(), n, 1).unwrap();
    let at = |index: usize| points.positions()[index];
    let order = tour(&points, &RunContext::default());
    let length: f64 = order.windows(2).map(|step| (at(step[1])[0] - at(step[0])[0]).hypot(at(step[1])[1] - at(step[0])[1])).sum();
    let seconds = best(3, || tour(&points, &RunContext::default())).as_secs_f64();
    let share = length / (0.7124 * (n as f64).sqrt());
    println!("| tour of 20000 random points | within 8 % of 0.7124 sqrt(n A) | {:+.1} % in {seconds:.2} s |", 100.0 * (share - 1.0));
}
