//! `evenly sample`: points on a surface.

use std::time::Instant;

use anyhow::bail;
use evenly::{CancelToken, Report, TriangleMesh};
use evenly_io::{CloudFormat, Target, write_cloud};
use evenly_jobs::{Ending, place_attributes};
use serde::Serialize;

use crate::files::{Files, require_one_stdin};
use crate::remesh_args::Sample;
use crate::talk::say;
use crate::watch::Watch;
use crate::wording::{Flags, told};
use crate::{record, session};

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
    require_one_stdin(&args.inputs())?;
    let mut files = Files::default();
    let request = args.request(&mut files);
    request.check().map_err(told)?;
    let pool = session::pool(args.run.threads, args.run.quiet)?;
    let cancel = CancelToken::default();
    let mut watch = Watch::new("{bar:30} {percent}% {msg}", &cancel, args.run.quiet);
    let made = watch.run(&pool, |context| request.run(&mut files, context))?;

    let vertices = made.points.iter().map(|point| point.position).collect();
    let cloud = TriangleMesh { vertices, triangles: Vec::new(), attributes: place_attributes(&made.points) };
    write_cloud(&cloud, format, &record::recipe(Some(request.seed)), &target)?;
    let notes: Vec<String> = made.notes.iter().map(|note| note.shown(&Flags)).collect();
    let record = SampleRecord {
        version: record::VERSION,
        command: record::command(),
        seed: request.seed,
        n_points: made.points.len(),
        area: made.area,
        run: &made.report,
        notes: &notes,
        seconds: begin.elapsed().as_secs_f64(),
    };
    if !args.run.quiet {
        for note in notes.iter().filter(|note| !watch.told.contains(note)) {
            say(format_args!("note: {note}"));
        }
        say(format_args!("{}: {} points, seed {}, {:.2} s", target.name(), record.n_points, record.seed, record.seconds));
    }
    if args.json {
        Target::any("-".as_ref(), false)?.write((serde_json::to_string_pretty(&record)? + "\n").as_bytes())?;
    }
    Ok(session::code(if cancel.is_cancelled() { Ending::Cancelled } else { made.ending() }))
}

/// A run's whole record.
#[derive(Serialize)]
struct SampleRecord<'a> {
    version: &'static str,
    command: String,
    seed: u64,
    n_points: usize,
    area: f64,
    run: &'a Report,
    notes: &'a [String],
    seconds: f64,
}
