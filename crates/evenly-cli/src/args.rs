//! The arguments: each flag is described here once, for the help, the man page and the completions.

use std::path::PathBuf;

use anyhow::{anyhow, bail};
use clap::{Args, Parser, Subcommand, ValueEnum};
use evenly::{
    Error, MAX_POINTS, Mode, ProcrustesParams, PushPullParams, PushPullPreset, Rectangle, Schedule, Space, Torus, WellSpacedParams,
};
use evenly_io::{Draw, Format};

use crate::optimizer::Optimizer;

const EXAMPLES: &str = "\
Examples:
  evenly generate -n 10000 --method procrustes -o points.svg
  evenly generate -n 10000 --seed 7 -o points.txt --report run.json
  evenly generate -n 10000 --method push-pull --min-distance 0.85 --coverage-radius 0.67 -o points.csv
  evenly optimize points.csv --size 640,480 -o better.csv
  evenly analyze better.csv --size 640,480 --json

Exit codes: 0 done; 1 done, but not converged or a target not reached; 2 bad usage or input, or no output; 130 interrupted, state reached written";

/// Spreads points evenly, but not regularly: blue noise.
#[derive(Parser)]
#[command(name = "evenly", version, after_help = EXAMPLES, max_term_width = 110)]
pub struct Cli {
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Subcommand)]
pub enum Command {
    /// Make points from nothing
    Generate(Generate),
    /// Make better points from points
    Optimize(Optimize),
    /// Measure points: the proof
    Analyze(Analyze),
    /// Print a completion script for a shell
    Completions {
        /// The shell
        shell: clap_complete::Shell,
    },
    /// Print the manual page, in roff
    Man,
}

#[derive(Args)]
#[command(after_help = "Example:\n  evenly generate -n 10000 --method procrustes -o points.svg --draw valence,points")]
pub struct Generate {
    /// How many points, exactly: 1 to 40 million
    #[arg(short, long, value_name = "N", value_parser = parse_count, allow_negative_numbers = true)]
    pub n_points: usize,
    /// How they are made: by an optimiser, or as one of its starts
    #[arg(long, value_enum, default_value = "procrustes")]
    pub method: GenerateMethod,
    /// What an optimiser starts from [default: white]
    #[arg(long, value_enum)]
    pub start: Option<Start>,
    /// The same seed gives the same points
    #[arg(short, long, value_name = "SEED", default_value_t = 0, allow_negative_numbers = true)]
    pub seed: u64,
    #[command(flatten)]
    pub space: SpaceArgs,
    #[command(flatten)]
    pub optimizer: OptimizerArgs,
    #[command(flatten)]
    pub run: RunArgs,
}

#[derive(Args)]
#[command(after_help = "Example:\n  evenly optimize in.csv --space rect --size 640,480 -o out.csv")]
pub struct Optimize {
    /// Points as .txt, .csv or .npy; - is stdin
    pub input: PathBuf,
    /// How they are improved
    #[arg(long, value_enum, default_value = "procrustes")]
    pub method: OptimizeMethod,
    /// The same seed gives the same points; Procrustes analysis uses none
    #[arg(short, long, value_name = "SEED", default_value_t = 0, allow_negative_numbers = true)]
    pub seed: u64,
    #[command(flatten)]
    pub space: SpaceArgs,
    #[command(flatten)]
    pub optimizer: OptimizerArgs,
    #[command(flatten)]
    pub run: RunArgs,
}

#[derive(Args)]
#[command(after_help = "Example:\n  evenly analyze points.txt --json --plot valence.png --draw valence,points")]
pub struct Analyze {
    /// Points as .txt, .csv or .npy; - is stdin
    pub input: PathBuf,
    #[command(flatten)]
    pub space: SpaceArgs,
    /// Print the measures as JSON
    #[arg(long)]
    pub json: bool,
    /// Draw the points, as .svg or .png
    #[arg(long, value_name = "FILE")]
    pub plot: Option<PathBuf>,
    /// The figure's layers
    #[arg(long, value_enum, value_delimiter = ',', default_value = "points", requires = "plot")]
    pub draw: Vec<DrawArg>,
    /// Overwrite an existing figure
    #[arg(long)]
    pub force: bool,
    /// Threads; the result does not depend on them [default: all]
    #[arg(short = 'j', long, value_name = "J", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
}

#[derive(Args)]
pub struct SpaceArgs {
    /// The domain: torus (periodic, its sets tile the plane) or rect (bounded)
    #[arg(long, value_enum, default_value = "torus")]
    pub space: SpaceKind,
    /// Width and height
    #[arg(long, value_name = "W,H", default_value = "1,1", value_parser = parse_pair, allow_hyphen_values = true)]
    pub size: [f64; 2],
    /// Lower left corner
    #[arg(long, value_name = "X,Y", default_value = "0,0", value_parser = parse_pair, allow_hyphen_values = true)]
    pub origin: [f64; 2],
}

/// What an optimiser can be told. Flags of one method are refused by another.
#[derive(Args)]
pub struct OptimizerArgs {
    /// Keep the start's own long density waves; without it white noise, and any input, is evened out first
    #[arg(long)]
    pub no_warp: bool,
    /// Stop after so many iterations or passes in any case [default: 500; push-pull and well-spaced: 2000, more for more than 1000 points]
    #[arg(short, long, value_name = "I", allow_negative_numbers = true)]
    iterations: Option<usize>,
    #[command(flatten)]
    procrustes: ProcrustesArgs,
    #[command(flatten)]
    push_pull: PushPullArgs,
    #[command(flatten)]
    well_spaced: WellSpacedArgs,
}

#[derive(Args)]
#[command(next_help_heading = "Procrustes")]
struct ProcrustesArgs {
    /// paper: plain steps, the energy never rises (but where a rectangle is triangulated anew); fast: momentum [default: fast]
    #[arg(long, value_enum, hide_possible_values = true)]
    mode: Option<ModeArg>,
    /// Side of the model triangle in hexagonal spacings, good within 1 to 1.625 [default: 1.5]
    #[arg(long, value_name = "D", allow_negative_numbers = true, hide_short_help = true)]
    side: Option<f64>,
    /// Stop when an iteration (fast: two in a row) gains less than this share of the domain's area [default: 0.00002]
    #[arg(long, value_name = "T", allow_negative_numbers = true)]
    tolerance: Option<f64>,
}

#[derive(Args)]
#[command(next_help_heading = "Push-Pull")]
struct PushPullArgs {
    /// Targets, with the tolerance and relaxation that they need; the flags below change them one by one [default: balanced]
    #[arg(long, value_enum)]
    preset: Option<PresetArg>,
    /// No two points nearer than this many hexagonal spacings, up to 1; or off
    #[arg(long, value_name = "R", value_parser = parse_target, allow_negative_numbers = true)]
    min_distance: Option<Target>,
    /// No place farther from a point than this many hexagonal spacings, 0.577 at least; or off
    #[arg(long, value_name = "R", value_parser = parse_target, allow_negative_numbers = true)]
    coverage_radius: Option<Target>,
    /// No Voronoi cell's area farther from the mean than this part of it; or off. Where a target is given without a preset, lengths that are not
    /// given are off, and this is 0.0386
    #[arg(long, value_name = "T", value_parser = parse_target, allow_negative_numbers = true)]
    capacity_tolerance: Option<Target>,
    /// The part of each move that is made; 1.2 reaches tougher targets, in turn [default: the preset's, 1; summed: 0.5]
    #[arg(long, value_name = "W", allow_negative_numbers = true)]
    relaxation: Option<f64>,
    /// in-turn: points move at each visit; summed: at the end of a pass, the paper's parallel variant [default: in-turn]
    #[arg(long, value_enum, hide_possible_values = true, hide_short_help = true)]
    schedule: Option<ScheduleArg>,
}

#[derive(Args)]
#[command(next_help_heading = "Well-spaced")]
struct WellSpacedArgs {
    /// Coverage radius over smallest distance: below 0.707 no triangle is obtuse; on a torus 0.67 is reached, in a rectangle 0.72 [default: 0.75]
    #[arg(long, value_name = "B", allow_negative_numbers = true)]
    beta: Option<f64>,
}

/// A number, or none.
#[derive(Clone, Copy)]
pub struct Target(Option<f64>);

#[derive(Args)]
#[command(next_help_heading = "Output")]
pub struct RunArgs {
    /// Where the points go: .txt .csv .npy, or as a figure .svg .png; - is stdout
    #[arg(short, long, value_name = "OUT")]
    pub output: PathBuf,
    /// The output's format, txt csv npy svg or png, if its name does not tell
    #[arg(long, value_parser = parse_format)]
    pub format: Option<Format>,
    /// A figure's layers
    #[arg(long, value_enum, value_delimiter = ',', value_name = "LAYERS")]
    pub draw: Option<Vec<DrawArg>>,
    /// Write the run's whole record, as JSON
    #[arg(long, value_name = "FILE")]
    pub report: Option<PathBuf>,
    /// Print the run's whole record on stdout, as JSON
    #[arg(long)]
    pub json: bool,
    /// Overwrite existing files
    #[arg(long)]
    pub force: bool,
    /// Threads; the result does not depend on them [default: all]
    #[arg(short = 'j', long, value_name = "J", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
    /// Say nothing but errors
    #[arg(short, long, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Say more
    #[arg(short, long)]
    pub verbose: bool,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
pub enum GenerateMethod {
    /// Procrustes analysis (Papazov and Hege)
    Procrustes,
    /// Push-pull optimization (Ahmed, Guo, Yan et al.)
    PushPull,
    /// Low beta, the ratio of the largest gap to the smallest distance (Ebeida et al.)
    WellSpaced,
    /// Independent uniform points
    White,
    /// One point in each cell of a grid
    Jittered,
    /// The hexagonal lattice
    Hexagonal,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
pub enum OptimizeMethod {
    /// Procrustes analysis (Papazov and Hege)
    Procrustes,
    /// Push-pull optimization (Ahmed, Guo, Yan et al.)
    PushPull,
    /// Low beta, the ratio of the largest gap to the smallest distance (Ebeida et al.)
    WellSpaced,
    /// Even out long density waves, and nothing else
    Warp,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
pub enum Start {
    /// Independent uniform points
    White,
    /// One point in each cell of a grid, whose order outlives an optimiser as peaks in the spectrum
    Jittered,
    /// The hexagonal lattice
    Hexagonal,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
pub enum SpaceKind {
    /// Opposite sides are one
    Torus,
    /// Bounded
    #[value(alias = "rectangle")]
    Rect,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum ModeArg {
    /// Plain steps
    Paper,
    /// Momentum
    Fast,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum ScheduleArg {
    /// Points move at each visit
    InTurn,
    /// Points move at the end of a pass
    Summed,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum PresetArg {
    /// Distance 0.75, coverage 0.75, tolerance 0.1
    Fast,
    /// 0.85, 0.67, 0.0386
    Balanced,
    /// 0.90, 0.65, 0.0386: the triangles' angles are 43.8 to 92.5 degrees
    Tough,
    /// 0.80, 0.63, 0.0386: row 1 of the paper's Table 1; on a torus
    Paper1,
    /// 0.90, 0.65, 0.0386: row 2
    Paper2,
    /// 0.92, 0.62, 0.1, relaxation 1.2: row 3, no triangle is obtuse; on a torus
    Paper3,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
pub enum DrawArg {
    /// The points
    Points,
    /// The Delaunay triangulation
    Delaunay,
    /// The Voronoi diagram
    Voronoi,
    /// Voronoi cells coloured by their number of neighbours
    Valence,
}

impl From<DrawArg> for Draw {
    fn from(layer: DrawArg) -> Self {
        match layer {
            DrawArg::Points => Self::Points,
            DrawArg::Delaunay => Self::Delaunay,
            DrawArg::Voronoi => Self::Voronoi,
            DrawArg::Valence => Self::Valence,
        }
    }
}

impl SpaceArgs {
    pub fn space(&self) -> Result<Space, Error> {
        Ok(match self.space {
            SpaceKind::Torus => Torus::new(self.origin, self.size)?.into(),
            SpaceKind::Rect => Rectangle::new(self.origin, self.size)?.into(),
        })
    }
}

impl OptimizerArgs {
    pub fn procrustes(&self) -> anyhow::Result<Optimizer> {
        refuse(self.push_pull.given(), "push-pull")?;
        refuse(self.well_spaced.given(), "well-spaced")?;
        let ProcrustesArgs { mode, side, tolerance } = self.procrustes;
        let mut params = ProcrustesParams::default();
        set(&mut params.mode, mode.map(Into::into));
        set(&mut params.side, side);
        set(&mut params.tolerance, tolerance);
        set(&mut params.max_iterations, self.iterations);
        params.validate().map_err(by_flag)?;
        Ok(Optimizer::Procrustes(params))
    }

    pub fn push_pull(&self, seed: u64) -> anyhow::Result<Optimizer> {
        refuse(self.procrustes.given(), "procrustes")?;
        refuse(self.well_spaced.given(), "well-spaced")?;
        let PushPullArgs { preset, min_distance, coverage_radius, capacity_tolerance, relaxation, schedule } = self.push_pull;
        let mut params = PushPullParams::preset(preset.map(Into::into).unwrap_or_default());
        let given = [min_distance, coverage_radius, capacity_tolerance].into_iter().flatten();
        let is_picked = preset.is_none() && { given }.any(|target| target.0.is_some());
        if is_picked {
            (params.min_distance, params.coverage_radius) = (None, None);
        }
        set(&mut params.min_distance, min_distance.map(|target| target.0));
        set(&mut params.coverage_radius, coverage_radius.map(|target| target.0));
        set(&mut params.capacity_tolerance, capacity_tolerance.map(|target| target.0));
        if schedule == Some(ScheduleArg::Summed) {
            (params.schedule, params.relaxation) = (Schedule::Summed, 0.5);
        }
        set(&mut params.relaxation, relaxation);
        params.max_passes = self.iterations;
        params.seed = seed;
        params.validate().map_err(by_flag)?;
        Ok(Optimizer::PushPull(params))
    }

    pub fn well_spaced(&self, seed: u64) -> anyhow::Result<Optimizer> {
        refuse(self.procrustes.given(), "procrustes")?;
        refuse(self.push_pull.given(), "push-pull")?;
        let mut params = WellSpacedParams { max_passes: self.iterations, seed, ..WellSpacedParams::default() };
        set(&mut params.beta, self.well_spaced.beta);
        params.validate().map_err(by_flag)?;
        Ok(Optimizer::WellSpaced(params))
    }

    /// For a method that is no optimiser.
    pub fn none(&self) -> anyhow::Result<()> {
        refuse(self.procrustes.given(), "procrustes")?;
        refuse(self.push_pull.given(), "push-pull")?;
        refuse(self.well_spaced.given(), "well-spaced")?;
        refuse(self.iterations.map(|_| "iterations"), OPTIMIZERS)?;
        refuse(self.no_warp.then_some("no-warp"), OPTIMIZERS)
    }
}

impl ProcrustesArgs {
    /// The first flag that was given.
    fn given(&self) -> Option<&'static str> {
        let flags = [("mode", self.mode.is_some()), ("side", self.side.is_some()), ("tolerance", self.tolerance.is_some())];
        flags.into_iter().find(|&(_, is_given)| is_given).map(|(name, _)| name)
    }
}

impl WellSpacedArgs {
    /// Its flag, if it was given.
    fn given(&self) -> Option<&'static str> {
        self.beta.map(|_| "beta")
    }
}

impl PushPullArgs {
    /// The first flag that was given.
    fn given(&self) -> Option<&'static str> {
        let flags = [
            ("preset", self.preset.is_some()),
            ("min-distance", self.min_distance.is_some()),
            ("coverage-radius", self.coverage_radius.is_some()),
            ("capacity-tolerance", self.capacity_tolerance.is_some()),
            ("relaxation", self.relaxation.is_some()),
            ("schedule", self.schedule.is_some()),
        ];
        flags.into_iter().find(|&(_, is_given)| is_given).map(|(name, _)| name)
    }
}

/// Those that take `--start`, `--iterations` and `--no-warp`.
pub const OPTIMIZERS: &str = "procrustes, push-pull or well-spaced";

/// The same error, with the name that the user knows.
fn by_flag(error: Error) -> anyhow::Error {
    match error {
        Error::InvalidParameter { name, value, expected } => {
            let flag = if name.starts_with("max_") { "iterations".to_owned() } else { name.replace('_', "-") };
            anyhow!("--{flag} is {value}; it must be {expected}")
        }
        other => other.into(),
    }
}

pub fn refuse(flag: Option<&str>, method: &str) -> anyhow::Result<()> {
    match flag {
        Some(flag) => bail!("--{flag} is for --method {method}"),
        None => Ok(()),
    }
}

fn set<T>(field: &mut T, value: Option<T>) {
    if let Some(value) = value {
        *field = value;
    }
}

impl From<ModeArg> for Mode {
    fn from(mode: ModeArg) -> Self {
        match mode {
            ModeArg::Paper => Self::Paper,
            ModeArg::Fast => Self::Fast,
        }
    }
}

impl From<PresetArg> for PushPullPreset {
    fn from(preset: PresetArg) -> Self {
        match preset {
            PresetArg::Fast => Self::Fast,
            PresetArg::Balanced => Self::Balanced,
            PresetArg::Tough => Self::Tough,
            PresetArg::Paper1 => Self::Paper1,
            PresetArg::Paper2 => Self::Paper2,
            PresetArg::Paper3 => Self::Paper3,
        }
    }
}

fn parse_target(text: &str) -> Result<Target, String> {
    if text == "off" {
        return Ok(Target(None));
    }
    text.parse().map(|number| Target(Some(number))).map_err(|_| "it must be a number, or off".to_owned())
}

fn parse_count(text: &str) -> Result<usize, String> {
    let number = text.parse::<usize>().ok().or_else(|| {
        // 1e6 is a count too.
        let number = text.parse::<f64>().ok()?;
        (number.fract() == 0.0 && (0.0..1e15).contains(&number)).then_some(number as usize)
    });
    match number {
        Some(n) if (1..=MAX_POINTS).contains(&n) => Ok(n),
        _ => Err(format!("it must be a whole number from 1 to {MAX_POINTS}")),
    }
}

fn parse_pair(text: &str) -> Result<[f64; 2], String> {
    let numbers: Vec<f64> = text.split(',').map_while(|number| number.trim().parse().ok()).collect();
    match numbers[..] {
        [a, b] if text.split(',').count() == 2 => Ok([a, b]),
        _ => Err("it must be two numbers with a comma between them".into()),
    }
}

fn parse_format(text: &str) -> Result<Format, String> {
    let names: Vec<&str> = Format::ALL.iter().map(|&(name, _)| name).collect();
    Format::from_name(text).ok_or_else(|| format!("it must be one of {}", names.join(", ")))
}
