//! What the papers show on surfaces: meshes of models that are given, and of a sphere.

use std::f64::consts::{PI, TAU};
use std::path::Path;

use anyhow::Context as _;
use evenly::{
    LloydParams, OptBetaParams, Outcome, RemeshMethod, RemeshParams, Remeshed, RunContext, Surface, SurfaceSizing, TriangleMesh,
    WellSpacedParams, remesh, surface_distance, surface_quality, surface_sizes,
};
use evenly_io::{read_triangles, triangles_svg};

use super::lab::{Interrupted, Lab};
use super::part::{Part, Table};
use crate::remeshed::surface_of;

/// A model of the paper's Table 2, and what is printed of it.
struct Model {
    name: &'static str,
    n_points: usize,
    is_adaptive: bool,
    printed: [(&'static str, [f64; 10]); 6],
}

const COLUMNS: [&str; 10] =
    ["Q_min", "Q_avg", "theta_min", "mean theta_min", "theta_max", "< 30, %", "> 90, %", "V567, %", "d_RMS, 1e-3", "d_H, 1e-2"];

const MODELS: [Model; 3] = [
    Model {
        name: "fertility",
        n_points: 8500,
        is_adaptive: false,
        printed: [
            ("MPS", [0.50, 0.81, 30.26, 45.26, 116.0, 0.0, 15.1, 96.4, 0.48, 0.41]),
            ("FPO", [0.52, 0.86, 32.8, 50.8, 113.6, 0.0, 6.16, 99.5, 0.98, 0.33]),
            ("CapCVT", [0.52, 0.88, 30.02, 51.3, 113.5, 0.0, 2.98, 99.8, 0.42, 0.28]),
            ("CVT without obtuse angles", [0.77, 0.94, 40.4, 54.8, 83.4, 0.0, 0.0, 100.0, 0.98, 0.34]),
            ("disk tuning", [0.64, 0.82, 30.1, 45.7, 90.0, 0.0, 0.0, 97.8, 0.55, 0.37]),
            (PUSH_PULL, [0.74, 0.87, 46.3, 51.1, 87.5, 0.0, 0.0, 100.0, 0.29, 0.31]),
        ],
    },
    Model {
        name: "homer",
        n_points: 7500,
        is_adaptive: true,
        printed: [
            ("MPS", [0.56, 0.82, 30.1, 46.4, 105.8, 0.0, 10.8, 99.8, 0.61, 0.28]),
            ("FPO", [0.49, 0.85, 31.0, 49.6, 117.5, 0.0, 7.99, 99.2, 0.45, 0.30]),
            ("CapCVT", [0.37, 0.83, 21.3, 46.2, 131.1, 0.98, 10.66, 95.8, 0.42, 0.20]),
            ("CVT without obtuse angles", [0.69, 0.94, 33.7, 54.5, 85.4, 0.0, 0.0, 100.0, 0.36, 0.17]),
            ("disk tuning", [0.51, 0.82, 21.3, 45.0, 90.0, 1.64, 0.01, 97.3, 1.21, 0.57]),
            (PUSH_PULL, [0.68, 0.90, 34.4, 51.8, 89.5, 0.0, 0.0, 100.0, 0.40, 0.23]),
        ],
    },
    Model {
        name: "bunny",
        n_points: 8000,
        is_adaptive: true,
        printed: [
            ("MPS", [0.62, 0.83, 32.0, 47.4, 97.9, 0.0, 4.89, 99.8, 0.77, 0.46]),
            ("FPO", [0.50, 0.84, 30.0, 48.6, 116.3, 0.0, 9.92, 98.0, 0.81, 0.42]),
            ("CapCVT", [0.39, 0.84, 15.6, 47.3, 125.1, 1.04, 8.46, 98.7, 0.71, 0.24]),
            ("CVT without obtuse angles", [0.72, 0.94, 36.3, 54.4, 89.4, 0.0, 0.0, 100.0, 0.94, 0.35]),
            ("disk tuning", [0.50, 0.82, 19.89, 45.2, 90.0, 0.88, 0.0, 97.8, 1.55, 0.52]),
            (PUSH_PULL, [0.71, 0.87, 37.1, 51.1, 89.5, 0.0, 0.0, 99.8, 0.44, 0.52]),
        ],
    },
];

const PUSH_PULL: &str = "Push-Pull {0.90, 0.63}";
const CVT: &str = "CVT (Lloyd, 100 iterations)";

pub fn table_2(lab: &Lab) -> anyhow::Result<Part> {
    let mut part =
        Part::new("Quality of meshes on surfaces, and their distance to the input relative to its diagonal; Homer and Bunny by curvature.");
    for model in &MODELS {
        let path = lab
            .models
            .iter()
            .find(|path| path.file_stem().is_some_and(|stem| stem.to_string_lossy().to_lowercase().starts_with(model.name)));
        let ours = path.map(|path| measured(lab, model, path)).transpose()?;
        let table = part.table(&COLUMNS);
        for (name, printed) in &model.printed {
            let numbers = ours.iter().flatten().find(|(own, _, _)| own == name).map_or(&[][..], |(_, numbers, _)| numbers);
            table.row(format!("{}: {name}", model.name), numbers, printed);
        }
        others(table, model, ours.iter().flatten());
        for (name, _, svg) in ours.into_iter().flatten().filter(|(name, _, _)| *name == PUSH_PULL) {
            part.figure(format!("{}, {} vertices: {name}", model.name, model.n_points), svg);
        }
    }
    if lab.models.is_empty() {
        part.remark("Printed numbers alone: the models are not evenly's to hand out. --models fertility.off,homer.obj,bunny.off puts ours beside them.");
    }
    part.remark(
        "Models of one name differ in scale, parts and triangles from copy to copy, which tells in the distances. The paper's sizes \
         by local feature size and ours by curvature are not the same either.",
    );
    part.remark("MPS with a mesh, FPO, CapCVT, CVT with a penalty on obtuse angles and disk tuning are not among evenly's remeshers: the printed rows alone. Moai and Kitten were not at hand.");
    Ok(part)
}

/// Rows that the paper does not have.
fn others<'a>(table: &mut Table, model: &Model, ours: impl Iterator<Item = &'a (&'static str, [f64; 10], String)>) {
    for (name, numbers, _) in ours.filter(|(name, _, _)| model.printed.iter().all(|(printed, _)| printed != name)) {
        table.row(format!("{}: {name}", model.name), numbers, &[]);
    }
}

/// A model by our methods: name, numbers, picture.
fn measured(lab: &Lab, model: &Model, path: &Path) -> anyhow::Result<Vec<(&'static str, [f64; 10], String)>> {
    let surface = surface_of(&read_triangles(path)?.mesh, path, true)?;
    let n_points = lab.pick(model.n_points / 5, model.n_points);
    let sizing = SurfaceSizing::Curvature { error: None };
    let sizes = if model.is_adaptive { surface_sizes(&surface, &sizing, Some(n_points))? } else { Vec::new() };
    let methods = [(PUSH_PULL, RemeshMethod::default()), (CVT, RemeshMethod::Lloyd(LloydParams::default()))];
    let row = |(name, method): (&'static str, RemeshMethod)| {
        let params = RemeshParams { n_points, method, sizes: sizes.clone(), ..RemeshParams::default() };
        let (made, _) = run(lab, &surface, &params).with_context(|| path.display().to_string())?;
        let new = Surface::new(&made.mesh)?;
        let (q, d) = (surface_quality(&new), surface_distance(&new, &surface));
        let numbers = [
            q.min_quality,
            q.mean_quality,
            q.min_angle_deg,
            q.mean_min_angle_deg,
            q.max_angle_deg,
            100.0 * q.thin_fraction,
            100.0 * q.obtuse_fraction,
            100.0 * q.valence_567_fraction,
            1e3 * d.rms,
            1e2 * d.hausdorff,
        ];
        Ok((name, numbers, triangles_svg(&made.mesh)))
    };
    methods.into_iter().map(row).collect()
}

pub fn figure_14(lab: &Lab) -> anyhow::Result<Part> {
    let mut part = Part::new(
        "1000 points on a sphere (and Figure 13): the ratio of the largest circumradius to the shortest edge, and the angles; by chords.",
    );
    let surface = Surface::new(&sphere(64))?;
    let methods: [(&str, RemeshMethod, &[f64]); 5] = [
        ("elimination, and one step of Lloyd", RemeshMethod::Lloyd(LloydParams { iterations: 1, ..LloydParams::default() }), &[]),
        ("Opt-beta", RemeshMethod::OptBeta(OptBetaParams { beta: 0.73, iterations: 400, ..OptBetaParams::default() }), &[0.73]),
        ("CVT (Lloyd, 400 iterations)", RemeshMethod::Lloyd(LloydParams { iterations: 400, ..LloydParams::default() }), &[0.81]),
        ("well-spaced, beta 0.72", RemeshMethod::WellSpaced(WellSpacedParams { beta: 0.72, ..WellSpacedParams::default() }), &[]),
        (PUSH_PULL, RemeshMethod::default(), &[]),
    ];
    let mut figures = Vec::new();
    let table = part.table(&["beta", "theta_min", "theta_max", "valence 6, %", "passes"]);
    for (name, method, printed) in methods {
        let params = RemeshParams { n_points: 1000, method, seed: 1, ..RemeshParams::default() };
        let (made, passes) = run(lab, &surface, &params)?;
        let q = surface_quality(&Surface::new(&made.mesh)?);
        table.row(name, &[q.beta, q.min_angle_deg, q.max_angle_deg, 100.0 * q.valence_6_fraction, passes as f64], printed);
        figures.push((name, triangles_svg(&made.mesh)));
    }
    figures.into_iter().for_each(|(name, svg)| part.figure(name, svg));
    part.remark("The paper's distances are geodesic, ours are chords, which at 1000 points differ by less than a part in a thousand. Its input was a maximal Poisson-disk sample, whose ratio is 1.");
    part.remark("Figures 12 and 15, Opt-beta with a sizing function, are not here: Opt-beta's local step knows no sizes. Push-Pull by sizes is in the reproduction of its paper.");
    Ok(part)
}

/// A run, and how many passes it took.
fn run(lab: &Lab, surface: &Surface, params: &RemeshParams) -> anyhow::Result<(Remeshed, usize)> {
    lab.check()?;
    lab.bar.set_message(format!("{}, {} vertices", params.method.name(), params.n_points));
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
