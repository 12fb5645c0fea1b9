//! Arguments that several verbs take: the domain, its density, and what a figure shows.

use std::path::{Path, PathBuf};

use anyhow::bail;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use evenly::{Density, PointSet};
use evenly_io::{DensityFile, Draw};
use evenly_jobs::{Domain, Pixels, Resource};

use crate::files::Files;

#[derive(Args)]
pub struct SpaceArgs {
    /// The domain: torus (periodic), rect (bounded), or a polygon's file [default: torus]
    ///
    /// Sets of a torus tile the plane. Polygons are read as by mesh: GeoJSON, WKT, SVG, shapefile or text. Points stay inside, and see nothing across its boundary. Points that evenly has written, as .txt or .geojson, carry their torus or rectangle along: it counts
    /// where nothing else is given.
    #[arg(long, value_name = "SPACE", value_parser = parse_space)]
    space: Option<SpaceArg>,
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
    pub fn metric(&self) -> evenly_jobs::Metric {
        match self.metric {
            Metric::Input => evenly_jobs::Metric::Input,
            Metric::Unit => evenly_jobs::Metric::Unit,
        }
    }

    /// The points as they are measured.
    pub fn applied(&self, points: PointSet) -> Result<PointSet, evenly::Error> {
        if self.metric == Metric::Unit { points.in_unit_square() } else { Ok(points) }
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
    density: Option<String>,
}

/// The words, if they mean something.
fn parse_density(words: &str) -> Result<String, String> {
    words.parse::<DensityFile>().map(|_| words.to_owned())
}

impl DensityArgs {
    pub fn is_given(&self) -> bool {
        self.density.is_some()
    }

    /// What a request calls it.
    pub fn resource(&self) -> Option<Resource<Pixels>> {
        self.density.clone().map(Resource::Name)
    }

    fn file(&self) -> Option<DensityFile> {
        self.density.as_ref().and_then(|words| words.parse().ok())
    }

    /// The density; uniform if none is given.
    pub fn density(&self) -> anyhow::Result<Density> {
        Ok(self.file().map_or(Ok(Density::uniform()), |file| file.read())?)
    }

    /// The file, where it is one.
    pub fn path(&self) -> Option<PathBuf> {
        self.file().map(|file| file.path)
    }
}

#[derive(Args)]
pub struct FixedArg {
    /// Points that stay where they are, as .txt, .csv, .npy or .geojson
    ///
    /// They are among the N, and come first in the output.
    #[arg(long, value_name = "FILE")]
    pub fixed: Option<PathBuf>,
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

/// Reads the name of what a figure shows.
pub fn draw_parser() -> impl TypedValueParser<Value = Draw> {
    let names = Draw::ALL.iter().map(|&(_, name, doc)| PossibleValue::new(name).help(doc));
    PossibleValuesParser::new(names).try_map(|name| Draw::named(&name).ok_or("there is nothing of that name"))
}

impl SpaceArgs {
    /// The domain as requests have it; none where nothing is said of it.
    pub fn domain(&self, files: &mut Files) -> anyhow::Result<Option<Domain>> {
        let (origin, size) = (self.origin, self.size);
        Ok(match &self.space {
            None if origin.is_none() && size.is_none() => None,
            None | Some(SpaceArg::Torus) => Some(Domain::Torus { origin, size }),
            Some(SpaceArg::Rect) => Some(Domain::Rectangle { origin, size }),
            Some(SpaceArg::Polygon(path)) if origin.is_some() || size.is_some() => {
                bail!("--size and --origin are for torus and rect; {} has its own", path.display())
            }
            Some(SpaceArg::Polygon(path)) => Some(Domain::Polygon { polygon: files.name(path) }),
        })
    }

    /// The polygon's file, where it is one.
    pub fn path(&self) -> Option<&PathBuf> {
        if let Some(SpaceArg::Polygon(path)) = &self.space { Some(path) } else { None }
    }
}

fn parse_pair(text: &str) -> Result<[f64; 2], String> {
    let parts: Vec<Option<f64>> = text.split([',', 'x']).map(|number| number.trim().parse().ok()).collect();
    match parts[..] {
        [Some(a), Some(b)] => Ok([a, b]),
        _ => Err("it must be two numbers, such as 640,480 or 640x480".into()),
    }
}
