//! `evenly stipple`: a picture as dots of one pen, or of four.

use std::path::PathBuf;
use std::time::Instant;

use anyhow::{Context as _, bail};
use evenly::{CancelToken, Density, PointSet, Rectangle, Space, measure, tessellate};
use evenly_io::{Drawing, Format, Layer, Marks, Photograph, Target, write_points};
use serde::Serialize;

use crate::stipple::{Dots, DotsParams, Ink, Paper, ToneReport, Tones, Wanted, dots, edges_of, optimizer, shares};
use crate::stipple_args::{DotKind, Stipple};
use crate::talk::say;
use crate::{interrupt, memory, record, session};

/// The thinnest pen.
const FINEST_MM: f64 = 0.001;
/// The width of edges, where none is given.
const LINE_MM: f64 = 0.3;

pub fn run(args: &Stipple) -> anyhow::Result<u8> {
    let begin = Instant::now();
    let targets = Targets::new(args)?;
    if let Some(pen) = args.pen.filter(|&pen| pen < FINEST_MM) {
        bail!("--pen is {pen} mm; it must be {FINEST_MM} mm or more");
    }
    if args.edges.is_some() && args.n_points < 3 {
        bail!("--n-points is {}; edges take 3 dots or more", args.n_points);
    }
    memory::require_points(args.n_points, args.method)?;
    let tone = args.tone.tone()?;
    // For bad usage, before a long read.
    args.method_args.refuse_others(&[args.method])?;
    optimizer(args.method, &args.method_args.of(args.method), args.seed)?;
    let pool = session::pool(args.run.threads, args.run.quiet)?;
    let photograph = Photograph::read(&args.input)?;
    let name = photograph.name();
    let picture_px = photograph.size();
    let paper = Paper::new(&args.page, args.margin, picture_px)?;
    let space: Space = Rectangle::new([0.0, 0.0], picture_px.map(|n| n as f64)).with_context(|| name.to_owned())?.into();
    let inks = Ink::of(&photograph, &tone, args.layers);

    let cancel = CancelToken::default();
    let mut drawn = Vec::new();
    // Of each layer another, so that no two put their dots in the same places.
    let seeds = (0..).map(|layer| args.seed.wrapping_add(layer));
    for ((ink, n_points), seed) in inks.iter().zip(shares(&inks, args.n_points)).zip(seeds).filter(|((_, n), _)| *n > 0) {
        let tones = ink.tones(&photograph, &tone, args.sizes)?;
        let work = || Drawn::new(args, space.clone(), ink, &tones, n_points, seed, &cancel);
        drawn.push(pool.install(work).with_context(|| name.to_owned())?);
    }
    let pen_mm = args.pen.unwrap_or_else(|| match args.edges {
        Some(_) => LINE_MM,
        None => {
            // The widest that suits all layers, as pens are sold: to a hundredth of a millimetre, where that is fine enough.
            let mm = drawn.iter().map(|drawn| drawn.widest_px).fold(f64::INFINITY, f64::min) * paper.mm_per_px;
            if mm > 0.05 { (100.0 * mm).floor() / 100.0 } else { mm }
        }
    });
    let layers = drawn.iter().map(|drawn| drawn.layer(args, &paper, pen_mm)).collect::<Result<Vec<Layer>, evenly::Error>>();
    let drawing = Drawing { page_mm: paper.size_mm, layers: layers.with_context(|| name.to_owned())? };
    let pen_up_mm: f64 = drawing.layers.iter().map(|layer| layer.marks.pen_up_mm()).sum();

    let recipe = record::recipe(Some(args.seed));
    if targets.output.format().holds_points() {
        write_points(&united(&space, &drawn)?, &[], &recipe, &targets.output)?;
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
        if args.edges.is_none() {
            ink_note(&drawn, pen_mm, paper.mm_per_px, args.pen.is_some()).into_iter().for_each(say);
        }
    }
    if let Some(report) = &targets.report {
        let layers = drawn.iter().filter_map(|drawn| pool.install(|| drawn.report(pen_mm / paper.mm_per_px)).transpose());
        let record = Record {
            version: record::VERSION,
            command: record::command(),
            method: args.method.name().into(),
            seed: args.seed,
            picture_px,
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
    Ok(if cancel.is_cancelled() { interrupt::code() } else { session::DONE })
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

/// The dots of one pen.
struct Drawn<'a> {
    ink: &'a Ink,
    points: PointSet,
    /// Of the dots, relative to the largest.
    areas: Vec<f64>,
    /// The largest dot that suits them.
    widest_px: f64,
    /// What only the report takes.
    density_error: Option<f64>,
    wanted: Option<Wanted>,
}

impl<'a> Drawn<'a> {
    fn new(
        args: &Stipple,
        space: Space,
        ink: &'a Ink,
        tones: &Tones,
        n_points: usize,
        seed: u64,
        cancel: &CancelToken,
    ) -> anyhow::Result<Self> {
        let params = DotsParams { method: args.method, settings: args.method_args.of(args.method), sizes: args.sizes, order: args.order };
        let bar = session::bar(args.run.quiet, 1000, "{msg} [{bar:30}] {eta} left");
        let mut run = session::context(&bar, cancel, args.run.quiet);
        let made = dots(&params, space, ink, tones, n_points, seed, &mut run)?;
        bar.finish_and_clear();
        let Dots { points, areas, widest_px } = made;
        let has_report = args.report.is_some();
        Ok(Self {
            ink,
            widest_px,
            density_error: if has_report { measure(&points).ok().and_then(|measures| measures.density_error) } else { None },
            wanted: if has_report { Some(Wanted::new(&points, &tones.darkness, ink.mean_darkness)?) } else { None },
            // The density's pixels are not needed any more.
            points: points.with_density(&Density::uniform()),
            areas,
        })
    }

    fn layer(&self, args: &Stipple, paper: &Paper, pen_mm: f64) -> Result<Layer, evenly::Error> {
        let places = self.points.positions().iter().map(|&p| paper.place(p));
        let dots = || places.zip(&self.areas).map(|(place, area)| (place, diameter(pen_mm, *area))).collect();
        let marks = match (args.edges, args.dots) {
            // A layer of so few has no edges.
            (Some(_), _) if self.points.n_points() < 3 => Marks::Lines(Vec::new()),
            (Some(edges), _) => {
                let lines = edges_of(&tessellate(&self.points)?, edges);
                Marks::Lines(lines.into_iter().map(|line| line.map(|p| paper.place(p))).collect())
            }
            (None, DotKind::Path) => Marks::Dots(dots()),
            (None, DotKind::Circle) => Marks::Circles(dots()),
        };
        Ok(Layer { name: self.ink.name().into(), colour: self.ink.colour(), pen_mm, marks })
    }

    fn report(&self, pen_px: f64) -> Result<Option<LayerRecord>, evenly::Error> {
        let Some(wanted) = &self.wanted else { return Ok(None) };
        let radii: Vec<f64> = self.areas.iter().map(|&area| 0.5 * diameter(pen_px, area)).collect();
        Ok(Some(LayerRecord {
            name: self.ink.name(),
            n_points: self.points.n_points(),
            density_error: self.density_error,
            tone: wanted.compare(&self.points, &radii)?,
        }))
    }
}

/// Of dots with a part of the picture's darkness within this range nothing is said. The widest dots that do not
/// touch are paler than the picture by design.
const USUAL_INK: std::ops::RangeInclusive<f64> = 0.8..=1.25;
const USUAL_OF_WIDEST: f64 = 0.5;

/// Says that dots are much paler than the picture, or darker, and what would do.
fn ink_note(drawn: &[Drawn], pen_mm: f64, mm_per_px: f64, is_pen_given: bool) -> Option<String> {
    let pen_px = pen_mm / mm_per_px;
    let of_dots = |drawn: &Drawn| drawn.areas.iter().map(|area| 0.25 * std::f64::consts::PI * pen_px * pen_px * area).sum::<f64>();
    let ink: f64 = drawn.iter().map(of_dots).sum();
    let wanted: f64 = drawn.iter().map(|drawn| drawn.ink.mean_darkness * drawn.points.space().area()).sum();
    let share = ink / wanted;
    let is_usual = USUAL_INK.contains(&share) || !is_pen_given && (USUAL_OF_WIDEST..1.0).contains(&share);
    if !share.is_finite() || is_usual {
        return None;
    }
    let n_points: usize = drawn.iter().map(|drawn| drawn.points.n_points()).sum();
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
fn united(space: &Space, drawn: &[Drawn]) -> Result<PointSet, evenly::Error> {
    PointSet::new(space, drawn.iter().flat_map(|drawn| drawn.points.positions()).copied().collect())
}
