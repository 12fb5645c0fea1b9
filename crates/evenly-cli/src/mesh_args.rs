//! The arguments of `evenly mesh`.

use std::path::PathBuf;

use clap::{ArgGroup, Args};
use evenly::Method;
use evenly_io::MeshFormat;
use evenly_jobs::MeshRequest;

use crate::files::Files;
use crate::method::{MethodArgs, OnMeshes, parser};
use crate::parse::{parse_count, parse_length};
use crate::shared_args::{DensityArgs, LongArgs};

#[derive(Args)]
#[command(
    after_help = "Examples:\n  evenly mesh area.geojson --edge-length 50 -o area.msh\n  evenly mesh plate.svg -n 20000 --no-obtuse -o plate.vtu --cells cells.geojson\n\n\
                  Polygons: GeoJSON, WKT, shapefiles, SVG (what its shapes enclose), or text: x y a line, a blank line between rings, holes inside.\n\
                  Red triangles in drawings have an angle below 25 degrees, light red ones are obtuse.\n\
                  Exit code 1: the mesh is written, but has angles below --min-angle or obtuse ones with --no-obtuse; where and why is said."
)]
pub struct Mesh {
    /// A polygon, with holes and in several parts as may be; - is stdin
    pub input: PathBuf,
    #[command(flatten)]
    pub wishes: MeshWishes,
    /// Where the mesh goes: .msh (Gmsh 4.1) .vtu .obj .ply .off .stl .geojson .npz, or drawn: .svg .png .pdf; - is stdout
    #[arg(short, long, value_name = "OUT")]
    pub output: PathBuf,
    /// The output's format, if its name does not tell
    #[arg(long, value_parser = parse_mesh_format)]
    pub format: Option<MeshFormat>,
    /// Write .ply as text, not binary
    #[arg(long, help_heading = "Output")]
    pub ascii: bool,
    /// Wanted lengths of edges at points, as x y length a line, where they are to be shorter; they grow from there by --grade, or by 0.25
    #[arg(long, value_name = "FILE", help_heading = "Size")]
    pub sizes: Option<PathBuf>,
    /// Points that become vertices, as .txt, .csv, .npy or .geojson
    #[arg(long, value_name = "FILE", help_heading = "Constraints")]
    pub fixed: Option<PathBuf>,
    /// Lines inside that become edges: GeoJSON, WKT, SVG, shapefiles, or text with a blank line between them
    #[arg(long, value_name = "FILE", help_heading = "Constraints")]
    pub lines: Option<PathBuf>,
    /// Parts that touch stay apart, as regions: features, polygons or shapes; where they overlap the first has the place
    #[arg(long, help_heading = "Constraints")]
    pub regions: bool,
    /// How far off flattened curves of an SVG may be, in its units [default: a thousandth of its size]
    #[arg(long, value_name = "T", value_parser = parse_length, allow_negative_numbers = true, help_heading = "Constraints")]
    pub curve_tolerance: Option<f64>,
    /// The vertices' Voronoi cells, clipped at the boundary, as .geojson
    #[arg(long, value_name = "OUT", help_heading = "Output")]
    pub cells: Option<PathBuf>,
    /// Write the run's whole record, as JSON
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub report: Option<PathBuf>,
    /// Print the run's whole record on stdout, as JSON
    #[arg(long, help_heading = "Output")]
    pub json: bool,
    #[command(flatten)]
    pub run: LongArgs,
}

/// What a mesh is to be.
#[derive(Args)]
#[command(group = ArgGroup::new("size").required(true).args(["edge_length", "n_triangles"]))]
pub struct MeshWishes {
    /// The wanted length of edges, in the polygon's units; shorter where the boundary is detailed or the domain narrow
    #[arg(long, value_name = "H", value_parser = parse_length, allow_negative_numbers = true)]
    pub edge_length: Option<f64>,
    /// About how many triangles, instead; there are more where the boundary is detailed
    #[arg(short, long, value_name = "N", value_parser = parse_count, allow_negative_numbers = true)]
    pub n_triangles: Option<usize>,
    /// Fewer corners first: no place of the boundary goes farther than this, in the polygon's units; rings and areas stay
    #[arg(long, value_name = "TOL", value_parser = parse_length, allow_negative_numbers = true)]
    pub simplify: Option<f64>,
    /// The same seed gives the same mesh
    #[arg(short, long, value_name = "SEED", default_value_t = 0, allow_negative_numbers = true)]
    pub seed: u64,
    /// How points find their places: on the boundary they move along it
    #[arg(short, long, default_value_t = Method::default(), value_parser = parser::<OnMeshes>(), help_heading = "Method")]
    pub method: Method,
    #[command(flatten)]
    pub method_args: MethodArgs<OnMeshes>,
    /// Let edges grow away from the boundary, by so much a length: 0.2 is gentle, 1 the most
    #[arg(long, value_name = "G", allow_negative_numbers = true, help_heading = "Size")]
    pub grade: Option<f64>,
    /// The longest edges wanted, where they grow [default: no limit with --grade]
    #[arg(long, value_name = "H", value_parser = parse_length, allow_negative_numbers = true, requires = "grade", help_heading = "Size")]
    pub max_edge_length: Option<f64>,
    #[command(flatten)]
    pub density: DensityArgs,
    /// No angle shall be smaller, in degrees, up to 35; but in sharper corners of the polygon [default: 25]
    #[arg(long, value_name = "DEG", allow_negative_numbers = true, help_heading = "Demands")]
    pub min_angle: Option<f64>,
    /// No triangle shall be obtuse
    #[arg(long, help_heading = "Demands")]
    pub no_obtuse: bool,
}

impl Mesh {
    /// What is asked for.
    pub fn request(&self, files: &mut Files) -> MeshRequest {
        files.curve_tolerance = self.curve_tolerance;
        let wishes = &self.wishes;
        MeshRequest {
            polygon: if self.regions { None } else { Some(files.name(&self.input)) },
            regions: self.regions.then(|| files.name(&self.input)),
            edge_length: wishes.edge_length,
            n_triangles: wishes.n_triangles,
            simplify: wishes.simplify,
            seed: wishes.seed,
            method: wishes.method,
            parameters: wishes.method_args.settings(),
            grade: wishes.grade,
            max_edge_length: wishes.max_edge_length,
            sizes: files.names(self.sizes.as_ref()),
            density: wishes.density.resource(),
            min_angle: wishes.min_angle,
            no_obtuse: wishes.no_obtuse,
            fixed: files.names(self.fixed.as_ref()),
            lines: files.names(self.lines.as_ref()),
        }
    }
}

pub fn parse_mesh_format(text: &str) -> Result<MeshFormat, String> {
    let names: Vec<&str> = MeshFormat::ALL.iter().map(|&(name, _)| name).collect();
    MeshFormat::from_name(text).ok_or_else(|| format!("it must be one of {}", names.join(", ")))
}
