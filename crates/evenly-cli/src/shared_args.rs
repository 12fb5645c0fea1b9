//! Arguments that several verbs take: the domain, its density, and what a figure shows.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use evenly::{Density, Error, Rectangle, Space, Torus};
use evenly_io::{Draw, Photograph, Tone};

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
pub struct DensityArgs {
    /// More points where a picture is lighter; HOW: invert,contrast=C,gamma=G
    ///
    /// The picture, .png, .jpg or .tif, spans the domain, and its luma is the density that is wanted: where it is black there are no points. HOW is any of invert (dark counts
    /// instead), contrast=C (tones are spread from middle grey), gamma=G (raised to this power) and floor=F (the least density, from 0 to 1), with commas between them.
    /// For all methods but opt-beta, cvt, farthest-point, dart, jittered and hexagonal.
    #[arg(long, value_name = "FILE[:HOW]", value_parser = parse_density, allow_hyphen_values = true)]
    density: Option<DensitySpec>,
}

/// A picture, and what is made of its tones.
#[derive(Clone, Debug)]
struct DensitySpec {
    path: PathBuf,
    tone: Tone,
}

impl DensityArgs {
    pub fn is_given(&self) -> bool {
        self.density.is_some()
    }

    /// The density; uniform if none is given.
    pub fn density(&self) -> anyhow::Result<Density> {
        let Some(DensitySpec { path, tone }) = &self.density else { return Ok(Density::uniform()) };
        Ok(Photograph::read(path)?.density(tone)?)
    }

    /// The file, where it is one.
    pub fn path(&self) -> Option<&PathBuf> {
        self.density.as_ref().map(|spec| &spec.path)
    }
}

fn parse_density(text: &str) -> Result<DensitySpec, String> {
    let known = |options: &str| options.split(',').all(|option| ["invert", "contrast", "gamma", "floor"].contains(&name_of(option)));
    match text.rsplit_once(':') {
        Some((path, options)) if !path.is_empty() && known(options) => Ok(DensitySpec { path: path.into(), tone: parse_tone(options)? }),
        Some((path, options)) if Path::new(path).is_file() && !Path::new(text).exists() => {
            Err(format!("{options:?} is none of invert, contrast=C, gamma=G and floor=F, with commas between them"))
        }
        _ if text.is_empty() => Err("it must be a picture's file".into()),
        _ => Ok(DensitySpec { path: text.into(), tone: Tone::default() }),
    }
}

fn name_of(option: &str) -> &str {
    option.split_once('=').map_or(option, |(name, _)| name)
}

fn parse_tone(options: &str) -> Result<Tone, String> {
    let mut tone = Tone::default();
    let mut seen = Vec::new();
    for option in options.split(',') {
        if seen.contains(&name_of(option)) {
            return Err(format!("{} is there twice", name_of(option)));
        }
        seen.push(name_of(option));
        let number = |is_good: fn(f64) -> bool, expected: &str| {
            let value = option.split_once('=').and_then(|(_, value)| value.parse::<f64>().ok());
            value.filter(|&value| is_good(value)).ok_or_else(|| format!("{option:?}: {} must be {expected}", name_of(option)))
        };
        match name_of(option) {
            "invert" if option == "invert" => tone.is_inverted = true,
            "invert" => return Err(format!("{option:?}: invert takes no value")),
            "contrast" => tone.contrast = number(|c| (0.0..=100.0).contains(&c), "a number from 0 to 100")?,
            "gamma" => tone.gamma = number(|g| g > 0.0 && g <= 100.0, "a number above 0, and 100 at most")?,
            _ => tone.floor = number(|f| (0.0..=1.0).contains(&f), "a number from 0 to 1")?,
        }
    }
    Ok(tone)
}

/// What long work takes besides.
#[derive(Args)]
#[command(next_help_heading = "Output")]
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

fn parse_pair(text: &str) -> Result<[f64; 2], String> {
    let numbers: Vec<f64> = text.split(',').map_while(|number| number.trim().parse().ok()).collect();
    match numbers[..] {
        [a, b] if text.split(',').count() == 2 => Ok([a, b]),
        _ => Err("it must be two numbers with a comma between them".into()),
    }
}
