//! Arguments that several verbs take: the domain, its density, and what a figure shows.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use clap::{Args, ValueEnum};
use evenly::{Density, PointSet, Rectangle, Space, Torus};
use evenly_io::{Draw, Photograph, Tone, read_polygon, read_positions};

use crate::talk::say;

#[derive(Args)]
pub struct SpaceArgs {
    /// The domain: torus (periodic), rect (bounded), or a polygon's file
    ///
    /// Sets of a torus tile the plane. Polygons are read as by mesh: GeoJSON, WKT, SVG, shapefile or text. Points stay inside, and see nothing across its border.
    #[arg(long, value_name = "SPACE", default_value = "torus", value_parser = parse_space)]
    space: SpaceArg,
    /// Width and height of a torus or rect [default: 1,1]
    #[arg(long, value_name = "W,H", value_parser = parse_pair, allow_hyphen_values = true)]
    size: Option<[f64; 2]>,
    /// Its lower left corner [default: 0,0]
    #[arg(long, value_name = "X,Y", value_parser = parse_pair, allow_hyphen_values = true)]
    origin: Option<[f64; 2]>,
}

#[derive(Args)]
pub struct MetricArg {
    /// Units of distances: input, or unit (both axes 0 to 1)
    ///
    /// With unit, the domain is scaled to the unit square, each axis by itself, and points come back in
    /// their own units: for axes of different kinds, as the factors of an experiment. Measures and
    /// figures are those of the unit square.
    #[arg(long, value_enum, default_value = "input", hide_possible_values = true)]
    metric: Metric,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Metric {
    /// Those of the input: both axes have the same
    Input,
    /// Parts of the domain's width and of its height
    Unit,
}

impl MetricArg {
    pub fn is_unit(&self) -> bool {
        self.metric == Metric::Unit
    }

    /// The points as they are measured.
    pub fn applied(&self, points: PointSet) -> Result<PointSet, evenly::Error> {
        if self.is_unit() { points.in_unit_square() } else { Ok(points) }
    }
}

#[derive(Args)]
pub struct DensityArgs {
    /// More points where a picture is lighter; HOW: invert,contrast=C,gamma=G
    ///
    /// The picture, .png, .jpg or .tif, spans the domain, and its luma is the density that is wanted: where it is black there are no points. HOW is any of invert (dark counts
    /// instead), contrast=C (tones are spread from middle grey), gamma=G (raised to this power) and floor=F (the least density, from 0 to 1), with commas between them.
    /// `evenly methods` lists the methods that follow it.
    #[arg(long, value_name = "FILE[:HOW]", value_parser = parse_density, allow_hyphen_values = true)]
    density: Option<DensitySpec>,
}

#[derive(Args)]
pub struct FixedArg {
    /// Points that stay where they are, as .txt, .csv, .npy or .geojson
    ///
    /// They are among the N, and come first in the output.
    #[arg(long, value_name = "FILE")]
    fixed: Option<PathBuf>,
}

impl FixedArg {
    /// The points that stay; none, if none are given.
    pub fn points(&self, space: Space) -> anyhow::Result<PointSet> {
        let Some(path) = &self.fixed else { return Ok(PointSet::new(space, Vec::new())?) };
        let positions = read_positions(path)?;
        let n_fixed = positions.len();
        let points = PointSet::new(space, positions).and_then(|points| points.with_fixed(n_fixed));
        points.with_context(|| path.display().to_string())
    }

    pub fn path(&self) -> Option<&PathBuf> {
        self.fixed.as_ref()
    }
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

/// The density of a picture and what is made of its tones, in words.
pub fn density_of(words: &str) -> anyhow::Result<Density> {
    let density = parse_density(words).map_err(anyhow::Error::msg)?;
    DensityArgs { density: Some(density) }.density()
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

#[derive(Clone)]
enum SpaceArg {
    Torus,
    Rect,
    Polygon(PathBuf),
}

fn parse_space(text: &str) -> Result<SpaceArg, String> {
    match text {
        "torus" => Ok(SpaceArg::Torus),
        "rect" | "rectangle" => Ok(SpaceArg::Rect),
        path if Path::new(path).is_file() || path == "-" => Ok(SpaceArg::Polygon(path.into())),
        _ => Err("it must be torus, rect, or a polygon's file; there is no file of that name".into()),
    }
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
    /// The domain, and what was repaired of it.
    pub fn space(&self) -> anyhow::Result<Space> {
        let (origin, size) = (self.origin.unwrap_or([0.0; 2]), self.size.unwrap_or([1.0; 2]));
        let path = match &self.space {
            SpaceArg::Torus => return Ok(Torus::new(origin, size)?.into()),
            SpaceArg::Rect => return Ok(Rectangle::new(origin, size)?.into()),
            SpaceArg::Polygon(path) => path,
        };
        if self.origin.is_some() || self.size.is_some() {
            bail!("--size and --origin are for torus and rect; {} has its own", path.display());
        }
        let polygon = read_polygon(path, None)?;
        polygon.repairs().iter().for_each(|repair| say(format_args!("note: {}: {repair}", path.display())));
        Ok(Space::from(&polygon))
    }

    /// The polygon's file, where it is one.
    pub fn path(&self) -> Option<&PathBuf> {
        if let SpaceArg::Polygon(path) = &self.space { Some(path) } else { None }
    }
}

fn parse_pair(text: &str) -> Result<[f64; 2], String> {
    let parts: Vec<Option<f64>> = text.split([',', 'x']).map(|number| number.trim().parse().ok()).collect();
    match parts[..] {
        [Some(a), Some(b)] => Ok([a, b]),
        _ => Err("it must be two numbers, such as 640,480 or 640x480".into()),
    }
}
