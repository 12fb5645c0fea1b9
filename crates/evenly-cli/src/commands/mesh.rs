//! `evenly mesh`: triangles in a polygon.

use std::time::Instant;

use anyhow::bail;
use evenly::{CancelToken, MeshQuality, Report, mesh_cells};
use evenly_io::{MeshFormat, Target, encode_mesh, encode_polygons, write_together};
use evenly_jobs::{Ending, UnmetAngle};
use serde::Serialize;
use serde_json::Value;

use crate::files::{Files, require_one_stdin};
use crate::mesh_args::Mesh;
use crate::places::{Place, counted, places};
use crate::talk::say;
use crate::watch::Watch;
use crate::wording::{Flags, told};
use crate::{interrupt, record, session};

/// How many places are named where a demand was not met.
const NAMED: usize = 3;
/// Triangles are at one place within so many of the longest edges.
const NEAR: f64 = 3.0;

pub fn run(args: &Mesh) -> anyhow::Result<u8> {
    let begin = Instant::now();
    let targets = Targets::new(args)?;
    let inputs = [Some(&args.input), args.sizes.as_ref(), args.fixed.as_ref(), args.lines.as_ref()];
    require_one_stdin(inputs.into_iter().flatten().chain(&args.wishes.density.path()))?;
    if let Some(tolerance) = args.curve_tolerance.filter(|&tolerance| !(tolerance > 0.0 && tolerance.is_finite())) {
        bail!("--curve-tolerance is {tolerance}; it must be positive and finite");
    }
    let mut files = Files::default();
    let request = args.request(&mut files);
    request.check().map_err(told)?;
    let pool = session::pool(args.run.threads, args.run.quiet)?;
    let cancel = CancelToken::default();
    let mut watch = Watch::new("{bar:30} {percent}% {msg}", &cancel, args.run.quiet);
    let made = watch.run(&pool, |context| request.run(&mut files, context))?;
    let mesh = &made.mesh;

    let recipe = record::recipe(Some(request.seed));
    let of_mesh = encode_mesh(mesh, targets.format, &recipe, &targets.mesh)?;
    match &targets.cells {
        Some(cells) => write_together(&[(cells, &encode_polygons(&mesh_cells(mesh), &recipe)), (&targets.mesh, &of_mesh)])?,
        None => targets.mesh.write(&of_mesh)?,
    }
    interrupt::ends();
    // Who interrupts does not wait for measures.
    let measured = (!cancel.is_cancelled()).then(|| made.measured());
    let of_measures = measured.iter().flat_map(|measured| &measured.notes);
    let notes: Vec<String> = made.notes.iter().chain(of_measures).map(|note| note.shown(&Flags)).collect();
    let quality = measured.as_ref().map(|measured| &measured.quality);
    let polygon_area = made.polygon.area();
    let record = MeshRecord {
        version: record::VERSION,
        command: record::command(),
        seed: request.seed,
        parameters: &made.parameters,
        polygon_area,
        uncovered_area: quality.map(|quality| (polygon_area - quality.area).abs()),
        quality,
        run: &made.report,
        unmet: measured.as_ref().map_or(&[], |measured| &measured.unmet),
        notes: &notes,
        seconds: begin.elapsed().as_secs_f64(),
    };
    if !args.run.quiet {
        summarize(&targets.mesh.name(), &record, &watch.told);
    }
    let text = serde_json::to_string_pretty(&record)? + "\n";
    if let Some(report) = &targets.report {
        report.write(text.as_bytes())?;
    }
    if args.json {
        Target::any("-".as_ref(), false)?.write(text.as_bytes())?;
    }
    Ok(session::code(if cancel.is_cancelled() { Ending::Cancelled } else { made.ending(measured.as_ref()) }))
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
        let format = match (args.ascii, format) {
            (true, MeshFormat::Ply) => MeshFormat::PlyText,
            (true, _) => bail!("--ascii is for .ply, which is else binary"),
            (false, format) => format,
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
        session::require_distinct(&[Some(&mesh), cells.as_ref(), report.as_ref()])?;
        Ok(Self { mesh, format, cells, report })
    }
}

/// A run's whole record.
#[derive(Serialize)]
struct MeshRecord<'a> {
    version: &'static str,
    command: String,
    #[serde(skip)]
    seed: u64,
    parameters: &'a Value,
    polygon_area: f64,
    /// By how much the triangles' areas differ from the polygon's; not measured in an interrupted run, as its quality.
    uncovered_area: Option<f64>,
    quality: Option<&'a MeshQuality>,
    run: &'a Report,
    unmet: &'a [UnmetAngle],
    notes: &'a [String],
    seconds: f64,
}

/// What was said before is not said again.
fn summarize(name: &str, record: &MeshRecord, told: &[String]) {
    for note in record.notes.iter().filter(|note| !told.contains(note)) {
        say(format_args!("note: {note}"));
    }
    let (Some(quality), Some(uncovered_area)) = (record.quality, record.uncovered_area) else {
        say(format_args!("{name}: seed {}, interrupted after {:.2} s; not measured", record.seed, record.seconds));
        return;
    };
    let &MeshQuality { n_vertices, n_triangles, min_angle_deg, max_angle_deg, mean_min_angle_deg, obtuse_triangles, .. } = quality;
    let &MeshQuality { radius_edge, beta, triangle_quality, min_edge, max_edge, n_boundary_edges, .. } = quality;
    say(format_args!(
        "{name}: {n_triangles} triangles, {n_vertices} vertices, {n_boundary_edges} edges on the boundary, seed {}, {:.2} s",
        record.seed, record.seconds
    ));
    say(format_args!(
        "angles {min_angle_deg:.2} to {max_angle_deg:.2} degrees (mean of the smallest {mean_min_angle_deg:.2}), {obtuse_triangles} obtuse triangles"
    ));
    say(format_args!(
        "radius-edge ratio {radius_edge:.3}, beta {beta:.3}, quality {triangle_quality:.3}; edges {min_edge:.4e} to {max_edge:.4e} long; {:.1e} of the area missed",
        uncovered_area / record.polygon_area
    ));
    quality.size_errors.iter().for_each(say);
    for demand in ["min angle", "no obtuse"] {
        let unmet: Vec<&UnmetAngle> = record.unmet.iter().filter(|unmet| unmet.demand == demand).collect();
        let places = places(&unmet, NEAR * max_edge, |unmet| unmet.at);
        if !unmet.is_empty() {
            say(format_args!("not reached: {demand}: {}", counted(unmet.len(), &places)));
        }
        for Place { n, worst: UnmetAngle { angle_deg, at: [x, y], why, .. } } in places.iter().take(NAMED) {
            say(format_args!("  {n} here, the worst with {angle_deg:.2} degrees at ({x}, {y}), {why}"));
        }
        if places.len() > NAMED {
            say(format_args!("  {} more places; --report has all", places.len() - NAMED));
        }
    }
}
