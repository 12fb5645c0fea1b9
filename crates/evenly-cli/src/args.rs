//! The arguments: each flag is described here once, for the help, the man page and the completions.

use std::path::PathBuf;

use clap::{Args, Command as Clap, CommandFactory as _, Parser, Subcommand, ValueEnum};
use evenly::{Error, MAX_POINTS, ReconstructionFilter, Rectangle, Space, Torus};
use evenly_io::{Draw, Format};

use crate::method::{Method, parser, with_methods};
use crate::method_args::{OptimizerArgs, StartArgs};

const EXAMPLES: &str = "\
Examples:
  evenly generate -n 10000 --method procrustes -o points.svg
  evenly generate -n 10000 --seed 7 -o points.txt --report run.json
  evenly generate -n 10000 --method push-pull --min-distance 0.85 --coverage-radius 0.67 -o points.csv
  evenly optimize points.csv --size 640,480 -o better.csv
  evenly analyze better.csv --size 640,480 --json
  evenly compare -n 1000 --methods lloyd,well-spaced,push-pull -o table.html

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
    /// Run several methods on the same points, and lay their measures side by side
    Compare(Compare),
    /// Sample the zone plate sin(x^2 + y^2) with points, and measure noise and aliasing
    Zoneplate(Zoneplate),
    /// Filter a picture bilaterally with few pixels, chosen by points, and measure the error
    Bilateral(Bilateral),
    /// Compute a paper's tables and figures anew, beside the printed numbers
    Reproduce(Reproduce),
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
    /// How many points, exactly: 1 to 40 million; poisson-disk takes it as a guess
    #[arg(short, long, value_name = "N", value_parser = parse_count, allow_negative_numbers = true)]
    pub n_points: Option<usize>,
    /// How they are made: by an optimiser, or as one of its starts
    #[arg(long, default_value = "procrustes", value_parser = parser(|method| method != Method::Warp))]
    pub method: Method,
    /// What an optimiser starts from [default: white; opt-beta: poisson-disk]
    #[arg(long, value_parser = parser(Method::is_start), hide_possible_values = true)]
    pub start: Option<Method>,
    /// The same seed gives the same points
    #[arg(short, long, value_name = "SEED", default_value_t = 0, allow_negative_numbers = true)]
    pub seed: u64,
    #[command(flatten)]
    pub space: SpaceArgs,
    #[command(flatten)]
    pub optimizer: OptimizerArgs,
    #[command(flatten)]
    pub starts: StartArgs,
    #[command(flatten)]
    pub run: RunArgs,
}

#[derive(Args)]
#[command(after_help = "Example:\n  evenly optimize in.csv --space rect --size 640,480 -o out.csv")]
pub struct Optimize {
    /// Points as .txt, .csv or .npy; - is stdin
    pub input: PathBuf,
    /// How they are improved
    #[arg(long, default_value = "procrustes", value_parser = parser(|method| method.is_optimizer() || method == Method::Warp))]
    pub method: Method,
    /// The same seed gives the same points; procrustes, opt-beta, cvt and farthest-point use none
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
#[command(after_help = "Examples:\n  evenly analyze points.txt --plot report.pdf\n  evenly analyze a.txt b.txt c.txt --spectrum --json")]
pub struct Analyze {
    /// Points as .txt, .csv or .npy; - is stdin. Of several sets the spectrum is the mean of theirs
    #[arg(required = true)]
    pub inputs: Vec<PathBuf>,
    #[command(flatten)]
    pub space: SpaceArgs,
    /// The power spectrum and the pair correlation too, with the effective Nyquist frequency and the oscillation; the curves in the JSON
    #[arg(long)]
    pub spectrum: bool,
    /// Take each distance in its place's own spacing, for one set whose density varies (differential domain analysis)
    #[arg(long)]
    pub local: bool,
    /// Draw a figure, as .svg, .png or .pdf
    #[arg(long, value_name = "FILE")]
    pub plot: Option<PathBuf>,
    /// What the figure shows
    #[arg(long, value_enum, value_delimiter = ',', value_name = "PARTS", default_value = "report", requires = "plot")]
    pub draw: Vec<DrawArg>,
    #[command(flatten)]
    pub measured: MeasuredArgs,
}

#[derive(Args)]
#[command(
    after_help = "Example:\n  evenly compare -n 1000 --methods lloyd,cvt,well-spaced,push-pull --runs 5 -o table.html\n\nTargets that are missed are no failure here: the table has the share of runs that reached them."
)]
pub struct Compare {
    /// Points that all begin with, as .txt, .csv or .npy; - is stdin [default: new ones for each run, from --start]
    pub input: Option<PathBuf>,
    /// How many points, without an input
    #[arg(short, long, value_name = "N", value_parser = parse_count, allow_negative_numbers = true, conflicts_with = "input")]
    pub n_points: Option<usize>,
    /// What is compared, optimisers and starts [default: all]
    #[arg(long, value_name = "METHODS", value_delimiter = ',', value_parser = parser(|method| method != Method::Warp), hide_possible_values = true)]
    pub methods: Vec<Method>,
    /// How often, each time with the next seed
    #[arg(long, value_name = "K", default_value_t = 3, value_parser = clap::value_parser!(u16).range(1..))]
    pub runs: u16,
    /// What all optimisers start from, without an input [default: white]
    #[arg(long, value_parser = parser(Method::is_start), hide_possible_values = true, conflicts_with = "input")]
    pub start: Option<Method>,
    /// The first run's seed
    #[arg(short, long, value_name = "SEED", default_value_t = 0, allow_negative_numbers = true)]
    pub seed: u64,
    #[command(flatten)]
    pub space: SpaceArgs,
    #[command(flatten)]
    pub optimizer: OptimizerArgs,
    /// Where the table goes: .md .csv (a line a run) .json (all of it) .html (with pictures) [default: stdout, as plain text]
    #[arg(short, long, value_name = "OUT", help_heading = "Output")]
    pub output: Option<PathBuf>,
    /// Overwrite existing files
    #[arg(long, help_heading = "Output")]
    pub force: bool,
    /// Threads; the result does not depend on them [default: all]
    #[arg(short = 'j', long, value_name = "J", value_parser = clap::value_parser!(u16).range(1..), help_heading = "Output")]
    pub threads: Option<u16>,
    /// Say nothing but errors
    #[arg(short, long, help_heading = "Output")]
    pub quiet: bool,
}

#[derive(Args)]
#[command(after_help = "Example:\n  evenly zoneplate points.txt -o plate.png")]
pub struct Zoneplate {
    /// Points as .txt, .csv or .npy; - is stdin. One sample a pixel: a torus is repeated, a rectangle must have enough
    pub input: PathBuf,
    #[command(flatten)]
    pub space: SpaceArgs,
    /// Pixels a side, 16 to 4096
    #[arg(long, value_name = "N", default_value_t = 512)]
    pub pixels: usize,
    /// The wave's frequency at the right side, in waves a pixel: above 0, at most 8
    #[arg(long, value_name = "F", default_value_t = 1.5)]
    pub frequency: f64,
    /// What makes pixels of samples
    #[arg(long, value_enum, default_value = "mitchell")]
    pub filter: FilterArg,
    /// The sampled plate, as .png
    #[arg(short, long, value_name = "OUT")]
    pub output: Option<PathBuf>,
    #[command(flatten)]
    pub measured: MeasuredArgs,
}

#[derive(Args)]
#[command(after_help = "Example:\n  evenly bilateral photo.png --samples points.txt -o filtered.png")]
pub struct Bilateral {
    /// A picture, .png or .jpg; - is stdin
    pub input: PathBuf,
    /// Points as .txt, .csv or .npy: where the picture is looked at. A torus is repeated, a rectangle must have enough
    #[arg(long, value_name = "FILE")]
    pub samples: PathBuf,
    #[command(flatten)]
    pub space: SpaceArgs,
    /// The kernel's width, in pixels: 2 to 1000
    #[arg(long, value_name = "PX", default_value_t = 40.0)]
    pub kernel: f64,
    /// Samples in a kernel, on average
    #[arg(long, value_name = "K", default_value_t = 30.0)]
    pub count: f64,
    /// How different intensities may be and still be mixed, as a standard deviation; white is 1
    #[arg(long, value_name = "R", default_value_t = 0.1)]
    pub range: f64,
    /// The filtered picture, as .png
    #[arg(short, long, value_name = "OUT")]
    pub output: Option<PathBuf>,
    /// The picture filtered with all pixels, as .png
    #[arg(long, value_name = "OUT")]
    pub full: Option<PathBuf>,
    #[command(flatten)]
    pub measured: MeasuredArgs,
}

#[derive(Args)]
#[command(
    after_help = "Example:\n  evenly reproduce push-pull --quick -o pages\n\nInterrupted, it leaves the parts that are done, and the same command goes on with the others."
)]
pub struct Reproduce {
    /// The paper: Papazov and Hege 2017; Ahmed, Guo, Yan et al. 2017; Ebeida et al. 2014
    #[arg(value_parser = ["procrustes", "push-pull", "opt-beta"])]
    pub paper: String,
    /// The folder for PAPER.html and PAPER.json, with --quick PAPER-quick.html and PAPER-quick.json
    #[arg(short, long, value_name = "DIR", default_value = ".")]
    pub output: PathBuf,
    /// Fewer points and sets: under two minutes
    #[arg(long)]
    pub quick: bool,
    #[command(flatten)]
    pub run: LongArgs,
}

/// What long work takes besides.
#[derive(Args)]
pub struct LongArgs {
    /// Overwrite existing files
    #[arg(long)]
    pub force: bool,
    /// Threads; the result does not depend on them [default: all]
    #[arg(short = 'j', long, value_name = "J", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
    /// Say nothing but errors
    #[arg(short, long)]
    pub quiet: bool,
}

/// What verbs that measure take besides.
#[derive(Args)]
pub struct MeasuredArgs {
    /// Print what was measured as JSON
    #[arg(long)]
    pub json: bool,
    /// Overwrite existing files
    #[arg(long)]
    pub force: bool,
    /// Threads; the result does not depend on them [default: all]
    #[arg(short = 'j', long, value_name = "J", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
pub enum FilterArg {
    /// Piecewise cubic, 4 pixels wide
    Mitchell,
    /// A Gaussian 3 pixels wide
    Gaussian,
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

#[derive(Args)]
#[command(next_help_heading = "Output")]
pub struct RunArgs {
    /// Where the points go: .txt .csv .npy, or drawn: .svg .png .pdf; - is stdout
    #[arg(short, long, value_name = "OUT")]
    pub output: PathBuf,
    /// The output's format, txt csv npy svg png or pdf, if its name does not tell
    #[arg(long, value_parser = parse_format)]
    pub format: Option<Format>,
    /// What is drawn, parts as in analyze [default: points]
    #[arg(long, value_enum, value_delimiter = ',', value_name = "PARTS", hide_possible_values = true)]
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
pub enum SpaceKind {
    /// Opposite sides are one
    Torus,
    /// Bounded
    #[value(alias = "rectangle")]
    Rect,
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
    /// Voronoi cells coloured by their area
    Capacity,
    /// The power spectrum, in log grey
    Spectrum,
    /// The radial mean of the power spectrum
    Radial,
    /// How much the power differs by direction
    Anisotropy,
    /// The pair correlation
    Correlation,
    /// The angles of the triangles
    Angles,
    /// One page of all of it
    Report,
}

/// The whole command, with what the table of methods adds to the help.
pub fn command() -> Clap {
    Cli::command().mut_subcommand("generate", with_methods).mut_subcommand("optimize", with_methods).mut_subcommand("compare", with_methods)
}

impl From<FilterArg> for ReconstructionFilter {
    fn from(filter: FilterArg) -> Self {
        match filter {
            FilterArg::Mitchell => Self::Mitchell,
            FilterArg::Gaussian => Self::Gaussian,
        }
    }
}

impl From<DrawArg> for Draw {
    fn from(layer: DrawArg) -> Self {
        match layer {
            DrawArg::Points => Self::Points,
            DrawArg::Delaunay => Self::Delaunay,
            DrawArg::Voronoi => Self::Voronoi,
            DrawArg::Valence => Self::Valence,
            DrawArg::Capacity => Self::Capacity,
            DrawArg::Spectrum => Self::PowerSpectrum,
            DrawArg::Radial => Self::RadialPower,
            DrawArg::Anisotropy => Self::Anisotropy,
            DrawArg::Correlation => Self::PairCorrelation,
            DrawArg::Angles => Self::Angles,
            DrawArg::Report => Self::Report,
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
