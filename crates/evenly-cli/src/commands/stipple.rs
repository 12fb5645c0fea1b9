//! `evenly stipple`: a picture as dots of one pen, or of four.

use std::path::PathBuf;
use std::time::Instant;

use anyhow::{Context as _, bail};
use evenly::{CancelToken, PointSet, Rectangle, tessellate};
use evenly_io::{Drawing, Format, Layer, Marks, Photograph, Target, write_points};
use evenly_jobs::{DotLayer, Ending, StippleOutcome, ToneReport};
use serde::Serialize;

use crate::files::Files;
use crate::stipple::{Paper, edges_of};
use crate::stipple_args::{DotKind, Stipple};
use crate::talk::say;
use crate::watch::Watch;
use crate::wording::told;
use crate::{record, session};

/// The thinnest pen.
const FINEST_MM: f64 = 0.001;
/// The width of edges, where none is given.
const LINE_MM: f64 = 0.3;
/// Pens that are sold.
const PENS_MM: [f64; 7] = [0.1, 0.2, 0.3, 0.4, 0.5, 0.7, 1.0];
/// Widths by less than this ratio away from a pen's are drawn by it.
const SAME: f64 = 1.45;

pub fn run(args: &Stipple) -> anyhow::Result<u8> {
    let begin = Instant::now();
    let targets = Targets::new(args)?;
    if let Some(pen) = args.pen.filter(|&pen| pen < FINEST_MM) {
        bail!("--pen is {pen} mm; it must be {FINEST_MM} mm or more");
    }
    if args.edges.is_some() && args.n_points < 3 {
        bail!("--n-points is {}; edges take 3 dots or more", args.n_points);
    }
    let mut files = Files::default();
    let request = args.request(&mut files);
    request.check().map_err(told)?;
    let pool = session::pool(args.run.threads, args.run.quiet)?;
    let cancel = CancelToken::default();
    let mut watch = Watch::new("{msg} [{bar:30}]{left}", &cancel, args.run.quiet);
    let name = args.input.display().to_string();
    let picture = Photograph::read(&args.input)?;
    let paper = Paper::new(&args.page, args.margin, picture.size())?;
    if let Some(pen) = args.pen.filter(|_| !args.run.quiet && args.edges.is_none()) {
        // Before the work: whoever reads it may want another pen. Dots of several sizes are paler still.
        let share = args.n_points as f64 * dot_area(pen / paper.mm_per_px) / request.ink_area(&picture).map_err(told)?;
        ink_note(share, args.n_points, pen, true).into_iter().for_each(say);
    }
    files.picture = Some(picture);
    let made = watch.run(&pool, |context| request.run(&mut files, context))?;
    let StippleOutcome { layers: drawn, picture_px, .. } = &made;
    let pen_mm = args.pen.unwrap_or_else(|| match args.edges {
        Some(_) => LINE_MM,
        None => {
            // The widest that suits all layers, as pens are sold.
            let mm = drawn.iter().map(|drawn| drawn.widest_px).fold(f64::INFINITY, f64::min) * paper.mm_per_px;
            sold(mm)
        }
    });
    let layers = drawn.iter().map(|drawn| layer(drawn, args, &paper, pen_mm)).collect::<Result<Vec<Layer>, evenly::Error>>();
    let drawing = Drawing { page_mm: paper.size_mm, layers: layers.with_context(|| name.clone())? };
    let pen_up_mm: f64 = drawing.layers.iter().map(|layer| layer.marks.pen_up_mm()).sum();

    let recipe = record::recipe(Some(args.seed));
    if targets.output.format().holds_points() {
        write_points(&united(drawn)?, &[], &recipe, &targets.output)?;
    } else {
        pool.install(|| drawing.write(&recipe, &targets.output))?;
    }
    if let Some(preview) = &targets.preview {
        pool.install(|| drawing.write(&recipe, preview))?;
    }
    let n_points: usize = drawn.iter().map(|drawn| drawn.points.n_points()).sum();
    if !args.run.quiet {
        let [width, height] = paper.size_mm.map(|side| (100.0 * side).round() / 100.0);
        let seconds = begin.elapsed().as_secs_f64();
        let how = if cancel.is_cancelled() { ", interrupted before they were at rest" } else { "" };
        say(format_args!("{}: {n_points} dots, seed {}{how}, {seconds:.2} s", targets.output.name(), args.seed));
        let way = if args.edges.is_none() { format!("; between dots the pen goes {:.2} m", 1e-3 * pen_up_mm.abs()) } else { String::new() };
        say(format_args!("paper {width} x {height} mm, pen {pen_mm:.3} mm{way}"));
        if args.edges.is_none() && args.pen.is_none() {
            ink_note(share(drawn, pen_mm / paper.mm_per_px), n_points, pen_mm, false).into_iter().for_each(say);
        }
    }
    if let Some(report) = &targets.report {
        let layers = drawn.iter().filter_map(|drawn| pool.install(|| layer_record(drawn, pen_mm / paper.mm_per_px)).transpose());
        let record = Record {
            version: record::VERSION,
            command: record::command(),
            method: args.method.name().into(),
            seed: args.seed,
            picture_px: *picture_px,
            page_mm: paper.size_mm,
            pen_mm,
            mm_per_px: paper.mm_per_px,
            n_points,
            pen_up_mm,
            seconds: begin.elapsed().as_secs_f64(),
            is_interrupted: cancel.is_cancelled(),
            layers: layers.collect::<Result<_, _>>()?,
        };
        report.write((serde_json::to_string_pretty(&record)? + "\n").as_bytes())?;
    }
    Ok(session::code(if cancel.is_cancelled() { Ending::Cancelled } else { made.ending() }))
}

/// Where everything goes, checked before the work begins.
struct Targets {
    output: Target,
    preview: Option<Target>,
    report: Option<Target>,
}

impl Targets {
    fn new(args: &Stipple) -> anyhow::Result<Self> {
        let output = Target::new(&args.output, args.format, args.run.force)?;
        let preview = if args.preview { Some(output.beside(Format::Png)?) } else { None };
        let any = |path: &PathBuf| Target::any(path, args.run.force);
        let report = args.report.as_ref().map(any).transpose()?;
        let input = Target::any(&args.input, true).ok();
        let all: Vec<&Target> = [input.as_ref().filter(|input| !input.is_stdout()), Some(&output), preview.as_ref(), report.as_ref()]
            .into_iter()
            .flatten()
            .collect();
        for (k, target) in all.iter().enumerate() {
            if all[..k].iter().any(|other| other.is_same(target)) {
                bail!("{}: the picture and each output must be files of their own", target.name());
            }
        }
        Ok(Self { output, preview, report })
    }
}

/// What `--report` holds.
#[derive(Serialize)]
struct Record {
    version: &'static str,
    command: String,
    method: String,
    seed: u64,
    picture_px: [usize; 2],
    page_mm: [f64; 2],
    pen_mm: f64,
    mm_per_px: f64,
    n_points: usize,
    /// How far the pen goes from dot to dot.
    pen_up_mm: f64,
    seconds: f64,
    is_interrupted: bool,
    layers: Vec<LayerRecord>,
}

#[derive(Serialize)]
struct LayerRecord {
    name: &'static str,
    n_points: usize,
    /// As in `analyze`.
    density_error: Option<f64>,
    #[serde(flatten)]
    tone: ToneReport,
}

/// The dots of one pen, or the edges between them, on the paper.
fn layer(drawn: &DotLayer, args: &Stipple, paper: &Paper, pen_mm: f64) -> Result<Layer, evenly::Error> {
    let places = drawn.points.positions().iter().map(|&p| paper.place(p));
    let dots = || places.zip(&drawn.areas).map(|(place, area)| (place, diameter(pen_mm, *area))).collect();
    let marks = match (args.edges, args.dots) {
        // A layer of so few has no edges.
        (Some(_), _) if drawn.points.n_points() < 3 => Marks::Lines(Vec::new()),
        (Some(edges), _) => {
            let lines = edges_of(&tessellate(&drawn.points)?, edges);
            Marks::Lines(lines.into_iter().map(|line| line.map(|p| paper.place(p))).collect())
        }
        (None, DotKind::Path) => Marks::Dots(dots()),
        (None, DotKind::Circle) => Marks::Circles(dots()),
    };
    Ok(Layer { name: drawn.name.into(), colour: drawn.colour, pen_mm, marks })
}

fn layer_record(drawn: &DotLayer, pen_px: f64) -> Result<Option<LayerRecord>, evenly::Error> {
    let Some(wanted) = &drawn.wanted else { return Ok(None) };
    let radii: Vec<f64> = drawn.areas.iter().map(|&area| 0.5 * diameter(pen_px, area)).collect();
    Ok(Some(LayerRecord {
        name: drawn.name,
        n_points: drawn.points.n_points(),
        density_error: drawn.density_error,
        tone: wanted.compare(&drawn.points, &radii)?,
    }))
}

/// Of dots with a part of the picture's darkness within this range nothing is said. The widest dots that do not
/// touch are paler than the picture by design.
const USUAL_INK: std::ops::RangeInclusive<f64> = 0.8..=1.25;
const USUAL_OF_WIDEST: f64 = 0.5;

/// The area of a dot of this diameter.
fn dot_area(diameter: f64) -> f64 {
    0.25 * std::f64::consts::PI * diameter * diameter
}

/// The part of the picture's darkness that dots have.
fn share(drawn: &[DotLayer], pen_px: f64) -> f64 {
    let ink: f64 = drawn.iter().flat_map(|drawn| &drawn.areas).map(|area| area * dot_area(pen_px)).sum();
    ink / drawn.iter().map(|drawn| drawn.mean_darkness * drawn.points.space().area()).sum::<f64>()
}

/// The pen that is sold next to this width, by the ratio of the two; what is finer or wider than any is taken as it is.
fn sold(mm: f64) -> f64 {
    let away = |pen: f64| if pen > mm { pen / mm } else { mm / pen };
    let nearest = PENS_MM.into_iter().min_by(|&a, &b| away(a).total_cmp(&away(b)));
    // To a hundredth of a millimetre, where that is fine enough.
    let exact = if mm > 0.05 { (100.0 * mm).floor() / 100.0 } else { mm };
    nearest.filter(|&pen| away(pen) < SAME).unwrap_or(exact)
}

/// Says that dots are much paler than the picture, or darker, and what would do.
fn ink_note(share: f64, n_points: usize, pen_mm: f64, is_pen_given: bool) -> Option<String> {
    let is_usual = USUAL_INK.contains(&share) || !is_pen_given && (USUAL_OF_WIDEST..=USUAL_INK.end() * 1.2).contains(&share);
    if !share.is_finite() || is_usual {
        return None;
    }
    let digits = if share < 0.1 { 2 } else { 0 };
    let whole = format!("note: the dots have {:.digits$} % of the picture's darkness", 100.0 * share);
    Some(if is_pen_given || share > 1.0 {
        let (n_needed, pen_needed) = ((n_points as f64 / share).round(), pen_mm / share.sqrt());
        format!("{whole}; {n_needed} dots would have all of it, or a pen of {pen_needed:.2} mm")
    } else {
        format!("{whole}: where it is darkest, more would make them touch; --pen, --contrast or --gamma change that")
    })
}

/// Of a dot, in steps of a sixteenth of the pen, as dots of one size are drawn together.
fn diameter(pen: f64, area: f64) -> f64 {
    pen * (16.0 * area.sqrt()).round() / 16.0
}

/// The dots of all pens, one after the other.
fn united(drawn: &[DotLayer]) -> Result<PointSet, evenly::Error> {
    let Some(first) = drawn.first() else { return PointSet::new(Rectangle::new([0.0; 2], [1.0; 2])?, Vec::new()) };
    PointSet::new(first.points.space(), drawn.iter().flat_map(|drawn| drawn.points.positions()).copied().collect())
}
