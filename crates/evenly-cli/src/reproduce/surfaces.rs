//! What Opt-beta's paper shows on surfaces: a sphere, of one size and of many, and a model; and what serves the other paper's, too.

use std::f64::consts::{PI, TAU};
use std::path::PathBuf;

use anyhow::Context as _;
use evenly::{
    LloydParams, LocalMethod, OptBetaParams, Outcome, RemeshParams, Remeshed, RunContext, Settings, Surface, SurfaceSizing, TriangleMesh,
    WellSpacedParams, expected_vertices, remesh, surface_quality, surface_sizes,
};
use evenly_io::{Axis, read_triangles, triangles_svg};

use super::lab::{Interrupted, Lab, named};
use super::part::Part;
use super::spread::spread;

pub const PUSH_PULL: &str = "Push-Pull {0.90, 0.63}";

pub fn figure_12(lab: &Lab) -> anyhow::Result<Part> {
    let mut part = Part::new(
        "Opt-beta on a sphere of radius 1 with sizes that are linear in z: 21 times as long at one end as at the other, as in the paper from 0.21 to 0.01.",
    );
    let surface = Surface::new(&sphere(64))?;
    let sizing = SurfaceSizing::Linear { axis: 2, ratio: 21.0 };
    let sizes = surface_sizes(&surface, &sizing, Some(1000))?;
    let finest = sizes.iter().copied().fold(f64::INFINITY, f64::min);
    let lengths: Vec<f64> = sizes.iter().map(|size| lab.pick(0.02, 0.01) * size / finest).collect();
    let n_points = expected_vertices(&surface, &lengths).round() as usize;
    sized(lab, &mut part, &surface, &lengths, n_points)?;
    Ok(part)
}

pub fn figure_15(lab: &Lab) -> anyhow::Result<Part> {
    let mut part = Part::new("Opt-beta on Fertility, with sizes by curvature.");
    let Some(surface) = model(lab, "fertility")? else {
        part.remark(
            "Nothing is printed but pictures and curves, and the model is not evenly's to hand out: --models fertility.off shows ours.",
        );
        return Ok(part);
    };
    let n_points = lab.pick(1700, 8500);
    let sizes = surface_sizes(&surface, &SurfaceSizing::Curvature { error: None }, Some(n_points))?;
    sized(lab, &mut part, &surface, &sizes, n_points)?;
    Ok(part)
}

/// A surface by sizes: the start, Opt-beta, and our ways to low ratios.
fn sized(lab: &Lab, part: &mut Part, surface: &Surface, sizes: &[f64], n_points: usize) -> anyhow::Result<()> {
    let methods: [(&str, LocalMethod); 4] = [
        ("sample elimination, the start", named("eliminate")?.on_meshes(&Settings::default(), 0)?),
        ("Opt-beta", OptBetaParams { beta: Some(0.73), iterations: 100, ..OptBetaParams::default() }.into()),
        ("well-spaced, beta 0.72", WellSpacedParams { beta: 0.72, ..WellSpacedParams::default() }.into()),
        (PUSH_PULL, RemeshParams::default().method),
    ];
    let (mut rows, mut betas, mut angles, mut figures) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for (name, method) in methods {
        let params =
            RemeshParams { n_vertices: n_points, method, sizes: sizes.to_vec(), max_deviation: None, seed: 1, ..RemeshParams::default() };
        let (made, passes) = run(lab, surface, &params)?;
        let q = surface_quality(&Surface::new(&made.mesh)?);
        let (local, corners) = local_betas(&made.mesh);
        let mean = local.iter().sum::<f64>() / local.len() as f64;
        let largest = local.iter().copied().fold(0.0, f64::max);
        let below = 100.0 * local.iter().filter(|&&beta| beta <= 0.75).count() as f64 / local.len() as f64;
        rows.push((name, [largest, mean, below, q.min_angle_deg, q.max_angle_deg, 100.0 * q.obtuse_fraction, passes as f64]));
        betas.push(spread(name, &local, [0.55, 1.5], 48));
        angles.push(spread(name, &corners, [20.0, 130.0], 55));
        figures.push((name, triangles_svg(&made.mesh)));
    }
    let columns = ["local beta, largest", "mean", "up to 0.75, %", "theta_min", "theta_max", "> 90, %", "passes"];
    let table = part.table(&columns);
    rows.into_iter().for_each(|(name, numbers)| table.row(name, &numbers, &[]));
    for (caption, range, curves) in [("local beta", [0.55, 1.5], betas), ("angle (degrees)", [20.0, 130.0], angles)] {
        let high = curves.iter().flat_map(|curve| &curve.points).map(|p| p[1]).fold(1.0, f64::max);
        part.chart(&format!("{caption}, {n_points} points"), Axis::new(caption, range), Axis::new("% in a bin", [0.0, high]), &curves);
    }
    figures.into_iter().for_each(|(name, svg)| part.figure(name, svg));
    part.remark(
        "The local beta of a point is the largest circumradius around it over its shortest edge. As in the paper, Opt-beta moves the bulk of the local ratios and the angles, and its sizes are \
         those of the start, as a ratio has none; where it stops, single spots are left that its local steps cannot mend. The other two have one ratio, and so one pair of bounds on all angles, everywhere.",
    );
    Ok(())
}

/// Of each vertex of a mesh the largest circumradius around it over its shortest edge; and all angles, in degrees.
fn local_betas(mesh: &TriangleMesh) -> (Vec<f64>, Vec<f64>) {
    let mut at = vec![(f64::INFINITY, 0f64); mesh.vertices.len()];
    let mut angles = Vec::with_capacity(3 * mesh.triangles.len());
    for &corners in &mesh.triangles {
        let length = |k: usize| {
            let [p, q] = [corners[k], corners[(k + 1) % 3]].map(|v| mesh.vertices[v]);
            (0..3).map(|axis| (p[axis] - q[axis]).powi(2)).sum::<f64>().sqrt()
        };
        let [ab, bc, ca] = [length(0), length(1), length(2)];
        let angle = |across: f64, b: f64, c: f64| ((b * b + c * c - across * across) / (2.0 * b * c)).clamp(-1.0, 1.0).acos();
        let radius = 0.5 * bc / angle(bc, ca, ab).sin();
        angles.extend([angle(bc, ca, ab), angle(ca, ab, bc), angle(ab, bc, ca)].map(f64::to_degrees));
        for (v, edge) in corners.into_iter().zip([ab.min(ca), ab.min(bc), bc.min(ca)]) {
            at[v] = (at[v].0.min(edge), at[v].1.max(radius));
        }
    }
    (at.into_iter().map(|(shortest, largest)| largest / shortest).collect(), angles)
}

pub fn figure_14(lab: &Lab) -> anyhow::Result<Part> {
    let mut part = Part::new(
        "1000 points on a sphere (and Figure 13): the ratio of the largest circumradius to the shortest edge, and the angles; by chords.",
    );
    let surface = Surface::new(&sphere(64))?;
    let methods: [(&str, LocalMethod, &[f64]); 5] = [
        ("elimination, and one step of Lloyd", LloydParams { iterations: 1, ..LloydParams::default() }.into(), &[]),
        ("Opt-beta", OptBetaParams { beta: Some(0.73), iterations: 400, ..OptBetaParams::default() }.into(), &[0.73]),
        ("CVT (Lloyd, 400 iterations)", LloydParams { iterations: 400, ..LloydParams::default() }.into(), &[0.81]),
        ("well-spaced, beta 0.72", WellSpacedParams { beta: 0.72, ..WellSpacedParams::default() }.into(), &[]),
        (PUSH_PULL, RemeshParams::default().method, &[]),
    ];
    let mut figures = Vec::new();
    let table = part.table(&["beta", "theta_min", "theta_max", "valence 6, %", "passes"]);
    for (name, method, printed) in methods {
        let params = RemeshParams { n_vertices: 1000, method, seed: 1, ..RemeshParams::default() };
        let (made, passes) = run(lab, &surface, &params)?;
        let q = surface_quality(&Surface::new(&made.mesh)?);
        table.row(name, &[q.beta, q.min_angle_deg, q.max_angle_deg, 100.0 * q.valence_6_fraction, passes as f64], printed);
        figures.push((name, triangles_svg(&made.mesh)));
    }
    figures.into_iter().for_each(|(name, svg)| part.figure(name, svg));
    part.remark("The paper's distances are geodesic, ours are chords, which at 1000 points differ by less than a part in a thousand. Its input was a maximal Poisson-disk sample, whose ratio is 1.");
    Ok(part)
}

/// The surface of a model, if its file is given: one whose name begins so.
pub fn model(lab: &Lab, name: &str) -> anyhow::Result<Option<Surface>> {
    let is_it = |path: &&PathBuf| path.file_stem().is_some_and(|stem| stem.to_string_lossy().to_lowercase().starts_with(name));
    let surface = |path: &PathBuf| Surface::repaired(&read_triangles(path)?.mesh).with_context(|| path.display().to_string());
    lab.models.iter().find(is_it).map(surface).transpose()
}

/// A run, and how many passes it took.
pub fn run(lab: &Lab, surface: &Surface, params: &RemeshParams) -> anyhow::Result<(Remeshed, usize)> {
    lab.check()?;
    lab.bar.set_message(format!("{}, {} vertices", params.method.method(), params.n_vertices));
    let (made, report) = remesh(surface, params, &mut RunContext::default().with_cancel(lab.cancel.clone()))?;
    if report.outcome == Outcome::Cancelled {
        return Err(Interrupted.into());
    }
    Ok((made, report.iterations))
}

/// A sphere of radius 1, by so many parallels.
fn sphere(n: usize) -> TriangleMesh {
    let (n_around, mut vertices) = (2 * n, vec![[0.0, 0.0, 1.0]]);
    for i in 1..n {
        let (sin, cos) = (PI * i as f64 / n as f64).sin_cos();
        let place = |j: usize| {
            let (y, x) = (TAU * j as f64 / n_around as f64).sin_cos();
            [sin * x, sin * y, cos]
        };
        vertices.extend((0..n_around).map(place));
    }
    let (south, at) = (vertices.len(), |i: usize, j: usize| 1 + (i - 1) * n_around + j % n_around);
    vertices.push([0.0, 0.0, -1.0]);
    let caps = (0..n_around).flat_map(|j| [[0, at(1, j), at(1, j + 1)], [south, at(n - 1, j + 1), at(n - 1, j)]]);
    let rings = (1..n - 1).flat_map(|i| {
        (0..n_around).flat_map(move |j| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
    });
    let triangles = caps.chain(rings).collect();
    TriangleMesh { vertices, triangles, attributes: Vec::new() }
}
