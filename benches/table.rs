//! The table of what evenly promises, measured on this machine: `cargo xtask bench [quick] [procrustes | push-pull | starts | comparators | spectrum | density | mesh | surfaces]`,
//! quick without the largest runs.
//!
//! Speed is a ratio to one run of `delaunator` on the same points in the same process, the best of a few runs each.

#![allow(clippy::unwrap_used)]

mod comparators;
#[path = "../tests/shared/densities.rs"]
mod densities;
mod density;
mod mesh;
#[path = "../tests/shared/shapes.rs"]
mod shapes;
#[path = "../tests/shared/solids.rs"]
mod solids;
mod surfaces;

use std::time::{Duration, Instant};

use evenly::{
    CANDIDATES_A_POINT, DartParams, Error, Measures, Mode, Outcome, Phase, PointSet, PoissonDiskParams, ProcrustesParams, PushPullParams,
    PushPullPreset, Rectangle, Report, RunContext, Space, Targets, Torus, WellSpacedParams, dart, eliminate, measure, poisson_disk,
    power_spectrum, procrustes, push_pull, radial_spectrum, warp, warp_isotropic, well_spaced, white,
};
use peak_alloc::PeakAlloc;

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

const SEEDS: std::ops::Range<u64> = 0..5;

fn main() {
    let args: Vec<String> = std::env::args().collect();
    let is_wanted = |name: &str| args.iter().any(|arg| arg == name);
    let is_quick = is_wanted("quick");
    let is_all =
        !["procrustes", "push-pull", "starts", "comparators", "spectrum", "density", "mesh", "surfaces"].into_iter().any(is_wanted);
    println!("| run | must reach | measured |\n|---|---|---|");
    if is_all || is_wanted("procrustes") {
        of_procrustes(is_quick);
    }
    if is_all || is_wanted("push-pull") {
        of_push_pull(is_quick);
    }
    if is_all || is_wanted("starts") {
        of_starts(is_quick);
    }
    if is_all || is_wanted("comparators") {
        comparators::of_comparators();
    }
    if is_all || is_wanted("spectrum") {
        of_spectra(is_quick);
    }
    if is_all || is_wanted("density") {
        density::of_density(is_quick);
    }
    if is_all || is_wanted("mesh") {
        mesh::of_meshes(is_quick);
    }
    if is_all || is_wanted("surfaces") {
        surfaces::of_surfaces(is_quick);
    }
}

fn of_procrustes(is_quick: bool) {
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
        boundary(width);
    }
    let sizes = if is_quick { &[100_000][..] } else { &[100_000, 1_000_000] };
    for &n in sizes {
        speed(n);
    }
    let sizes = if is_quick { &[10_000, 100_000, 1_000_000][..] } else { &[10_000, 100_000, 1_000_000, 10_000_000] };
    growth(sizes);
}

fn of_push_pull(is_quick: bool) {
    let with = |min_distance: f64, coverage_radius: f64| PushPullParams {
        min_distance: Some(min_distance),
        coverage_radius: Some(coverage_radius),
        ..PushPullParams::default()
    };
    let third_row = PushPullParams::preset(PushPullPreset::Paper3);
    targets(1024, 8, false, &with(0.80, 0.63), "all converge, mean distance .847 +- .005, bond order .487 +- .03");
    targets(1024, 8, false, &with(0.90, 0.65), "all converge, mean distance .905 +- .005, bond order .499 +- .03");
    targets(1024, 8, false, &third_row, "all converge, beta <= .675, 0 obtuse triangles");
    targets(1000, 8, true, &with(0.90, 0.63), "all converge, angles within 45.5 and 89");
    targets(10_000, 3, true, &with(0.90, 0.63), "the same");
    let sizes = if is_quick { &[(10_000, 22), (100_000, 22)][..] } else { &[(10_000, 22), (100_000, 22), (1_000_000, 14)] };
    let mut visits = Vec::new();
    for &(n, must) in sizes {
        visits.push((n, push_pull_speed(n, must)));
    }
    let shown: Vec<String> = visits.iter().map(|(n, visits)| format!("{n}: {visits:.1}")).collect();
    println!("| Push-Pull {{0.85, 0.67}}, visits a point | within 30 % | {} |", shown.join(", "));
    well_spacing(10_000, 5, 0.75, "<= 60 sweeps, bond order <= .50, <= 30 delaunator runs");
    well_spacing(10_000, 5, 0.70, "reached, bond order <= .56, 0 obtuse triangles");
    well_spacing(10_000, 2, 0.67, "reached, bond order < .60");
    if !is_quick {
        well_spacing(100_000, 2, 0.70, "reached, bond order <= .56, 0 obtuse triangles");
    }
}

fn of_starts(is_quick: bool) {
    let sizes = if is_quick { &[(10_000, "-"), (100_000, "<= 5")][..] } else { &[(10_000, "-"), (100_000, "<= 5"), (1_000_000, "<= 4")] };
    for &(n, must) in sizes {
        let params = PoissonDiskParams { seed: 1, ..PoissonDiskParams::for_about(&torus(), n) };
        let points = poisson_disk(torus(), &params).unwrap();
        let unit = delaunator(&points).as_secs_f64();
        let ratio = best(3, || poisson_disk(torus(), &params).unwrap()).as_secs_f64() / unit;
        let m = measure(&points).unwrap();
        let relative = |length: f64| length * m.hex_spacing / params.spacing;
        println!(
            "| Poisson-disk, n = {n} | r_f >= R, r_c <= R, {must} delaunator runs, one thread | {} points, r_f = (1 + {:.0e}) R, r_c = (1 - {:.0e}) R, \
             {ratio:.2} |",
            points.n_points(),
            relative(m.min_distance) - 1.0,
            1.0 - relative(m.coverage_radius),
        );
    }
    let n = 100_000;
    let candidates = white(torus(), CANDIDATES_A_POINT * n, 1).unwrap();
    let unit = delaunator(&white(torus(), n, 1).unwrap()).as_secs_f64();
    let ratio = best(1, || eliminate(&candidates, n).unwrap()).as_secs_f64() / unit;
    let thinned = measure(&eliminate(&candidates, n).unwrap()).unwrap();
    println!("| sample elimination in progressive order, n = {n} | - | {ratio:.0}, min distance {:.3} |", thinned.min_distance);
    let darts = DartParams { n_points: Some(n), ..DartParams::default() };
    let ratio = best(1, || dart(torus(), &darts).unwrap()).as_secs_f64() / unit;
    println!(
        "| dart throwing, n = {n} | - | {ratio:.0}, min distance {:.3} |",
        measure(&dart(torus(), &darts).unwrap()).unwrap().min_distance
    );
}

fn of_spectra(is_quick: bool) {
    let sizes = if is_quick { &[(10_000, "-"), (100_000, "<= 20")][..] } else { &[(10_000, "-"), (100_000, "<= 20"), (1_000_000, "-")] };
    let one = pool(1);
    for &(n, must) in sizes {
        let points = white(torus(), n, 1).unwrap();
        let unit = delaunator(&points).as_secs_f64();
        let sets = std::slice::from_ref(&points);
        let power = best(2, || one.install(|| power_spectrum(sets, 4.0)).unwrap()).as_secs_f64() / unit;
        let radial = best(2, || one.install(|| radial_spectrum(sets)).unwrap()).as_secs_f64() / unit;
        println!("| power spectrum up to 4 sqrt(n) and its radial mean, one thread, n = {n} | {must} delaunator runs | {power:.1} |");
        println!("| pair correlation and its radial spectrum, one thread, n = {n} | {must} | {radial:.1} |");
    }
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

fn run(points: PointSet, mode: Mode, is_warped: bool) -> Run {
    let params = ProcrustesParams { mode, ..ProcrustesParams::default() };
    let warp = if is_warped { warp } else { |_: &mut PointSet| () };
    timed(points, warp, |points, context| procrustes(points, &params, context))
}

fn timed(mut points: PointSet, warp: fn(&mut PointSet), optimize: impl Fn(&mut PointSet, &mut RunContext) -> Result<Report, Error>) -> Run {
    let start = Instant::now();
    warp(&mut points);
    let warp = start.elapsed();
    let mut marks = Vec::new();
    let mut context = RunContext::default().on_progress(|progress| marks.push((progress, Instant::now())));
    let report = optimize(&mut points, &mut context).unwrap();
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

fn boundary(width: f64) {
    let space = Rectangle::new([0.0, 0.0], [width, 1.0]).unwrap();
    for (start, is_warped) in [("warped white noise", true), ("white noise", false)] {
        let mut worst = [0.0f64; 5];
        for seed in SEEDS {
            let run = run(white(space, 10_000, seed).unwrap(), Mode::Fast, is_warped);
            let boundary = measure(&run.points).unwrap().boundary.unwrap();
            let found = [
                boundary.boundary_angle_rms_deg,
                boundary.interior_angle_rms_deg,
                100.0 * boundary.uncovered_fraction,
                run.report.inverted_triangles as f64,
                boundary.isolated_points as f64,
            ];
            for (worst, found) in worst.iter_mut().zip(found) {
                *worst = worst.max(found);
            }
        }
        let [at_boundary, inside, uncovered, inverted, isolated] = worst;
        println!(
            "| Fast mode, rectangle {width}:1, {start}, n = 10000 | boundary angle rms <= 13, interior <= 12, uncovered <= .1 %, 0 inverted, 0 isolated | \
             {at_boundary:.2}, {inside:.2}, {uncovered:.4} %, {inverted}, {isolated} |"
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

/// Whether targets are reached, and how.
fn targets(n: usize, n_seeds: u64, is_warped: bool, params: &PushPullParams, must: &str) {
    let runs: Vec<(Measures, Report)> = (0..n_seeds)
        .map(|seed| {
            let warp = if is_warped { warp_isotropic } else { |_: &mut PointSet| () };
            let run = timed(white(torus(), n, seed).unwrap(), warp, |points, context| push_pull(points, params, context));
            (measure(&run.points).unwrap(), run.report)
        })
        .collect();
    let reached = runs.iter().filter(|(m, report)| report.outcome == Outcome::Converged && params.unmet(m).is_empty()).count();
    let mean = |value: fn(&Measures) -> f64| runs.iter().map(|(m, _)| value(m)).sum::<f64>() / runs.len() as f64;
    let most = |value: fn(&Measures) -> f64| runs.iter().map(|(m, _)| value(m)).fold(f64::MIN, f64::max);
    let visits = runs.iter().map(|(_, report)| report.visits).sum::<usize>() / runs.len();
    println!(
        "| Push-Pull {{{}, {}}}, tolerance {}, relaxation {}, {}, n = {n} | {must} | {reached} of {n_seeds} converge, mean distance {:.3}, bond order (psa) \
         {:.3}, beta <= {:.3}, angles {:.1} to {:.1}, {:.0} visits a point |",
        params.min_distance.unwrap(),
        params.coverage_radius.unwrap(),
        params.capacity_tolerance.unwrap(),
        params.relaxation,
        if is_warped { "warped white noise" } else { "white noise" },
        mean(|m| m.mean_distance),
        mean(|m| m.bond_order_psa),
        most(|m| m.beta),
        -most(|m| -m.min_angle_deg),
        most(|m| m.max_angle_deg),
        visits as f64 / n as f64,
    );
}

/// Whether a ratio is reached, what it costs, and how regular the points become.
fn well_spacing(n: usize, n_seeds: u64, beta: f64, must: &str) {
    let params = WellSpacedParams { beta, ..WellSpacedParams::default() };
    let runs: Vec<(Measures, Run, f64)> = (1..=n_seeds)
        .map(|seed| {
            let start = white(torus(), n, seed).unwrap();
            let unit = delaunator(&start).as_secs_f64();
            let run = pool(1).install(|| timed(start, warp_isotropic, |points, context| well_spaced(points, &params, context)));
            (measure(&run.points).unwrap(), run, unit)
        })
        .collect();
    let reached = runs.iter().filter(|(m, _, _)| m.beta <= beta).count();
    let most = |value: fn(&(Measures, Run, f64)) -> f64| runs.iter().map(value).fold(f64::MIN, f64::max);
    println!(
        "| Well-spaced, beta {beta}, n = {n} | {must} | {reached} of {n_seeds}, bond order <= {:.3}, {:.2} % obtuse, <= {:.0} visits a point in <= {:.0} passes, <= {:.1} \
         delaunator runs |",
        most(|(m, _, _)| m.bond_order),
        100.0 * most(|(m, _, _)| m.obtuse_fraction),
        most(|(m, run, _)| run.report.visits as f64 / m.n_points as f64),
        most(|(_, run, _)| run.report.iterations as f64),
        most(|(_, run, unit)| run.total.as_secs_f64() / unit),
    );
}

/// Returns the visits a point.
fn push_pull_speed(n: usize, must: u32) -> f64 {
    let start = white(torus(), n, 1).unwrap();
    let params = PushPullParams::default();
    let on = |n_threads: usize| {
        let once = || timed(start.clone(), warp_isotropic, |points, context| push_pull(points, &params, context));
        (0..3).map(|_| pool(n_threads).install(once)).min_by_key(|run| run.total).unwrap()
    };
    let before = MEMORY.current_usage();
    MEMORY.reset_peak_usage();
    let one = on(1);
    let peak = (MEMORY.peak_usage() - before) as f64 / n as f64;
    let unit = delaunator(&start).as_secs_f64();
    let two = on(2);
    println!(
        "| Push-Pull {{0.85, 0.67}}, whole run from white noise, one thread, n = {n} | <= {must} delaunator runs | {:.1} ({:.2} s), {} passes |",
        one.total.as_secs_f64() / unit,
        one.total.as_secs_f64(),
        one.report.iterations,
    );
    println!(
        "| two threads against one, n = {n} | >= 1.6 at 1M, the same bits | {:.2}, {} |",
        one.total.as_secs_f64() / two.total.as_secs_f64(),
        if one.points == two.points { "the same bits" } else { "DIFFERENT BITS" }
    );
    println!("| peak memory above the input, n = {n} | <= 500 bytes a point at 1M | {peak:.0} |");
    one.report.visits as f64 / n as f64
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
