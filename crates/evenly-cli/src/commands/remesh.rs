//! `evenly remesh`: a surface's new mesh.

use std::time::Instant;

use anyhow::bail;
use evenly::{CancelToken, CertificateBreach, MissedLengths, Report, SurfaceDistance, SurfaceQuality};
use evenly_io::{MeshFormat, Target, round_as_stl, stl_rounding, write_triangles, write_triangles_figure};
use evenly_jobs::{Ending, Message};
use serde::Serialize;
use serde_json::Value;

use crate::files::{Files, require_one_stdin};
use crate::places::{Place, counted, places};
use crate::remesh_args::Remesh;
use crate::talk::say;
use crate::watch::Watch;
use crate::wording::{Flags, told};
use crate::{interrupt, record, session};

/// How many places are named where angles are not as the targets imply.
const NAMED: usize = 3;
/// Triangles are at one place within so many of the longest edges.
const NEAR: f64 = 3.0;

pub fn run(args: &Remesh) -> anyhow::Result<u8> {
    let begin = Instant::now();
    let targets = Targets::new(args)?;
    require_one_stdin(&args.inputs())?;
    let mut files = Files::default();
    let request = args.request(&mut files);
    request.check().map_err(told)?;
    let pool = session::pool(args.run.threads, args.run.quiet)?;
    let cancel = CancelToken::default();
    let mut watch = Watch::new("{bar:30} {percent}% {msg}", &cancel, args.run.quiet);
    let mut made = watch.run(&pool, |context| request.run(&mut files, context))?;
    // What is measured is what is written.
    if targets.format == MeshFormat::Stl {
        made.notes.extend(stl_rounding(&made.remeshed.mesh).map(Message::from));
        round_as_stl(&mut made.remeshed.mesh);
    }

    let recipe = record::recipe(Some(request.seed));
    write_triangles(&made.with_places(), targets.format, &recipe, &targets.mesh)?;
    if let Some(plot) = &targets.plot {
        write_triangles_figure(&[("", &made.remeshed.mesh)], &recipe, plot)?;
    }
    interrupt::ends();
    // Who interrupts does not wait for measures.
    let measured = if cancel.is_cancelled() { None } else { Some(pool.install(|| made.measured()).map_err(told)?) };
    let of_measures = measured.iter().flat_map(|measured| &measured.notes);
    let notes: Vec<String> = made.notes.iter().chain(of_measures).map(|note| note.shown(&Flags)).collect();
    let record = RemeshRecord {
        version: record::VERSION,
        command: record::command(),
        seed: request.seed,
        parameters: &made.parameters,
        quality: measured.as_ref().map(|measured| measured.quality),
        distance: measured.as_ref().map(|measured| measured.distance),
        self_intersections: measured.as_ref().map(|measured| measured.self_intersections),
        run: &made.report,
        breaches: measured.as_ref().map_or(&[], |measured| &measured.breaches),
        missed: measured.as_ref().map_or(&[], |measured| &measured.missed),
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
    plot: Option<Target>,
    report: Option<Target>,
}

impl Targets {
    fn new(args: &Remesh) -> anyhow::Result<Self> {
        let force = args.run.force;
        let mesh = Target::any(&args.output, force)?;
        let format = match args.format {
            Some(format) => format,
            None if mesh.is_stdout() => MeshFormat::Ply,
            None => MeshFormat::of_path(&args.output)?,
        };
        let format = match (args.ascii, format) {
            (true, MeshFormat::Ply) => MeshFormat::PlyText,
            (true, _) => bail!("--ascii is for .ply, which is else binary"),
            (false, format) => format,
        };
        if format == MeshFormat::GeoJson {
            bail!("GeoJSON is flat; a surface goes into .ply .obj .off .stl .vtu .msh or .npz");
        }
        if args.json && mesh.is_stdout() {
            bail!("--json and the mesh cannot both go to stdout; name a file with -o, or with --report");
        }
        let plot = args.plot.as_ref().map(|path| Target::figure(path, force)).transpose()?;
        let report = args.report.as_ref().map(|path| Target::any(path, force)).transpose()?;
        session::require_distinct(&[Some(&mesh), plot.as_ref(), report.as_ref()])?;
        Ok(Self { mesh, format, plot, report })
    }
}

/// A run's whole record.
#[derive(Serialize)]
struct RemeshRecord<'a> {
    version: &'static str,
    command: String,
    seed: u64,
    parameters: &'a Value,
    /// None of an interrupted run, as what follows.
    quality: Option<SurfaceQuality>,
    distance: Option<SurfaceDistance>,
    self_intersections: Option<usize>,
    run: &'a Report,
    /// Triangles whose angles are not what the targets imply, the worst first.
    breaches: &'a [CertificateBreach],
    /// Lengths that are not what was asked for, where the run has not converged.
    missed: &'a [MissedLengths],
    notes: &'a [String],
    seconds: f64,
}

/// What was said before is not said again.
fn summarize(name: &str, record: &RemeshRecord, told: &[String]) {
    for note in record.notes.iter().filter(|note| !told.contains(note)) {
        say(format_args!("note: {note}"));
    }
    let (Some(quality), Some(distance), Some(self_intersections)) = (&record.quality, record.distance, record.self_intersections) else {
        say(format_args!(
            "{name}: seed {}, interrupted after {} passes, {:.2} s; not measured",
            record.seed, record.run.iterations, record.seconds
        ));
        return;
    };
    let &SurfaceQuality { n_vertices, n_triangles, euler_characteristic, n_boundary_edges, .. } = quality;
    let &SurfaceQuality { min_angle_deg, max_angle_deg, mean_min_angle_deg, obtuse_triangles, .. } = quality;
    let &SurfaceQuality { min_quality, mean_quality, valence_567_fraction, beta, .. } = quality;
    let boundary = if n_boundary_edges > 0 { format!(", {n_boundary_edges} edges on the boundary") } else { String::new() };
    say(format_args!(
        "{name}: {n_vertices} vertices, {n_triangles} triangles, Euler characteristic {euler_characteristic}{boundary}, seed {}, {} passes, {:.2} s",
        record.seed, record.run.iterations, record.seconds
    ));
    say(format_args!(
        "angles {min_angle_deg:.2} to {max_angle_deg:.2} degrees (mean of the smallest {mean_min_angle_deg:.2}), {obtuse_triangles} obtuse triangles, \
         quality {min_quality:.3} (mean {mean_quality:.3}), {:.2} % of valences 5 to 7, beta {beta:.3}",
        100.0 * valence_567_fraction
    ));
    let SurfaceDistance { rms, hausdorff, max_from_reference, .. } = distance;
    say(format_args!(
        "distance to the input: RMS {rms:.2e}, Hausdorff {hausdorff:.2e} of the diagonal (input to mesh {max_from_reference:.3e}), {self_intersections} self-intersections"
    ));
    quality.size_errors.iter().for_each(say);
    for missed in record.missed {
        say(format_args!("not reached: {missed}"));
    }
    let places = places(record.breaches, NEAR * quality.max_edge, |breach| breach.at);
    if !record.breaches.is_empty() {
        say(format_args!("not as the targets imply: {}", counted(record.breaches.len(), &places)));
    }
    for Place { n, worst: CertificateBreach { at: [x, y, z], min_angle_deg, max_angle_deg, .. } } in places.iter().take(NAMED) {
        say(format_args!("  {n} here, the worst of {min_angle_deg:.2} to {max_angle_deg:.2} degrees at ({x}, {y}, {z})"));
    }
    if places.len() > NAMED {
        say(format_args!("  {} more places; --report has all", places.len() - NAMED));
    }
}
