//! Ahmed, Guo, Yan et al., "A Simple Push-Pull Algorithm for Blue-Noise Sampling".

use evenly::{CvtParams, LloydParams, ProcrustesParams, PushPullParams, PushPullPreset, ZonePlateParams, zone_plate};
use evenly_io::{Axis, Curve, Draw, picture};

use super::lab::{Lab, Profile, Recipe};
use super::models;
use super::part::Part;
use super::recipes::{farthest, farthest_of_paper};
use super::study::Study;

pub const STUDY: Study = Study {
    name: "push-pull",
    title: "Push-Pull, reproduced",
    citation: "Abdalla G. M. Ahmed, Jianwei Guo, Dong-Ming Yan, Jean-Yves Franceschi, Xiaopeng Zhang and Oliver Deussen, A Simple \
        Push-Pull Algorithm for Blue-Noise Sampling, IEEE Transactions on Visualization and Computer Graphics 23(12), 2017.",
    parts: &[
        ("Table 1", table_1),
        ("Figure 3", models::figure_3),
        ("Figure 4a", figure_4a),
        ("Figure 4b", figure_4b),
        ("Figure 4c", figure_4c),
        ("Figure 5", figure_5),
        ("Table 2", models::table_2),
    ],
};

/// The number of points at which the printed figures are consistent with each other.
const POINTS: usize = 1024;

fn targets(min_distance: f64, coverage_radius: f64) -> PushPullParams {
    PushPullParams { min_distance: Some(min_distance), coverage_radius: Some(coverage_radius), ..PushPullParams::default() }
}

fn table_1(lab: &Lab) -> anyhow::Result<Part> {
    let mut part = Part::new(
        "Spacing, coverage, spectrum and order of blue-noise sets: smallest and mean distance to the nearest point, coverage radius, \
         their ratio, effective Nyquist frequency, oscillation, bond-orientational order (of the tool psa). 1024 points.",
    );
    let recipes: [(Recipe, &[f64]); 11] = [
        (Recipe::start("Random", "white"), &[0.023, 0.465, 1.635, 71.42, 0.0, 0.074, 0.363]),
        (Recipe::maximal("MPS", 1.0), &[0.780, 0.821, 0.781, 1.0, 0.655, 2.168, 0.388]),
        (Recipe::plain("CVT", "white", CvtParams::default()), &[0.805, 0.941, 0.657, 0.817, 0.950, 4.733, 0.842]),
        (farthest_of_paper(), &[0.925, 0.933, 0.869, 0.939, 0.900, 4.628, 0.428]),
        (Recipe::plain("Push-pull-1", "white", targets(0.80, 0.63)), &[0.800, 0.847, 0.630, 0.787, 0.860, 1.894, 0.487]),
        (Recipe::plain("Push-pull-2", "white", targets(0.90, 0.65)), &[0.900, 0.905, 0.650, 0.722, 0.895, 3.180, 0.499]),
        (
            Recipe::plain("Push-pull-3", "white", PushPullParams::preset(PushPullPreset::Paper3)),
            &[0.920, 0.922, 0.620, 0.674, 0.920, 3.718, 0.597],
        ),
        (Recipe::usual("Procrustes", ProcrustesParams::default()), &[]),
        (Recipe::plain("Lloyd, 100 iterations", "white", LloydParams::default()), &[]),
        (Recipe::start("dart throwing", "dart"), &[]),
        (Recipe::start("sample elimination", "eliminate"), &[]),
    ];
    let table = part.table(&["d_min", "d_avg", "r_c", "beta", "nu_eff", "Omega", "BOO"]);
    for (recipe, printed) in recipes {
        // Each set by itself: the paper's spectral figures are of single sets, and oscillation falls where sets are averaged.
        let mut sums = [0.0; 7];
        let n_sets = lab.pick(3, 8);
        for points in lab.sets(&recipe, POINTS, n_sets)? {
            let p = Profile::of(std::slice::from_ref(&points))?;
            let m = &p.measures[0];
            let of = [
                m.min_distance,
                m.mean_distance,
                m.coverage_radius,
                m.beta,
                p.radial.effective_nyquist,
                p.radial.oscillation,
                m.bond_order_psa,
            ];
            sums.iter_mut().zip(of).for_each(|(sum, value)| *sum += value / n_sets as f64);
        }
        table.row(recipe.name, &sums, printed);
    }
    let missing: [(&str, &[f64]); 4] = [
        ("BNOT", &[0.738, 0.872, 0.744, 1.008, 0.855, 1.994, 0.427]),
        ("CCVT", &[0.711, 0.856, 0.782, 1.10, 0.830, 1.774, 0.403]),
        ("CapCVT", &[0.755, 0.895, 0.772, 1.022, 0.905, 2.957, 0.661]),
        ("KDM", &[0.645, 0.868, 0.746, 1.157, 0.870, 2.223, 0.451]),
    ];
    for (name, printed) in missing {
        table.row(name, &[], printed);
    }
    part.remark(
        "Random's beta is the ratio of two extremes and means nothing; its oscillation is that of single sets, and falls with their \
         number or size. MPS has about as many points: its number is chance.",
    );
    part.remark(
        "MPS's oscillation depends on the sampler: darts thrown at random, as here, have 1.5; boundary sampling, which puts points at \
         exactly the radius, has 3.1.",
    );
    part.remark(
        "Push-pull-3 does not converge with the capacity tolerance of the other rows; it is run with 0.1, and an over-relaxation of 1.2.",
    );
    part.remark("BNOT, CCVT, CapCVT and KDM are not among evenly's methods: the printed rows alone.");
    Ok(part)
}

fn figure_4a(lab: &Lab) -> anyhow::Result<Part> {
    let mut part = Part::new("Time by number of points, targets {0.85, 0.67}, from white noise.");
    let counts: &[usize] = lab.pick(&[1000, 5000, 20_000], &[1000, 5000, 20_000, 50_000, 100_000]);
    let recipes = [
        Recipe::maximal("MPS", 1.0),
        Recipe::usual("Push-Pull", targets(0.85, 0.67)),
        Recipe::usual("Procrustes", ProcrustesParams::default()),
        farthest(),
        Recipe::plain("CVT, 100 iterations", "white", CvtParams::default()),
        Recipe::plain("Lloyd, 100 iterations", "white", LloydParams::default()),
    ];
    let mut curves = Vec::new();
    for recipe in &recipes {
        let mut points = Vec::new();
        // Farthest points would take minutes.
        let most = if recipe.name == "FPO" { 20_000 } else { usize::MAX };
        for &n in counts.iter().filter(|&&n| n <= most) {
            let run = lab.run(recipe, n, 0)?;
            // A start is what it takes to make it; an optimiser, what follows.
            points.push([n as f64, if run.report.is_some() { run.seconds } else { run.start_seconds }]);
        }
        curves.push(Curve { name: recipe.name.into(), points });
    }
    let most = counts.iter().copied().max().unwrap_or(1) as f64;
    part.chart("time, by number of points", Axis::new("points", [0.0, most]), Axis::log("seconds", [1e-3, 1e2]), &curves);
    let names: Vec<String> = counts.iter().map(|n| format!("n = {n}, s")).collect();
    let table = part.table(&names.iter().map(String::as_str).collect::<Vec<_>>());
    for curve in &curves {
        table.row(curve.name.as_str(), &curve.points.iter().map(|p| p[1]).collect::<Vec<_>>(), &[]);
    }
    part.remark(
        "The paper's order holds: slower than MPS, faster than all other iterative methods but Procrustes, which it does not have. BNOT, \
         CCVT, CapCVT and KDM are missing.",
    );
    Ok(part)
}

/// The share of stable points by pass.
fn stability(lab: &Lab, name: &str, recipe: &Recipe, n: usize) -> anyhow::Result<Curve> {
    let run = lab.run(recipe, n, 0)?;
    let shares = run.report.map_or_else(Vec::new, |report| report.stable_share);
    Ok(Curve { name: name.into(), points: shares.iter().enumerate().map(|(pass, share)| [pass as f64 + 1.0, *share]).collect() })
}

fn convergence(part: &mut Part, curves: &[Curve]) {
    let most = curves.iter().map(|curve| curve.points.len()).max().unwrap_or(1) as f64;
    part.chart("share of stable samples, by pass", Axis::new("passes", [0.0, most]), Axis::new("stable share", [0.0, 1.0]), curves);
    let table = part.table(&["passes until 90 % are stable", "until 99 %", "until all are"]);
    for curve in curves {
        let first = |share: f64| curve.points.iter().find(|p| p[1] >= share).map_or(f64::NAN, |p| p[0]);
        table.row(curve.name.as_str(), &[first(0.9), first(0.99), first(1.0)], &[]);
    }
}

fn figure_4b(lab: &Lab) -> anyhow::Result<Part> {
    let mut part = Part::new("The share of stable samples by pass, for three pairs of targets; from white noise.");
    let n = lab.pick(1024, 2500);
    let mut curves = Vec::new();
    for (name, params) in [
        ("{0.80, 0.63}", targets(0.80, 0.63)),
        ("{0.90, 0.65}", targets(0.90, 0.65)),
        ("{0.91, 0.62}, tolerance 0.1", PushPullParams { capacity_tolerance: Some(0.1), relaxation: 1.2, ..targets(0.91, 0.62) }),
    ] {
        curves.push(stability(lab, name, &Recipe::plain("Push-Pull", "white", params), n)?);
    }
    convergence(&mut part, &curves);
    part.remark(
        "{0.91, 0.62} does not converge here with the capacity tolerance of 0.0386; the paper does not say with which its curve was drawn.",
    );
    Ok(part)
}

fn figure_4c(lab: &Lab) -> anyhow::Result<Part> {
    let mut part = Part::new("The share of stable samples by pass, from different starts; targets {0.85, 0.67}.");
    let n = lab.pick(1024, 10_000);
    let mut curves = Vec::new();
    for (name, start) in [("random", "white"), ("jittered grid", "jittered"), ("Poisson-disk", "poisson-disk")] {
        curves.push(stability(lab, name, &Recipe::plain("Push-Pull", start, targets(0.85, 0.67)), n)?);
    }
    curves.push(stability(lab, "random, evened out first", &Recipe::usual("Push-Pull", targets(0.85, 0.67)), n)?);
    convergence(&mut part, &curves);
    part.remark(
        "As in the paper, the more even the start, the faster. Evening white noise out first, which takes a few hundredths of the time, \
         makes it as good as a jittered grid.",
    );
    Ok(part)
}

fn figure_5(lab: &Lab) -> anyhow::Result<Part> {
    let mut part = Part::new(
        "Reducing the coverage radius (first three) and increasing the smallest distance (last three): 1024 points, the zone plate \
         sampled with a point a pixel and Mitchell's filter, power spectrum, radial mean, anisotropy.",
    );
    let n_sets = lab.pick(3, 10);
    let sweep = [(0.75, 0.75), (0.75, 0.70), (0.75, 0.63), (0.75, 0.67), (0.85, 0.67), (0.92, 0.67)];
    let mut rows = Vec::new();
    for (min_distance, coverage_radius) in sweep {
        let name = format!("r_f = {min_distance:.2}, r_c = {coverage_radius:.2}");
        let recipe = Recipe::usual("Push-Pull", targets(min_distance, coverage_radius));
        let sets = lab.sets(&recipe, POINTS, n_sets)?;
        let profile = Profile::of(&sets)?;
        part.figure(
            name.clone(),
            profile.figure(&sets, &[Draw::Points, Draw::PowerSpectrum, Draw::RadialPower, Draw::Anisotropy], POINTS)?,
        );
        // A larger set, so that nothing repeats within the picture.
        let pixels = lab.pick(256, 512);
        let plate = zone_plate(
            &lab.run(&recipe, lab.pick(1 << 14, 1 << 18), 0)?.points,
            &ZonePlateParams { pixels, ..ZonePlateParams::default() },
        )?;
        part.figure(format!("{name}: zone plate"), picture(&plate.image));
        rows.push((name, [plate.noise, plate.aliasing, profile.radial.effective_nyquist, profile.radial.oscillation]));
    }
    let table = part.table(&["noise", "aliasing", "effective Nyquist", "oscillation"]);
    for (name, numbers) in &rows {
        table.row(name.as_str(), numbers, &[]);
    }
    part.remark(
        "The paper judges by eye, and its text does not say which parameters its columns have. What it describes shows in the numbers: a \
         larger smallest distance reduces noise at the cost of structured aliasing; a smaller coverage radius reduces noise as well, for \
         less aliasing.",
    );
    Ok(part)
}
