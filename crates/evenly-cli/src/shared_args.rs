//! Arguments that several verbs take: the domain, and what a figure shows.

use clap::{Args, ValueEnum};
use evenly::{Error, Rectangle, Space, Torus};
use evenly_io::Draw;

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
