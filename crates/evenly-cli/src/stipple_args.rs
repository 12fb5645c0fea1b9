//! The arguments of `evenly stipple`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use evenly::Method;
use evenly_io::Format;
use evenly_jobs::{InkTone, StippleRequest};

use crate::files::Files;
use crate::method::{ByDensity, MethodArgs, OptimizersByDensity, parser};
use crate::parse::{parse_count, parse_format, parse_mm};
use crate::shared_args::LongArgs;

#[derive(Args)]
#[command(
    after_help = "Examples:\n  evenly stipple photo.jpg -n 20000 -o drawing.svg\n  evenly stipple photo.jpg -n 8000 --page 300x200mm --pen 0.4mm --layers cmyk -o drawing.svg --preview\n\n\
                  Points, as .txt .csv or .npy, are in the picture's pixels, y upwards from its lower left corner."
)]
pub struct Stipple {
    /// A picture, .png, .jpg or .tif; - is stdin. What is transparent gets no dots
    pub input: PathBuf,
    /// How many dots, exactly, of all layers together
    #[arg(short, long, value_name = "N", value_parser = parse_count, default_value = "20000", allow_negative_numbers = true)]
    pub n_points: usize,
    /// Where the drawing goes: .svg .png .pdf, or its points: .txt .csv .npy; - is stdout
    #[arg(short, long, value_name = "OUT")]
    pub output: PathBuf,
    /// The output's format, if its name does not tell
    #[arg(long, value_parser = parse_format)]
    pub format: Option<Format>,
    /// How dots are spread; poisson-disk, eliminate and white are no optimisers
    #[arg(short, long, default_value_t = Method::default(), value_parser = parser::<ByDensity>())]
    pub method: Method,
    /// What the method is told; passes of push-pull, well-spaced and capacity are 60 unless they are given
    #[command(flatten)]
    pub method_args: MethodArgs<OptimizersByDensity>,
    /// The same seed gives the same dots
    #[arg(short, long, value_name = "SEED", default_value_t = 0, allow_negative_numbers = true)]
    pub seed: u64,
    #[command(flatten)]
    pub tone: ToneArgs,
    /// One black layer, or a layer a colour
    #[arg(long, value_enum, default_value = "black", help_heading = "Drawing")]
    pub layers: Layers,
    /// The paper: a0 to a6, letter, or WxHmm (cm, in); a name takes the picture's orientation
    #[arg(long, value_name = "PAGE", default_value = "a4", help_heading = "Drawing")]
    pub page: String,
    /// Blank paper around the picture
    #[arg(long, value_name = "LENGTH", default_value = "10mm", value_parser = parse_mm, allow_negative_numbers = true, help_heading = "Drawing")]
    pub margin: f64,
    /// The largest dot's diameter [default: as wide as dots neither touch nor darken the picture too much; of edges 0.3mm]
    #[arg(long, value_name = "LENGTH", value_parser = parse_mm, allow_negative_numbers = true, help_heading = "Drawing")]
    pub pen: Option<f64>,
    /// Dots as touches of a pen, or as filled circles
    #[arg(long, value_enum, default_value = "path", help_heading = "Drawing")]
    pub dots: DotKind,
    /// Dots of one size, or larger where it is darker, down to half the pen
    #[arg(long, value_enum, default_value = "constant", help_heading = "Drawing")]
    pub sizes: Sizes,
    /// In which order dots are drawn: on a short way; so that the first of them show the whole picture, on a long way; or as they come
    #[arg(long, value_enum, default_value = "tour", help_heading = "Drawing")]
    pub order: DrawOrder,
    /// Draw the edges between dots instead of the dots
    #[arg(long, value_enum, help_heading = "Drawing")]
    pub edges: Option<Edges>,
    /// Write a PNG beside the drawing
    #[arg(long, help_heading = "Output")]
    pub preview: bool,
    /// Write what was drawn and how true its tone is, as JSON
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub report: Option<PathBuf>,
    #[command(flatten)]
    pub run: LongArgs,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Layers {
    /// All dots in black
    Black,
    /// Cyan, magenta, yellow and black
    Cmyk,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum DotKind {
    /// Touches of a pen
    Path,
    /// Filled circles
    Circle,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Sizes {
    /// All the same
    Constant,
    /// By the tone
    Tone,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum DrawOrder {
    /// A short way for the pen
    Tour,
    /// Any part of it, from the first dot on, is spread by the tone
    Progressive,
    /// As they come
    Input,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Edges {
    /// Between the dots' cells
    Voronoi,
    /// Between neighbouring dots
    Delaunay,
}

/// How dark a picture's tones are to be.
#[derive(Args, Clone, Copy)]
pub struct ToneArgs {
    /// Light counts instead of dark, as for a white pen on black paper
    #[arg(long, help_heading = "Tone")]
    invert: bool,
    /// Spread tones from middle grey by this factor
    #[arg(long, value_name = "C", default_value_t = 1.0, allow_negative_numbers = true, help_heading = "Tone")]
    contrast: f64,
    /// Raise darkness, from 0 to 1, to this power: more than 1 lightens middle tones
    #[arg(long, value_name = "G", default_value_t = 1.0, allow_negative_numbers = true, help_heading = "Tone")]
    gamma: f64,
    /// The least darkness, from 0 to 1: more than 0 leaves no paper empty
    #[arg(long, value_name = "F", default_value_t = 0.0, allow_negative_numbers = true, help_heading = "Tone")]
    floor: f64,
    /// Leave the paper empty where the picture is lighter than this, from 0 to 1
    ///
    /// With --invert, where it is darker than 1 less this.
    #[arg(long, value_name = "W", default_value_t = 1.0, allow_negative_numbers = true, help_heading = "Tone")]
    white: f64,
}

impl Stipple {
    /// What is asked for.
    pub fn request(&self, files: &mut Files) -> StippleRequest {
        let ToneArgs { invert, contrast, gamma, floor, white } = self.tone;
        StippleRequest {
            picture: files.name(&self.input),
            n_points: self.n_points,
            method: self.method,
            parameters: self.method_args.settings(),
            seed: self.seed,
            tone: InkTone { invert, contrast, gamma, floor, white },
            layers: match self.layers {
                Layers::Black => evenly_jobs::Layers::Black,
                Layers::Cmyk => evenly_jobs::Layers::Cmyk,
            },
            sizes: match self.sizes {
                Sizes::Constant => evenly_jobs::DotSizes::Constant,
                Sizes::Tone => evenly_jobs::DotSizes::Tone,
            },
            order: match self.order {
                DrawOrder::Tour => evenly_jobs::DrawOrder::Tour,
                DrawOrder::Progressive => evenly_jobs::DrawOrder::Progressive,
                DrawOrder::Input => evenly_jobs::DrawOrder::Input,
            },
            is_measured: self.report.is_some(),
        }
    }
}
