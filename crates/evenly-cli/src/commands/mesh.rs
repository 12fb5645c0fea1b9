//! `evenly mesh`: triangles in a polygon.

use std::process::ExitCode;
use std::time::Instant;

use anyhow::bail;
use evenly::{CancelToken, MeshParams, MeshQuality, Report, RunContext, expected_triangles, mesh, mesh_cells, mesh_quality};
use evenly_io::{MeshFormat, Target, read_lines, read_polygon, read_positions, write_mesh, write_polygons};
use serde::Serialize;

use crate::mesh_args::{Mesh, Rule};
use crate::sizes::Sizes;
use crate::talk::say;
use crate::unmet::{Unmet, unmet};
use crate::{input, interrupt, measured, record, session};

/// Parameters, and the flags that hold them.
const FLAGS: [(&str, &str); 4] = [("spacing", "spacing"), ("growth", "grade"), ("largest", "max-spacing"), ("min_angle_deg", "min-angle")];
/// A spacing for so many triangles is found in so many steps.
const ESTIMATES: usize = 4;
/// How many places are named where a demand was not met.
const NAMED: usize = 5;

pub fn run(args: &Mesh) -> anyhow::Result<ExitCode> {
    let begin = Instant::now();
    let targets = Targets::new(args)?;
    let method = args.mesh_method()?;
    if args.no_obtuse && args.method != Rule::PushPull {
        bail!("--no-obtuse needs --method push-pull");
    }
    let inputs = [Some(&args.input), args.sizes.as_ref(), args.density.path(), args.fixed.as_ref(), args.lines.as_ref()];
    input::require_one_stdin(inputs.into_iter().flatten())?;
    if let Some(tolerance) = args.curve_tolerance.filter(|&tolerance| !(tolerance > 0.0 && tolerance.is_finite())) {
        bail!("--curve-tolerance is {tolerance}; it must be positive and finite");
    }
    let pool = session::pool(args.run.threads)?;
    let polygon = read_polygon(&args.input, args.curve_tolerance)?;
    let mut notes: Vec<String> = polygon.repairs().to_vec();
    // A triangle with sides h has the area sqrt(3) / 4 h^2.
    let of_triangles = |n: usize| (4.0 * polygon.area() / (3f64.sqrt() * n as f64)).sqrt();
    let mut spacing = args.spacing.unwrap_or_else(|| of_triangles(args.n_triangles.unwrap_or(1)));
    let growth = args.grade.unwrap_or(MeshParams::new(spacing).growth);
    let sizes = Sizes::new(args, &polygon, growth)?;
    let fixed = args.fixed.as_deref().map(read_positions).transpose()?.unwrap_or_default();
    let lines = args.lines.as_deref().map(read_lines).transpose()?.unwrap_or_default();
    let wanted = |spacing: f64| sizes.as_ref().map(|sizes| move |place: [f64; 2]| sizes.at(place, spacing));
    let told = |e| measured::told(e, &args.input, &FLAGS);
    let params_of = |spacing: f64| MeshParams {
        growth,
        largest: match (args.grade, args.max_spacing) {
            (None, _) => sizes.as_ref().map(|sizes| sizes.largest(spacing).max(spacing)),
            (Some(_), Some(largest)) => Some(largest),
            // As far as it grows.
            (Some(_), None) => Some(spacing.max(polygon.area().sqrt())),
        },
        method,
        is_non_obtuse: args.no_obtuse,
        min_angle_deg: args.min_angle,
        fixed: fixed.clone(),
        lines: lines.clone(),
        seed: args.seed,
        ..MeshParams::new(spacing)
    };
    params_of(spacing).validate().map_err(told)?;
    if let Some(n_triangles) = args.n_triangles {
        for _ in 0..ESTIMATES {
            let wanted = wanted(spacing);
            let params = MeshParams { wanted: wanted.as_ref().map(|wanted| wanted as _), ..params_of(spacing) };
            let expected = expected_triangles(&polygon, &params).map_err(told)?;
            spacing *= (expected / n_triangles as f64).sqrt();
        }
    }
    let wanted = wanted(spacing);
    let params = MeshParams { wanted: wanted.as_ref().map(|wanted| wanted as _), ..params_of(spacing) };

    let cancel = CancelToken::default();
    interrupt::cancels(&cancel, args.run.quiet)?;
    let bar = session::bar(args.run.quiet, 1000, "{bar:30} {percent}% {msg}");
    let made = pool.install(|| {
        let mut context = RunContext::default().with_cancel(cancel.clone()).on_progress(|progress| session::show(&bar, progress));
        mesh(&polygon, &params, &mut context)
    });
    bar.finish_and_clear();
    let (mesh, report) = made.map_err(told)?;
    notes.extend(report.notes.iter().cloned());
    let quality = mesh_quality(&mesh);
    let missed = unmet(&mesh, args.min_angle, args.no_obtuse);

    let recipe = record::recipe(Some(args.seed));
    write_mesh(&mesh, targets.format, &recipe, &targets.mesh)?;
    if let Some(cells) = &targets.cells {
        write_polygons(&mesh_cells(&mesh), &recipe, cells)?;
    }
    let seconds = begin.elapsed().as_secs_f64();
    let record = MeshRecord {
        version: record::VERSION,
        command: record::command(),
        parameters: &params,
        polygon_area: polygon.area(),
        uncovered_area: (polygon.area() - quality.area).abs(),
        quality,
        run: report,
        unmet: &missed,
        notes: &notes,
        seconds,
    };
    if !args.run.quiet {
        summarize(&targets.mesh.name(), &record);
    }
    let text = serde_json::to_string_pretty(&record)? + "\n";
    if let Some(report) = &targets.report {
        report.write(text.as_bytes())?;
    }
    if args.json {
        Target::any("-".as_ref(), false)?.write(text.as_bytes())?;
    }
    Ok(match () {
        () if cancel.is_cancelled() => ExitCode::from(interrupt::CODE),
        () if !missed.is_empty() => ExitCode::from(session::NOT_REACHED),
        () => ExitCode::SUCCESS,
    })
}

/// Where everything goes, checked before the work begins.
struct Targets {
    mesh: Target,
    format: MeshFormat,
    cells: Option<Target>,
    report: Option<Target>,
}

impl Targets {
    fn new(args: &Mesh) -> anyhow::Result<Self> {
        let force = args.run.force;
        let mesh = Target::any(&args.output, force)?;
        let format = match args.format {
            Some(format) => format,
            None if mesh.is_stdout() => MeshFormat::Msh,
            None => MeshFormat::of_path(&args.output)?,
        };
        if args.json && mesh.is_stdout() {
            bail!("--json and the mesh cannot both go to stdout; name a file with -o, or with --report");
        }
        if let Some(cells) =
            args.cells.as_ref().filter(|cells| !cells.extension().is_some_and(|ending| ending == "geojson" || ending == "json"))
        {
            bail!("{}: cells are written as .geojson, to a file", cells.display());
        }
        let other = |path: &Option<std::path::PathBuf>| path.as_ref().map(|path| Target::any(path, force)).transpose();
        let (cells, report) = (other(&args.cells)?, other(&args.report)?);
        let all: Vec<&Target> = [Some(&mesh), cells.as_ref(), report.as_ref()].into_iter().flatten().collect();
        for (k, target) in all.iter().enumerate() {
            if all[..k].iter().any(|before| before.is_same(target)) {
                bail!("{}: two outputs cannot go to the same file", target.name());
            }
        }
        Ok(Self { mesh, format, cells, report })
    }
}

/// A run's whole record.
#[derive(Serialize)]
struct MeshRecord<'a> {
    version: &'static str,
    command: String,
    parameters: &'a MeshParams<'a>,
    polygon_area: f64,
    /// By how much the triangles' areas differ from the polygon's.
    uncovered_area: f64,
    quality: MeshQuality,
    run: Report,
    unmet: &'a [Unmet],
    notes: &'a [String],
    seconds: f64,
}

fn summarize(name: &str, record: &MeshRecord) {
    for note in record.notes {
        say(format_args!("note: {note}"));
    }
    let MeshQuality { n_vertices, n_triangles, min_angle_deg, max_angle_deg, mean_min_angle_deg, obtuse_triangles, .. } = record.quality;
    let MeshQuality { radius_edge, beta, triangle_quality, min_edge, max_edge, n_border_edges, .. } = record.quality;
    say(format_args!(
        "{name}: {n_triangles} triangles, {n_vertices} vertices, {n_border_edges} edges on the border, seed {}, {:.2} s",
        record.parameters.seed, record.seconds
    ));
    say(format_args!(
        "angles {min_angle_deg:.2} to {max_angle_deg:.2} degrees (mean of the smallest {mean_min_angle_deg:.2}), {obtuse_triangles} obtuse triangles"
    ));
    say(format_args!(
        "radius-edge ratio {radius_edge:.3}, beta {beta:.3}, quality {triangle_quality:.3}; edges {min_edge:.4e} to {max_edge:.4e} long; {:.1e} of the area missed",
        record.uncovered_area / record.polygon_area
    ));
    for unmet in record.unmet.iter().take(NAMED) {
        say(format_args!("not reached: {unmet}"));
    }
    if record.unmet.len() > NAMED {
        say(format_args!("not reached: {} more triangles; --report has all", record.unmet.len() - NAMED));
    }
}
