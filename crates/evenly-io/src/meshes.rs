//! Meshes as files: for solvers, for modellers, for maps, and drawn.

mod cells;
mod msh;
mod npz;
mod plain;
mod ply;
mod vtu;

use std::fmt::Write as _;
use std::path::Path;

use evenly::{Mesh, TriangleMesh};

use self::cells::Cells;
pub(crate) use self::ply::COLOURS;
use crate::figure::mesh_figure;
use crate::text::Shortest;
use crate::{Error, Target, render};

/// A format of meshes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeshFormat {
    /// Gmsh 4.1, as text; boundary segments and lines are physical groups.
    Msh,
    /// VTK's unstructured grid, as text.
    Vtu,
    /// Wavefront.
    Obj,
    /// Stanford's, binary.
    Ply,
    /// Stanford's, as text.
    PlyText,
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
    target.write(&encode_mesh(mesh, format, recipe, target)?)
}

/// A mesh as it would be written to a target.
///
/// # Errors
/// As [`write_mesh`].
pub fn encode_mesh(mesh: &Mesh, format: MeshFormat, recipe: &str, target: &Target) -> Result<Vec<u8>, Error> {
    let recipe = recipe.replace(['\n', '\r'], " ");
    let triangles = mesh.triangles.iter().map(|t| t.map(|v| mesh.vertices[v]).to_vec());
    match format {
        MeshFormat::GeoJson => Ok(polygons(triangles, &recipe).into_bytes()),
        _ => encoded(&mesh.into(), &mesh.vertices, format, &recipe, target, || mesh_figure(mesh, &recipe)),
    }
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
        MeshFormat::Ply => ply::binary(cells, recipe),
        MeshFormat::PlyText => ply::text(cells, recipe).into_bytes(),
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
pub(crate) fn ply(mesh: &TriangleMesh, recipe: &str, is_text: bool) -> Vec<u8> {
    let cells = mesh.into();
    if is_text { ply::text(&cells, recipe).into_bytes() } else { ply::binary(&cells, recipe) }
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
    target.write(&encode_polygons(polygons_of, recipe))
}

/// Polygons as GeoJSON, a feature each.
pub fn encode_polygons(polygons_of: &[Vec<[f64; 2]>], recipe: &str) -> Vec<u8> {
    polygons(polygons_of.iter().cloned(), recipe).into_bytes()
}

/// A feature a polygon.
fn polygons(all: impl Iterator<Item = Vec<[f64; 2]>>, recipe: &str) -> String {
    features(all, recipe, "Polygon", |text, polygon| {
        text.push_str("[[");
        for (k, &p) in polygon.iter().chain(polygon.first()).enumerate() {
            text.push_str(if k > 0 { "," } else { "" });
            push_place(text, p);
        }
        text.push_str("]]");
    })
}

/// A feature a point.
pub(crate) fn map_of_points(points: &[[f64; 2]], recipe: &str) -> String {
    features(points.iter().copied(), recipe, "Point", push_place)
}

fn push_place(text: &mut String, [x, y]: [f64; 2]) {
    let _ = write!(text, "[{},{}]", Shortest(x), Shortest(y));
}

/// GeoJSON with a feature for each geometry of one kind; `push` writes its coordinates.
fn features<T>(all: impl Iterator<Item = T>, recipe: &str, kind: &str, push: impl Fn(&mut String, T)) -> String {
    let mut text = format!("{{\"type\":\"FeatureCollection\",\"generator\":{},\"features\":[", serde_json::Value::from(recipe));
    for (k, geometry) in all.enumerate() {
        let comma = if k > 0 { "," } else { "" };
        let properties = format!("{{\"index\":{k}}}");
        let _ =
            write!(text, "{comma}\n{{\"type\":\"Feature\",\"properties\":{properties},\"geometry\":{{\"type\":\"{kind}\",\"coordinates\":");
        push(&mut text, geometry);
        text.push_str("}}");
    }
    text.push_str("\n]}\n");
    text
}
