//! The arguments of `evenly remesh`.

use std::path::PathBuf;

use clap::{ArgGroup, Args};
use evenly::Method;
use evenly_io::{CloudFormat, MeshFormat};
use evenly_jobs::{OrOff, RemeshRequest, Resource, SampleRequest, is_resource};

use crate::files::Files;
use crate::mesh_args::parse_mesh_format;
use crate::method::{MethodArgs, OnMeshes, OnSurfaces, parser};
use crate::parse::{parse_count, parse_length};
use crate::shared_args::LongArgs;

#[derive(Args)]
#[command(
    after_help = "Examples:\n  evenly remesh bunny.obj -n 8500 -o out.ply\n  evenly remesh part.stl --edge-length 2.5 --features 30deg -o part.obj\n  evenly remesh scan.ply -n 20000 --density curvature -o out.ply --plot out.png\n\n\
                  Meshes: .obj .ply .stl .off .gltf .glb .msh .vtu .npz; positions that are equal are one. Vertices carry facet, barycentric coordinates, normal, and what the input's carry, in .ply .vtu .npz.\n\
                  Red triangles in drawings have an angle below 30 degrees, light red ones are obtuse.\n\
                  Exit code 1: the mesh is written, but targets that were given were not reached everywhere, or without them a triangle is obtuse or has an angle below 30 degrees; where is said."
)]
pub struct Remesh {
    /// A triangle mesh, closed or open, in several parts as may be; - is stdin
    pub input: PathBuf,
    #[command(flatten)]
    pub wishes: RemeshWishes,
    /// Where the mesh goes: .ply .obj .off .stl .vtu .msh .npz, or drawn: .svg .png .pdf; - is stdout
    #[arg(short, long, value_name = "OUT")]
    pub output: PathBuf,
    /// The output's format, if its name does not tell
    #[arg(long, value_parser = parse_mesh_format)]
    pub format: Option<MeshFormat>,
    /// Write .ply as text, not binary
    #[arg(long, help_heading = "Output")]
    pub ascii: bool,
    /// A shaded picture of the mesh: .svg .png .pdf
    #[arg(long, value_name = "OUT", help_heading = "Output")]
    pub plot: Option<PathBuf>,
    /// Write the run's whole record, as JSON
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub report: Option<PathBuf>,
    /// Print the run's whole record on stdout, as JSON
    #[arg(long, help_heading = "Output")]
    pub json: bool,
    #[command(flatten)]
    pub run: LongArgs,
}

/// What a new mesh is to be.
#[derive(Args)]
#[command(group = ArgGroup::new("size").required(true).multiple(true).args(["n_vertices", "edge_length", "density", "points"]))]
pub struct RemeshWishes {
    /// How many vertices, exactly
    #[arg(short, long, value_name = "N", value_parser = parse_count, allow_negative_numbers = true, conflicts_with = "edge_length")]
    pub n_vertices: Option<usize>,
    /// The length of edges, in the input's units, instead; with a density their mean
    #[arg(long, value_name = "H", value_parser = parse_length, allow_negative_numbers = true)]
    pub edge_length: Option<f64>,
    /// Points at which vertices begin, as many as are wanted or more: .csv or .txt with x y z, .ply, or the vertices of a mesh; -n is their number unless given
    #[arg(long, value_name = "FILE")]
    pub points: Option<PathBuf>,
    /// The same seed gives the same mesh
    #[arg(short, long, value_name = "SEED", default_value_t = 0, allow_negative_numbers = true)]
    pub seed: u64,
    /// How vertices find their places; those of eliminate stay at the start: sample elimination, or --points
    #[arg(short, long, default_value_t = Method::default(), value_parser = parser::<OnMeshes>(), help_heading = "Method")]
    pub method: Method,
    /// What the method is told; passes are as many again after vertices are put or let go
    #[command(flatten)]
    pub method_args: MethodArgs<OnMeshes>,
    /// Edges of other lengths here and there: curvature[:error], lfs, linear:axis,ratio, attr:NAME, or a file with a number for each vertex
    ///
    /// curvature: shorter where it bends; with an error, in the input's units, so short that triangles are about so far from the input, and as many as it takes, unless -n
    /// says how many. lfs: in proportion to the local feature size. linear:z,4: four times as long at the high end of z. attr and files: wanted lengths, in proportion.
    #[arg(long, value_name = "HOW", help_heading = "Size")]
    pub density: Option<String>,
    /// Creases that turn by more than this are kept, and tips; boundaries are in any case; off for boundaries alone
    ///
    /// A crease is kept if it turns twelve times as much as what is around it, or by more than 75 degrees; all that hangs together, if it is longer than four spacings. Tips are
    /// let go where the targets cannot be met otherwise.
    #[arg(long, value_name = "ANGLE", default_value = "40deg", value_parser = parse_features, help_heading = "Shape")]
    pub features: OrOff,
    /// How far the input may be from the mesh, in edge lengths: where it is farther, a vertex is put and kept, if targets can be met so; off for as it comes [default: 0.5, 0.35 with --density]
    #[arg(long, value_name = "D", value_parser = parse_deviation, allow_negative_numbers = true, help_heading = "Shape")]
    pub max_deviation: Option<OrOff>,
    /// Mend what can be without guessing: turn triangles that run the wrong way, close cracks at vertices on open edges, separate sheets that touch, cut open what is left
    #[arg(long, help_heading = "Shape")]
    pub repair: bool,
    /// Make one of corners that lie within this distance of each other, in the input's units
    #[arg(long, value_name = "D", value_parser = parse_length, allow_negative_numbers = true, help_heading = "Shape")]
    pub weld: Option<f64>,
}

fn parse_deviation(text: &str) -> Result<OrOff, String> {
    if text == "off" {
        return Ok(OrOff(None));
    }
    let length = text.parse().ok().filter(|&length: &f64| length > 0.0 && length.is_finite());
    length.map(|length| OrOff(Some(length))).ok_or_else(|| "it must be positive and finite, or off".to_owned())
}

fn parse_features(text: &str) -> Result<OrOff, String> {
    if text == "off" {
        return Ok(OrOff(None));
    }
    let angle: Option<f64> = text.strip_suffix("deg").unwrap_or(text).parse().ok();
    let angle = angle.filter(|&angle| angle > 0.0 && angle < 180.0);
    angle.map(|angle| OrOff(Some(angle))).ok_or_else(|| "it must be an angle above 0 and below 180, as 40deg, or off".to_owned())
}

/// The file that a density on a surface is, if it is one.
fn density_path(density: Option<&String>) -> Option<PathBuf> {
    density.filter(|words| is_resource(words)).map(PathBuf::from)
}

impl Remesh {
    /// All that is read.
    pub fn inputs(&self) -> Vec<PathBuf> {
        let density = density_path(self.wishes.density.as_ref());
        [Some(self.input.clone()), density, self.wishes.points.clone()].into_iter().flatten().collect()
    }

    /// What is asked for.
    pub fn request(&self, files: &mut Files) -> RemeshRequest {
        let wishes = &self.wishes;
        RemeshRequest {
            mesh: files.name(&self.input),
            n_vertices: wishes.n_vertices,
            edge_length: wishes.edge_length,
            points: files.names(wishes.points.as_ref()),
            seed: wishes.seed,
            method: wishes.method,
            parameters: wishes.method_args.settings(),
            density: wishes.density.clone().map(Resource::Name),
            features: wishes.features,
            max_deviation: wishes.max_deviation,
            repair: wishes.repair,
            weld: wishes.weld,
        }
    }
}

impl Sample {
    /// All that is read.
    pub fn inputs(&self) -> Vec<PathBuf> {
        [Some(self.input.clone()), density_path(self.wishes.density.as_ref())].into_iter().flatten().collect()
    }

    /// What is asked for.
    pub fn request(&self, files: &mut Files) -> SampleRequest {
        let wishes = &self.wishes;
        SampleRequest {
            mesh: files.name(&self.input),
            n_points: wishes.n_points,
            spacing: wishes.spacing,
            method: wishes.method,
            parameters: wishes.method_args.settings(),
            density: wishes.density.clone().map(Resource::Name),
            seed: wishes.seed,
            repair: wishes.repair,
            weld: wishes.weld,
        }
    }
}

#[derive(Args)]
#[command(
    after_help = "Examples:\n  evenly sample bunny.obj -n 5000 -o points.ply\n  evenly sample part.stl --spacing 0.5 --method poisson-disk -o points.csv\n\n\
                  Columns: x y z, the facet and the barycentric coordinates on it, and the normal."
)]
pub struct Sample {
    /// A triangle mesh, as for remesh; - is stdin
    pub input: PathBuf,
    #[command(flatten)]
    pub wishes: SampleWishes,
    /// Where the points go: .ply .csv .txt; - is stdout
    #[arg(short, long, value_name = "OUT")]
    pub output: PathBuf,
    /// The output's format, ply csv or txt, if its name does not tell
    #[arg(long, value_parser = parse_cloud_format)]
    pub format: Option<CloudFormat>,
    /// Write .ply as text, not binary
    #[arg(long, help_heading = "Output")]
    pub ascii: bool,
    /// Print the run's whole record on stdout, as JSON
    #[arg(long, help_heading = "Output")]
    pub json: bool,
    #[command(flatten)]
    pub run: LongArgs,
}

/// What points on a surface are to be.
#[derive(Args)]
#[command(group = ArgGroup::new("size").required(true).args(["n_points", "spacing"]))]
pub struct SampleWishes {
    /// How many points, exactly; of poisson-disk about
    #[arg(short, long, value_name = "N", value_parser = parse_count, allow_negative_numbers = true)]
    pub n_points: Option<usize>,
    /// The smallest distance of two points, for poisson-disk; else their usual one
    #[arg(long, value_name = "H", value_parser = parse_length, allow_negative_numbers = true)]
    pub spacing: Option<f64>,
    /// How they are spread
    #[arg(short, long, default_value_t = Method::default(), value_parser = parser::<OnSurfaces>(), help_heading = "Method")]
    pub method: Method,
    /// What the method is told.
    #[command(flatten)]
    pub method_args: MethodArgs<OnMeshes>,
    /// Points nearer to each other here and there, as in remesh
    #[arg(long, value_name = "HOW")]
    pub density: Option<String>,
    /// The same seed gives the same points
    #[arg(short, long, value_name = "SEED", default_value_t = 0, allow_negative_numbers = true)]
    pub seed: u64,
    /// Mend the mesh, as in remesh; done in any case where there is no other way
    #[arg(long)]
    pub repair: bool,
    /// Make one of corners that lie within this distance of each other, in the input's units
    #[arg(long, value_name = "D", value_parser = parse_length, allow_negative_numbers = true)]
    pub weld: Option<f64>,
}

fn parse_cloud_format(text: &str) -> Result<CloudFormat, String> {
    CloudFormat::from_name(text).ok_or_else(|| "it must be ply, csv or txt".to_owned())
}
