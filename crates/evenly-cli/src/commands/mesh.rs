//! `evenly mesh`: triangles in a polygon.

use std::time::Instant;

use anyhow::bail;
use evenly::{CancelToken, MeshQuality, MeshRegion, Report, mesh_cells};
use evenly_io::{
    MeshFormat, Target, encode_mesh, encode_polygons, read_lines, read_polygon, read_positions, read_regions, read_rows, write_together,
};
use serde::Serialize;
use serde_json::Value;

use crate::mesh_args::Mesh;
use crate::meshed::{Given, Names, meshed};
use crate::talk::say;
use crate::unmet::Unmet;
use crate::{input, interrupt, record, session};

/// How many places are named where a demand was not met.
const NAMED: usize = 5;

pub fn run(args: &Mesh) -> anyhow::Result<u8> {
    let begin = Instant::now();
    let targets = Targets::new(args)?;
    let wishes = &args.wishes;
    let inputs = [Some(&args.input), args.sizes.as_ref(), wishes.density.path(), args.fixed.as_ref(), args.lines.as_ref()];
    input::require_one_stdin(inputs.into_iter().flatten())?;
    if let Some(tolerance) = args.curve_tolerance.filter(|&tolerance| !(tolerance > 0.0 && tolerance.is_finite())) {
        bail!("--curve-tolerance is {tolerance}; it must be positive and finite");
    }
    let pool = session::pool(args.run.threads, args.run.quiet)?;
    if args.regions && wishes.simplify.is_some() {
        bail!("--simplify would part regions that touch; simplify them before, or leave out --regions");
    }
    let (polygon, regions) = match args.regions {
        true => read_regions(&args.input, args.curve_tolerance)?,
        false => (read_polygon(&args.input, args.curve_tolerance)?, Vec::new()),
    };
    let mut notes: Vec<String> = polygon.repairs().to_vec();
    let given = Given {
        fixed: args.fixed.as_deref().map(read_positions).transpose()?.unwrap_or_default(),
        lines: args.lines.as_deref().map(read_lines).transpose()?.unwrap_or_default(),
        regions: regions.into_iter().map(|(name, polygon)| MeshRegion { name, polygon }).collect(),
        sizes: args.sizes.as_deref().map(read_rows).transpose()?,
        density: wishes.density.is_given().then(|| wishes.density.density()).transpose()?,
    };

    let nameless = std::path::PathBuf::new();
    let names =
        Names { polygon: &args.input, fixed: args.fixed.as_ref().unwrap_or(&nameless), lines: args.lines.as_ref().unwrap_or(&nameless) };
    let cancel = CancelToken::default();
    let bar = session::bar(args.run.quiet, 1000, "{bar:30} {percent}% {msg}");
    let made = pool.install(|| {
        let mut context = session::context(&bar, &cancel, args.run.quiet);
        meshed(&polygon, names, wishes, given, &mut context)
    });
    bar.finish_and_clear();
    let made = made?;
    let mesh = &made.mesh;
    notes.extend(made.report.notes.iter().cloned());

    let recipe = record::recipe(Some(wishes.seed));
    let of_mesh = encode_mesh(mesh, targets.format, &recipe, &targets.mesh)?;
    match &targets.cells {
        Some(cells) => write_together(&[(cells, &encode_polygons(&mesh_cells(mesh), &recipe)), (&targets.mesh, &of_mesh)])?,
        None => targets.mesh.write(&of_mesh)?,
    }
    interrupt::ends();
    // Who interrupts does not wait for measures.
    let measured = (!cancel.is_cancelled()).then(|| made.measured(wishes));
    notes.extend(measured.iter().flat_map(|measured| measured.notes.iter().cloned()));
    let missed = measured.as_ref().map_or(&[][..], |measured| &measured.unmet);
    let quality = measured.as_ref().map(|measured| &measured.quality);
    let seconds = begin.elapsed().as_secs_f64();
    let record = MeshRecord {
        version: record::VERSION,
        command: record::command(),
        seed: wishes.seed,
        parameters: &made.parameters,
        polygon_area: polygon.area(),
        uncovered_area: quality.map(|quality| (polygon.area() - quality.area).abs()),
        quality,
        run: made.report,
        unmet: missed,
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
        () if cancel.is_cancelled() => interrupt::code(),
        () if !missed.is_empty() => session::NOT_REACHED,
        () => session::DONE,
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
    run: Report,
    unmet: &'a [Unmet],
    notes: &'a [String],
    seconds: f64,
}

fn summarize(name: &str, record: &MeshRecord) {
    for note in record.notes {
        say(format_args!("note: {note}"));
    }
    let (Some(quality), Some(uncovered_area)) = (record.quality, record.uncovered_area) else {
        say(format_args!("{name}: seed {}, interrupted after {:.2} s; not measured", record.seed, record.seconds));
        return;
    };
    let &MeshQuality { n_vertices, n_triangles, min_angle_deg, max_angle_deg, mean_min_angle_deg, obtuse_triangles, .. } = quality;
    let &MeshQuality { radius_edge, beta, triangle_quality, min_edge, max_edge, n_border_edges, .. } = quality;
    say(format_args!(
        "{name}: {n_triangles} triangles, {n_vertices} vertices, {n_border_edges} edges on the border, seed {}, {:.2} s",
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
    for unmet in record.unmet.iter().take(NAMED) {
        say(format_args!("not reached: {unmet}"));
    }
    if record.unmet.len() > NAMED {
        say(format_args!("not reached: {} more triangles; --report has all", record.unmet.len() - NAMED));
    }
}
