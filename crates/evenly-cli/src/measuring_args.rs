//! The arguments of the verbs that measure.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use evenly::ReconstructionFilter;
use evenly_io::Draw;

use crate::shared_args::{DensityArgs, LongArgs, MetricArg, SpaceArgs, draw_parser};

#[derive(Args)]
#[command(after_help = "Examples:\n  evenly analyze points.txt --plot report.pdf\n  evenly analyze a.txt b.txt c.txt --spectrum --json")]
pub struct Analyze {
    /// Points as .txt, .csv, .npy or .geojson; - is stdin. Of several sets the spectrum is the mean of theirs. Or a mesh, as .ply .obj .off .stl .gltf .glb .msh .vtu .npz; or, with --reference, points on one, as .ply, .csv or .txt
    #[arg(required = true)]
    pub inputs: Vec<PathBuf>,
    /// Of a mesh: the one that it stands for, for the distance to it. Of points in space: the mesh on which they lie
    #[arg(long, value_name = "MESH")]
    pub reference: Option<PathBuf>,
    /// Of a mesh: certify all angles by this ratio of the largest circumradius to the shortest edge, and list where they are not so [default: 0.7, of push-pull's 0.90 and 0.63]
    #[arg(long, value_name = "B", allow_negative_numbers = true)]
    pub certify: Option<f64>,
    #[command(flatten)]
    pub space: SpaceArgs,
    #[command(flatten)]
    pub metric: MetricArg,
    #[command(flatten)]
    pub density: DensityArgs,
    /// The power spectrum and the pair correlation too, with the effective Nyquist frequency and the oscillation; the curves in the JSON. On a mesh by ways along it (differential domain analysis)
    #[arg(long)]
    pub spectrum: bool,
    /// Take each distance in its place's own spacing, for one set whose density varies (differential domain analysis)
    #[arg(long)]
    pub local: bool,
    /// Draw a figure, as .svg, .png or .pdf. Of a mesh it is shaded; of points on one, or with --spectrum, the figure shows the curves
    #[arg(long, value_name = "FILE")]
    pub plot: Option<PathBuf>,
    /// What the figure shows
    #[arg(long, value_parser = draw_parser(), value_delimiter = ',', value_name = "PARTS", default_value = "report", requires = "plot")]
    pub draw: Vec<Draw>,
    #[command(flatten)]
    pub measured: MeasuredArgs,
}

#[derive(Args)]
#[command(after_help = "Example:\n  evenly zoneplate points.txt -o plate.png")]
pub struct Zoneplate {
    /// Points as .txt, .csv, .npy or .geojson; - is stdin. One sample a pixel: a torus is repeated, a rectangle must have enough
    pub input: PathBuf,
    #[command(flatten)]
    pub space: SpaceArgs,
    /// Pixels a side, 16 to 4096
    #[arg(long, value_name = "N", default_value_t = 512, allow_negative_numbers = true)]
    pub pixels: usize,
    /// The wave's frequency at the right side, in waves a pixel: above 0, at most 8
    #[arg(long, value_name = "F", default_value_t = 1.5, allow_negative_numbers = true)]
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
    /// A picture, .png or .jpg; - is stdin. What is transparent lies on white
    pub input: PathBuf,
    /// Points as .txt, .csv, .npy or .geojson: where the picture is looked at. A torus is repeated, a rectangle must have enough
    #[arg(long, value_name = "FILE")]
    pub samples: PathBuf,
    #[command(flatten)]
    pub space: SpaceArgs,
    /// The kernel's width, in pixels: 2 to 1000
    #[arg(long, value_name = "PX", default_value_t = 40.0, allow_negative_numbers = true)]
    pub kernel: f64,
    /// Samples in a kernel, on average
    #[arg(long, value_name = "K", default_value_t = 30.0, allow_negative_numbers = true)]
    pub count: f64,
    /// How different intensities may be and still be mixed, as a standard deviation; white is 1
    #[arg(long, value_name = "R", default_value_t = 0.1, allow_negative_numbers = true)]
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
    after_help = "Example:\n  evenly reproduce push-pull --quick -o pages\n\nInterrupted, it leaves the parts that are done, and the same command, without --force, goes on with the others."
)]
pub struct Reproduce {
    /// The paper: Papazov and Hege 2017; Ahmed, Guo, Yan et al. 2017; Ebeida et al. 2014
    #[arg(value_parser = ["procrustes", "push-pull", "opt-beta"])]
    pub paper: String,
    /// The folder for PAPER.html and PAPER.json, with --quick PAPER-quick.html and PAPER-quick.json
    #[arg(short, long, value_name = "DIR", default_value = ".")]
    pub output: PathBuf,
    /// Of push-pull and opt-beta: models for their figures on surfaces, of those that the papers have: fertility.off,homer.obj,bunny.off,cow.off
    #[arg(long, value_name = "FILES", value_delimiter = ',')]
    pub models: Vec<PathBuf>,
    /// Fewer points and sets: under two minutes
    #[arg(long)]
    pub quick: bool,
    #[command(flatten)]
    pub run: LongArgs,
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

impl From<FilterArg> for ReconstructionFilter {
    fn from(filter: FilterArg) -> Self {
        match filter {
            FilterArg::Mitchell => Self::Mitchell,
            FilterArg::Gaussian => Self::Gaussian,
        }
    }
}
