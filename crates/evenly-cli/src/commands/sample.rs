//! `evenly sample`: points on a surface.

use std::time::Instant;

use anyhow::bail;
use evenly::{CancelToken, Outcome, Report, TriangleMesh};
use evenly_io::{CloudFormat, Target, read_triangles, write_cloud};
use serde::Serialize;

use crate::remesh_args::{Sample, density_path};
use crate::remeshed::{notes_on, place_attributes, sizing, surface_of, welded};
use crate::sampled::sampled;
use crate::talk::say;
use crate::{input, interrupt, record, session};

pub fn run(args: &Sample) -> anyhow::Result<u8> {
    let begin = Instant::now();
    let target = Target::any(&args.output, args.run.force)?;
    let format = match args.format {
        Some(format) => format,
        None if target.is_stdout() => CloudFormat::Txt,
        None => CloudFormat::of_path(&args.output)?,
    };
    let format = match (args.ascii, format) {
        (true, CloudFormat::Ply) => CloudFormat::PlyText,
        (true, _) => bail!("--ascii is for .ply, which is else binary"),
        (false, format) => format,
    };
    if args.json && target.is_stdout() {
        bail!("--json and the points cannot both go to stdout; name a file with -o");
    }
    let wishes = &args.wishes;
    let pool = session::pool(args.run.threads, args.run.quiet)?;
    let density = density_path(wishes.density.as_deref()).map(Into::into);
    input::require_one_stdin([Some(&args.input), density.as_ref()].into_iter().flatten())?;
    let read = read_triangles(&args.input)?;
    let mut notes = read.notes;
    let mesh = welded(read.mesh, wishes.weld, &mut notes)?;
    // Points need no manifold.
    let surface = surface_of(&mesh, &args.input, wishes.repair).or_else(|_| surface_of(&mesh, &args.input, true))?;
    let sizing = sizing(wishes.density.as_deref())?;
    let cancel = CancelToken::default();
    let bar = session::bar(args.run.quiet, 1000, "{bar:30} {percent}% {msg}");
    let made = pool.install(|| {
        let mut context = session::context(&bar, &cancel, args.run.quiet);
        sampled(&surface, &args.input, wishes, sizing.as_ref(), &mut context)
    });
    bar.finish_and_clear();
    let (points, report) = made?;

    let vertices = points.iter().map(|point| point.position).collect();
    let cloud = TriangleMesh { vertices, triangles: Vec::new(), attributes: place_attributes(&points) };
    write_cloud(&cloud, format, &record::recipe(Some(wishes.seed)), &target)?;
    notes.extend(notes_on(&surface));
    notes.extend(report.notes.iter().cloned());
    let record = SampleRecord {
        version: record::VERSION,
        command: record::command(),
        seed: wishes.seed,
        n_points: points.len(),
        area: surface.area(),
        run: report,
        notes: &notes,
        seconds: begin.elapsed().as_secs_f64(),
    };
    if !args.run.quiet {
        for note in &notes {
            say(format_args!("note: {note}"));
        }
        say(format_args!("{}: {} points, seed {}, {:.2} s", target.name(), record.n_points, record.seed, record.seconds));
    }
    if args.json {
        Target::any("-".as_ref(), false)?.write((serde_json::to_string_pretty(&record)? + "\n").as_bytes())?;
    }
    Ok(match record.run.outcome {
        _ if cancel.is_cancelled() => interrupt::code(),
        Outcome::IterationLimit => session::NOT_REACHED,
        _ => session::DONE,
    })
}

/// A run's whole record.
#[derive(Serialize)]
struct SampleRecord<'a> {
    version: &'static str,
    command: String,
    seed: u64,
    n_points: usize,
    area: f64,
    run: Report,
    notes: &'a [String],
    seconds: f64,
}
