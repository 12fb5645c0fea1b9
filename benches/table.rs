//! The table of what evenly promises, measured on this machine: `cargo xtask bench`, or `cargo xtask bench quick` without the largest runs.
//!
//! Speed is a ratio to one run of `delaunator` on the same points in the same process, the best of a few runs each.

#![allow(clippy::unwrap_used)]

use std::time::{Duration, Instant};

use evenly::{
    Measures, Mode, Phase, PointSet, ProcrustesParams, Rectangle, Report, RunContext, Space, Torus, measure, procrustes, warp, white,
};
use peak_alloc::PeakAlloc;

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

const SEEDS: std::ops::Range<u64> = 0..5;

fn main() {
    let is_quick = std::env::args().any(|arg| arg == "quick");
    println!("| run | must reach | measured |\n|---|---|---|");
    for (n, mode, is_warped, must) in [
        (10_000, Mode::Paper, false, "angle rms <= 12.5, quality >= .93, 90 to 160 iterations, 0 rises"),
        (100_000, Mode::Paper, false, "the same"),
        (10_000, Mode::Paper, true, "angle rms <= 11.3, quality >= .945"),
        (100_000, Mode::Paper, true, "the same"),
        (10_000, Mode::Fast, true, "angle rms <= 10.4, quality >= .952, bond order <= .60, <= 45 iterations"),
        (100_000, Mode::Fast, true, "the same"),
        (1_000_000, Mode::Fast, true, "the same"),
    ] {
        if n < 1_000_000 || !is_quick {
            quality(n, mode, is_warped, must);
        }
    }
    for width in [1.0, 4.0] {
        border(width);
    }
    let sizes = if is_quick { &[100_000][..] } else { &[100_000, 1_000_000] };
    for &n in sizes {
        speed(n);
    }
    let sizes = if is_quick { &[10_000, 100_000, 1_000_000][..] } else { &[10_000, 100_000, 1_000_000, 10_000_000] };
    growth(sizes);
}

fn torus() -> Space {
    Torus::new([0.0, 0.0], [1.0, 1.0]).unwrap().into()
}

/// One whole run, timed by phase.
struct Run {
    points: PointSet,
    report: Report,
    warp: Duration,
    triangulate: Duration,
    iteration: Duration,
    total: Duration,
}

fn run(mut points: PointSet, mode: Mode, is_warped: bool) -> Run {
    let start = Instant::now();
    if is_warped {
        warp(&mut points);
    }
    let warp = start.elapsed();
    let mut marks = Vec::new();
    let params = ProcrustesParams { mode, ..ProcrustesParams::default() };
    let mut context = RunContext::default().on_progress(|progress| marks.push((progress, Instant::now())));
    let report = procrustes(&mut points, &params, &mut context).unwrap();
    drop(context);
    let total = start.elapsed();
    let first = |phase: Phase| marks.iter().find(|(progress, _)| progress.phase == phase).unwrap().1;
    let steps: Vec<Instant> = marks.iter().filter(|(progress, _)| progress.iteration > 0).map(|&(_, at)| at).collect();
    let iteration = (steps[steps.len() - 1] - steps[0]) / (steps.len() as u32 - 1).max(1);
    Run { points, report, warp, triangulate: first(Phase::Optimize) - first(Phase::Triangulate), iteration, total }
}

fn quality(n: usize, mode: Mode, is_warped: bool, must: &str) {
    let runs: Vec<(Measures, Report)> = SEEDS
        .map(|seed| {
            let run = run(white(torus(), n, seed).unwrap(), mode, is_warped);
            (measure(&run.points).unwrap(), run.report)
        })
        .collect();
    let worst = |value: fn(&(Measures, Report)) -> f64| runs.iter().map(value).fold(f64::MIN, f64::max);
    let start = if is_warped { "warped white noise" } else { "white noise" };
    println!(
        "| {mode:?} mode, {start}, n = {n} | {must}, 0 inverted | angle rms <= {:.2}, quality >= {:.4}, bond order <= {:.3}, {} to {} iterations, \
         {} rises, {} inverted |",
        worst(|r| r.0.angle_rms_deg),
        -worst(|r| -r.0.triangle_quality),
        worst(|r| r.0.bond_order),
        -worst(|r| -(r.1.iterations as f64)),
        worst(|r| r.1.iterations as f64),
        worst(|r| r.1.energy_rises as f64),
        worst(|r| r.1.inverted_triangles as f64),
    );
}

fn border(width: f64) {
    let space = Rectangle::new([0.0, 0.0], [width, 1.0]).unwrap();
    for (start, is_warped) in [("warped white noise", true), ("white noise", false)] {
        let mut worst = [0.0f64; 5];
        for seed in SEEDS {
            let run = run(white(space, 10_000, seed).unwrap(), Mode::Fast, is_warped);
            let border = measure(&run.points).unwrap().border.unwrap();
            let found = [
                border.border_angle_rms_deg,
                border.interior_angle_rms_deg,
                100.0 * border.uncovered_fraction,
                run.report.inverted_triangles as f64,
                border.isolated_points as f64,
            ];
            for (worst, found) in worst.iter_mut().zip(found) {
                *worst = worst.max(found);
            }
        }
        let [at_border, inside, uncovered, inverted, isolated] = worst;
        println!(
            "| Fast mode, rectangle {width}:1, {start}, n = 10000 | border angle rms <= 13, interior <= 12, uncovered <= .1 %, 0 inverted, 0 isolated | \
             {at_border:.2}, {inside:.2}, {uncovered:.4} %, {inverted}, {isolated} |"
        );
    }
}

fn pool(n_threads: usize) -> rayon::ThreadPool {
    rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().unwrap()
}

fn best<T>(n_runs: usize, work: impl Fn() -> T) -> Duration {
    (0..n_runs)
        .map(|_| {
            let start = Instant::now();
            std::hint::black_box(work());
            start.elapsed()
        })
        .min()
        .unwrap()
}

fn delaunator(points: &PointSet) -> Duration {
    let points: Vec<delaunator::Point> = points.positions().iter().map(|p| delaunator::Point { x: p[0], y: p[1] }).collect();
    best(3, || delaunator::triangulate(&points))
}

fn speed(n: usize) {
    let start = white(torus(), n, 1).unwrap();
    let unit = delaunator(&start).as_secs_f64();
    let ratio = |time: Duration| time.as_secs_f64() / unit;
    let on = |n_threads: usize, mode: Mode| {
        let runs = (0..3).map(|_| pool(n_threads).install(|| run(start.clone(), mode, true)));
        runs.min_by_key(|run| run.total).unwrap()
    };
    let before = MEMORY.current_usage();
    MEMORY.reset_peak_usage();
    let one = on(1, Mode::Fast);
    let peak = (MEMORY.peak_usage() - before) as f64 / n as f64;
    let (two, plain) = (on(2, Mode::Fast), on(1, Mode::Paper));
    let micros = 1e6 * unit / n as f64;
    println!("| one run of delaunator, n = {n} | - | {:.1} ms, {micros:.2} us a point |", 1e3 * unit);
    println!("| triangulation of the torus, one thread, n = {n} | <= 1.8 delaunator runs | {:.2} |", ratio(one.triangulate));
    println!("| warp, one thread, n = {n} | - | {:.2} |", ratio(one.warp));
    println!("| whole run, Fast, one thread, n = {n} | <= 7 | {:.2} |", ratio(one.total));
    println!("| one iteration (mean of the run), Fast, one thread, n = {n} | <= .15 at 1M | {:.3} |", ratio(one.iteration));
    println!("| the same, Paper | - | {:.3} |", ratio(plain.iteration));
    let speedup = |one: Duration, two: Duration| one.as_secs_f64() / two.as_secs_f64();
    println!(
        "| two threads against one, Fast, n = {n} | >= 1.6 at 1M, the same bits | whole run {:.2}, iterations {:.2}, {} |",
        speedup(one.total, two.total),
        speedup(one.iteration, two.iteration),
        if one.points == two.points { "the same bits" } else { "DIFFERENT BITS" }
    );
    println!("| peak memory above the input, n = {n} | <= 400 bytes a point | {peak:.0} |");
    let spacing = 0.86 * start.hex_spacing();
    let poisson = best(1, || fast_poisson::Poisson2D::new().with_dimensions([1.0, 1.0], spacing).generate().len());
    println!("| fast_poisson with about as many points, n = {n} | - | {:.2} |", ratio(poisson));
}

fn growth(sizes: &[usize]) {
    let nanos: Vec<f64> = sizes
        .iter()
        .map(|&n| {
            let run = pool(1).install(|| run(white(torus(), n, 1).unwrap(), Mode::Fast, true));
            1e9 * run.iteration.as_secs_f64() / n as f64
        })
        .collect();
    let (low, high) = (nanos.iter().copied().fold(f64::MAX, f64::min), nanos.iter().copied().fold(0.0, f64::max));
    let shown: Vec<String> = sizes.iter().zip(&nanos).map(|(n, ns)| format!("{n}: {ns:.0} ns")).collect();
    println!("| time per point and iteration | within 2x | {} ({:.2}x) |", shown.join(", "), high / low);
}
