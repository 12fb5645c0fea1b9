//! Meshes as files: for solvers, for modellers, for maps, and drawn.

mod cells;
mod msh;
mod npz;
mod plain;
mod vtu;

use std::fmt::Write as _;
use std::path::Path;

use evenly::{Mesh, TriangleMesh};

use self::cells::Cells;
use crate::figure::mesh_figure;
use crate::{Error, Target, render};

/// A format of meshes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeshFormat {
    /// Gmsh 4.1, as text; border segments and lines are physical groups.
    Msh,
    /// VTK's unstructured grid, as text.
    Vtu,
    /// Wavefront.
    Obj,
    /// Stanford's, as text.
    Ply,
    /// Geomview's.
    Off,
    /// Stereolithography, binary, in single precision.
    Stl,
    /// A feature a triangle.
    GeoJson,
    /// Numpy arrays: vertices, triangles, edges, edge_tags.
    Npz,
    /// A drawing, scalable.
    Svg,
    /// A drawing, in pixels.
    Png,
    /// A drawing, as a page.
    Pdf,
}

impl MeshFormat {
    /// All formats, by name.
    pub const ALL: [(&'static str, Self); 11] = [
        ("msh", Self::Msh),
        ("vtu", Self::Vtu),
        ("obj", Self::Obj),
        ("ply", Self::Ply),
        ("off", Self::Off),
        ("stl", Self::Stl),
        ("geojson", Self::GeoJson),
        ("npz", Self::Npz),
        ("svg", Self::Svg),
        ("png", Self::Png),
        ("pdf", Self::Pdf),
    ];

    /// The format that a name stands for.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().find(|(known, _)| name.eq_ignore_ascii_case(known)).map(|&(_, format)| format)
    }

    /// The format that a file's ending stands for.
    ///
    /// # Errors
    /// [`Error::Format`] for a file without an ending, or one that is not known.
    pub fn of_path(path: &Path) -> Result<Self, Error> {
        let choices = || Self::ALL.iter().map(|(name, _)| format!(".{name}")).collect::<Vec<_>>().join(" ");
        let unknown = |problem| Error::Format { name: path.display().to_string(), problem, choices: choices() };
        let ending = path.extension().ok_or_else(|| unknown("no ending that tells the format"))?;
        ending.to_str().and_then(Self::from_name).ok_or_else(|| unknown("unknown ending"))
    }
}

/// Writes a mesh. The recipe goes along where the format has room for a comment.
///
/// # Errors
/// As [`Target::write`].
pub fn write_mesh(mesh: &Mesh, format: MeshFormat, recipe: &str, target: &Target) -> Result<(), Error> {
    let recipe = recipe.replace(['\n', '\r'], " ");
    let triangles = mesh.triangles.iter().map(|t| t.map(|v| mesh.vertices[v]).to_vec());
    let bytes = match format {
        MeshFormat::GeoJson => polygons(triangles, &recipe).into_bytes(),
        _ => encoded(&mesh.into(), &mesh.vertices, format, &recipe, target, || mesh_figure(mesh, &recipe))?,
    };
    target.write(&bytes)
}

/// A mesh in any format but GeoJSON: `vertices` as arrays have them, `draw` for what is drawn.
pub(crate) fn encoded<const N: usize>(
    cells: &Cells,
    vertices: &[[f64; N]],
    format: MeshFormat,
    recipe: &str,
    target: &Target,
    draw: impl FnOnce() -> String,
) -> Result<Vec<u8>, Error> {
    let rendered = |result: Result<Vec<u8>, String>| result.map_err(|e| Error::content(target.name(), e));
    Ok(match format {
        MeshFormat::Msh => msh::msh(cells, recipe).into_bytes(),
        MeshFormat::Vtu => vtu::vtu(cells, recipe).into_bytes(),
        MeshFormat::Obj => plain::obj(cells, recipe).into_bytes(),
        MeshFormat::Ply => plain::ply(cells, recipe).into_bytes(),
        MeshFormat::Off => plain::off(cells, recipe).into_bytes(),
        MeshFormat::Stl => plain::stl(cells),
        MeshFormat::GeoJson => return Err(Error::content(target.name(), "maps are flat; write a mesh in space as .ply, .obj or .vtu")),
        MeshFormat::Npz => npz::npz(vertices, cells).map_err(Error::io(&target.name()))?,
        MeshFormat::Svg => draw().into_bytes(),
        MeshFormat::Png => rendered(render::png(&draw(), recipe))?,
        MeshFormat::Pdf => rendered(render::pdf(&draw(), recipe))?,
    })
}

/// Stanford's format, of whatever has vertices.
pub(crate) fn ply_text(mesh: &TriangleMesh, recipe: &str) -> String {
    plain::ply(&mesh.into(), recipe)
}

/// A mesh drawn as SVG.
pub fn mesh_svg(mesh: &Mesh) -> String {
    mesh_figure(mesh, "")
}

/// Writes polygons, such as Voronoi cells, as GeoJSON, a feature each.
///
/// # Errors
/// As [`Target::write`].
pub fn write_polygons(polygons_of: &[Vec<[f64; 2]>], recipe: &str, target: &Target) -> Result<(), Error> {
    target.write(polygons(polygons_of.iter().cloned(), recipe).as_bytes())
}

/// A feature a polygon.
fn polygons(all: impl Iterator<Item = Vec<[f64; 2]>>, recipe: &str) -> String {
    let mut text = format!("{{\"type\":\"FeatureCollection\",\"generator\":{},\"features\":[", serde_json::Value::from(recipe));
    for (k, polygon) in all.enumerate() {
        let comma = if k > 0 { "," } else { "" };
        let _ = write!(
            text,
            "{comma}\n{{\"type\":\"Feature\",\"properties\":{{\"index\":{k}}},\"geometry\":{{\"type\":\"Polygon\",\"coordinates\":[["
        );
        for [x, y] in polygon.iter().chain(polygon.first()) {
            let _ = write!(text, "[{x},{y}],");
        }
        text.pop();
        text.push_str("]]}}");
    }
    text.push_str("\n]}\n");
    text
}
