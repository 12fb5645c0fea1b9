//! The arguments: each flag is described here once, for the help, the man page and the completions.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};
use evenly::Method;
use evenly_io::{Draw, Format};
use evenly_jobs::{CompareRequest, Compared, GenerateRequest, OptimizeRequest};

use crate::files::Files;
use crate::measuring_args::{Analyze, Bilateral, Reproduce, Zoneplate};
use crate::memory;
use crate::mesh_args::Mesh;
use crate::method::{Any, MethodArgs, Optimizers, Starts, parse_compared, parser};
use crate::parse::{parse_count, parse_format};
use crate::remesh_args::{Remesh, Sample};
use crate::shared_args::{DensityArgs, FixedArg, LongArgs, MetricArg, SpaceArgs, draw_parser};
use crate::stipple_args::Stipple;

const EXAMPLES: &str = "\
Examples:
  evenly generate -n 10000 -o points.svg
  evenly generate -n 10000 --seed 7 -o points.txt --report run.json
  evenly generate -n 10000 --min-distance 0.85 --coverage-radius 0.67 -o points.csv
  evenly optimize points.csv --size 640,480 -o better.csv
  evenly analyze better.csv --size 640,480 --json
  evenly stipple photo.jpg -n 20000 -o drawing.svg
  evenly mesh area.geojson --edge-length 50 -o area.msh
  evenly remesh bunny.obj -n 8500 -o out.ply
  evenly compare -n 1000 --methods lloyd,well-spaced,push-pull -o table.html

Exit codes: 0 done; 1 done, but not converged, or a target that was asked for not reached; 2 bad usage or input, or no output; 130 interrupted, state reached written";

/// Spreads points evenly, but not regularly: blue noise.
#[derive(Parser)]
#[command(name = "evenly", version, after_help = EXAMPLES, max_term_width = 110)]
pub struct Cli {
    /// The most memory that a run may use, as 8GB or 500MB [default: three quarters of the machine's]
    #[arg(long, value_name = "SIZE", value_parser = memory::parse)]
    #[arg(global = true, hide_short_help = true, help_heading = "Output")]
    pub memory: Option<u64>,
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
    /// Draw a picture with dots, as many as asked for: for plotters, print and screen
    Stipple(Stipple),
    /// Mesh a polygon with triangles
    Mesh(Mesh),
    /// Give a surface a new mesh: exactly so many vertices, and no obtuse triangle
    Remesh(Remesh),
    /// Spread points over a surface
    Sample(Sample),
    /// Run several methods on the same points, and lay their measures side by side
    Compare(Compare),
    /// Sample the zone plate sin(x^2 + y^2) with points, and measure noise and aliasing
    Zoneplate(Zoneplate),
    /// Filter a picture bilaterally with few pixels, chosen by points, and measure the error
    Bilateral(Bilateral),
    /// List the methods, and what each can be told
    Methods(Methods),
    /// Recompute a paper's tables and figures, beside the printed numbers
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
#[command(after_help = "Example:\n  evenly generate -n 10000 -o points.svg --draw valence,points")]
pub struct Generate {
    /// How many points, exactly: up to 40 million; of poisson-disk about
    #[arg(short, long, value_name = "N", value_parser = parse_count, allow_negative_numbers = true)]
    pub n_points: Option<usize>,
    /// How they are made: by an optimiser, or as one of its starts
    #[arg(short, long, default_value_t = Method::default(), value_parser = parser::<Any>())]
    pub method: Method,
    /// What an optimiser starts from [default: white; opt-beta: poisson-disk]
    ///
    /// In a polygon, where there is no warp, jittered; for opt-beta and by a density eliminate.
    #[arg(long, value_parser = parser::<Starts>(), hide_possible_values = true)]
    pub start: Option<Method>,
    /// The same seed gives the same points
    #[arg(short, long, value_name = "SEED", default_value_t = 0, allow_negative_numbers = true)]
    pub seed: u64,
    #[command(flatten)]
    pub space: SpaceArgs,
    #[command(flatten)]
    pub metric: MetricArg,
    #[command(flatten)]
    pub density: DensityArgs,
    #[command(flatten)]
    pub fixed: FixedArg,
    #[command(flatten)]
    pub warp: WarpArg,
    #[command(flatten)]
    pub optimizer: MethodArgs<Optimizers>,
    #[command(flatten)]
    pub starts: MethodArgs<Starts>,
    #[command(flatten)]
    pub run: RunArgs,
}

#[derive(Args)]
#[command(after_help = "Example:\n  evenly optimize in.csv --space rect --size 640,480 -o out.csv")]
pub struct Optimize {
    /// Points as .txt, .csv, .npy or .geojson; - is stdin
    pub input: PathBuf,
    /// How they are improved
    #[arg(short, long, default_value_t = Method::default(), value_parser = parser::<Optimizers>())]
    pub method: Method,
    /// The same seed gives the same points; procrustes, opt-beta, cvt and farthest-point use none
    #[arg(short, long, value_name = "SEED", default_value_t = 0, allow_negative_numbers = true)]
    pub seed: u64,
    #[command(flatten)]
    pub space: SpaceArgs,
    #[command(flatten)]
    pub metric: MetricArg,
    #[command(flatten)]
    pub density: DensityArgs,
    #[command(flatten)]
    pub fixed: FixedArg,
    #[command(flatten)]
    pub warp: WarpArg,
    #[command(flatten)]
    pub optimizer: MethodArgs<Optimizers>,
    #[command(flatten)]
    pub run: RunArgs,
}

#[derive(Args)]
#[command(
    after_help = "Example:\n  evenly compare -n 1000 --methods lloyd,cvt,well-spaced,push-pull --runs 5 -o table.html\n  evenly compare -n 1000 --method push-pull:preset=fast --method push-pull:preset=tough\n\nTargets that are missed are no failure here: the table has the share of runs that reached them."
)]
pub struct Compare {
    /// Points that all begin with, as .txt, .csv, .npy or .geojson; - is stdin [default: new ones for each run, from --start]
    pub input: Option<PathBuf>,
    /// How many points, without an input
    #[arg(short, long, value_name = "N", value_parser = parse_count, allow_negative_numbers = true, conflicts_with = "input")]
    pub n_points: Option<usize>,
    /// What is compared, optimisers and starts [default: all]
    #[arg(long, value_name = "METHODS", value_delimiter = ',', value_parser = parser::<Any>(), hide_possible_values = true)]
    pub methods: Vec<Method>,
    /// One more, and what it alone is told; may be given several times
    #[arg(short, long = "method", value_name = "METHOD[:FLAG=VALUE,...]", value_parser = parse_compared)]
    pub told: Vec<Compared>,
    /// How often, each time with the next seed
    #[arg(long, value_name = "K", default_value_t = 3, value_parser = clap::value_parser!(u16).range(1..))]
    pub runs: u16,
    /// What all optimisers start from, without an input [default: white; in a polygon jittered]
    #[arg(long, value_parser = parser::<Starts>(), hide_possible_values = true, conflicts_with = "input")]
    pub start: Option<Method>,
    /// The first run's seed
    #[arg(short, long, value_name = "SEED", default_value_t = 0, allow_negative_numbers = true)]
    pub seed: u64,
    #[command(flatten)]
    pub space: SpaceArgs,
    #[command(flatten)]
    pub metric: MetricArg,
    #[command(flatten)]
    pub density: DensityArgs,
    #[command(flatten)]
    pub warp: WarpArg,
    #[command(flatten)]
    pub optimizer: MethodArgs<Optimizers>,
    /// Where the table goes: .md .csv (a line a run) .json (all of it) .html (with pictures) [default: stdout, as plain text]
    #[arg(short, long, value_name = "OUT", help_heading = "Output")]
    pub output: Option<PathBuf>,
    #[command(flatten)]
    pub run: LongArgs,
}

impl Generate {
    /// What is asked for.
    pub fn request(&self, files: &mut Files) -> anyhow::Result<GenerateRequest> {
        Ok(GenerateRequest {
            n_points: self.n_points,
            method: self.method,
            parameters: self.optimizer.settings().overlaid(&self.starts.settings()),
            start: self.start,
            no_warp: self.warp.no_warp,
            seed: self.seed,
            space: self.space.domain(files)?.unwrap_or_default(),
            metric: self.metric.metric(),
            density: self.density.resource(),
            fixed: files.names(self.fixed.fixed.as_ref()),
        })
    }
}

impl Optimize {
    /// What is asked for.
    pub fn request(&self, files: &mut Files) -> anyhow::Result<OptimizeRequest> {
        Ok(OptimizeRequest {
            points: files.name(&self.input),
            method: self.method,
            parameters: self.optimizer.settings(),
            no_warp: self.warp.no_warp,
            seed: self.seed,
            space: self.space.domain(files)?,
            metric: self.metric.metric(),
            density: self.density.resource(),
            fixed: files.names(self.fixed.fixed.as_ref()),
        })
    }
}

impl Compare {
    /// What is asked for.
    pub fn request(&self, files: &mut Files) -> anyhow::Result<CompareRequest> {
        Ok(CompareRequest {
            points: files.names(self.input.as_ref()),
            n_points: self.n_points,
            methods: self.methods.iter().map(|&method| method.into()).chain(self.told.iter().cloned()).collect(),
            parameters: self.optimizer.settings(),
            runs: self.runs,
            start: self.start,
            no_warp: self.warp.no_warp,
            seed: self.seed,
            space: self.space.domain(files)?,
            metric: self.metric.metric(),
            density: self.density.resource(),
        })
    }
}

#[derive(Args)]
pub struct Methods {
    /// One method, with its parameters [default: all, in a table]
    pub name: Option<String>,
    /// All methods with all parameters, as JSON
    #[arg(long)]
    pub json: bool,
}

#[derive(Args)]
pub struct WarpArg {
    /// Take points as they are: not evened out first
    #[arg(long)]
    pub no_warp: bool,
}

#[derive(Args)]
#[command(next_help_heading = "Output")]
pub struct RunArgs {
    /// Where they go: .txt .csv .npy .geojson, drawn: .svg .png .pdf; - is stdout
    #[arg(short, long, value_name = "OUT")]
    pub output: PathBuf,
    /// The output's format, if its name does not tell
    #[arg(long, value_parser = parse_format)]
    pub format: Option<Format>,
    /// What is drawn, parts as in analyze [default: points]
    #[arg(long, value_parser = draw_parser(), value_delimiter = ',', value_name = "PARTS", hide_possible_values = true)]
    pub draw: Option<Vec<Draw>>,
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
