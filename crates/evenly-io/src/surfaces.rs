//! Meshes in space from files and into files: Wavefront, Stanford's, stereolithography, Geomview's, glTF, Gmsh's, VTK's, numpy's. Units are kept.

mod building;
mod gltf;
mod lines;
mod msh;
mod npz;
mod obj;
mod off;
mod ply;
mod polygons;
mod stl;
mod vtu;

use std::borrow::Cow;
use std::path::Path;

use evenly::TriangleMesh;

use crate::figure::{compared_svg, shaded_figure};
use crate::file::read_bytes;
use crate::meshes::encoded;
use crate::output::write_svg;
use crate::{Error, MeshFormat, Target, text};

/// What a file of triangles holds.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TrianglesRead {
    /// The triangles.
    pub mesh: TriangleMesh,
    /// What was changed or left out, in words for the user.
    pub notes: Vec<String>,
}

/// A format that is read.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    Obj,
    Ply,
    Stl,
    Off,
    Gltf,
    Msh,
    Vtu,
    Npz,
}

const ENDINGS: [(&str, Kind); 9] = [
    ("obj", Kind::Obj),
    ("ply", Kind::Ply),
    ("stl", Kind::Stl),
    ("off", Kind::Off),
    ("gltf", Kind::Gltf),
    ("glb", Kind::Gltf),
    ("msh", Kind::Msh),
    ("vtu", Kind::Vtu),
    ("npz", Kind::Npz),
];

/// Whether a file is one of a mesh in space, by its ending.
pub fn is_mesh_file(path: &Path) -> bool {
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    ENDINGS.iter().any(|(known, _)| ending.eq_ignore_ascii_case(known))
}

/// Reads triangles. The file's ending tells the format; where it does not, or for `-`, its first bytes do.
///
/// Polygons are cut into triangles. Vertices stay as they are, but for those of stereolithography, which are one where their positions are the same.
///
/// # Errors
/// [`Error::Content`] with the file's name, and the line or the number of what is wrong with it; [`Error::Format`] where nothing tells the format.
pub fn read_triangles(path: &Path) -> Result<TrianglesRead, Error> {
    let (name, bytes) = read_bytes(path)?;
    let kind = kind_of(path, &bytes).ok_or_else(|| {
        let choices = ENDINGS.iter().map(|(name, _)| format!(".{name}")).collect::<Vec<_>>().join(" ");
        Error::Format { name: name.clone(), problem: "neither its ending nor its first bytes tell a format of meshes", choices }
    })?;
    parse(kind, &name, &bytes, folder_of(path))
}

/// Reads triangles, or points in space where there are no triangles: `.ply` without faces, and the first three numbers of each line of text.
///
/// # Errors
/// As [`read_triangles`].
pub fn read_triangles_or_points(path: &Path) -> Result<TrianglesRead, Error> {
    let (name, bytes) = read_bytes(path)?;
    let read = match kind_of(path, &bytes) {
        Some(Kind::Ply) if ply::is_binary(&bytes) => ply::read(&name, &bytes, true)?,
        Some(Kind::Ply) => ply::read(&name, &text::plain(&bytes), true)?,
        Some(kind) => parse(kind, &name, &bytes, folder_of(path))?,
        None if !holds_text(path) => {
            let choices = [".csv", ".txt"].into_iter().map(str::to_owned).chain(ENDINGS.iter().map(|(name, _)| format!(".{name}")));
            let choices = choices.collect::<Vec<_>>().join(" ");
            return Err(Error::Format { name, problem: "no format of points in space", choices });
        }
        None => {
            let mesh = TriangleMesh { vertices: text::read_xyz(&name, &bytes)?, ..TriangleMesh::default() };
            TrianglesRead { mesh, notes: Vec::new() }
        }
    };
    if read.mesh.vertices.is_empty() { Err(Error::content(name, "there are no points in it")) } else { Ok(read) }
}

/// Whether a file's ending is one of text, or none.
fn holds_text(path: &Path) -> bool {
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    ["", "csv", "txt", "xyz"].iter().any(|known| ending.eq_ignore_ascii_case(known))
}

/// The format that a file's ending tells, or its first bytes.
fn kind_of(path: &Path, bytes: &[u8]) -> Option<Kind> {
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    let known = ENDINGS.iter().find(|(known, _)| ending.eq_ignore_ascii_case(known)).map(|&(_, kind)| kind);
    known.or_else(|| evident(bytes))
}

/// Where other files lie that a file names.
fn folder_of(path: &Path) -> &Path {
    path.parent().unwrap_or(Path::new(""))
}

/// The format that the first bytes tell.
fn evident(bytes: &[u8]) -> Option<Kind> {
    let text = if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") { text::plain(bytes) } else { Cow::Borrowed(bytes) };
    let first = lines::Text::new("", &text).next_line().and_then(|mut line| line.word()).unwrap_or_default();
    match first {
        b"ply" => Some(Kind::Ply),
        b"solid" => Some(Kind::Stl),
        b"v" | b"vn" | b"vt" | b"o" | b"g" | b"s" | b"mtllib" | b"usemtl" => Some(Kind::Obj),
        b"$MeshFormat" | b"$Comments" => Some(Kind::Msh),
        _ if bytes.starts_with(b"PK\x03\x04") => Some(Kind::Npz),
        _ if first.starts_with(b"<?xml") || first.starts_with(b"<VTKFile") => Some(Kind::Vtu),
        _ if first.ends_with(b"OFF") => Some(Kind::Off),
        _ if first.starts_with(b"glTF") || first.starts_with(b"{") => Some(Kind::Gltf),
        _ if stl::is_binary(bytes) => Some(Kind::Stl),
        _ => None,
    }
}

/// `folder` is where other files lie that this one names.
fn parse(kind: Kind, name: &str, bytes: &[u8], folder: &Path) -> Result<TrianglesRead, Error> {
    let is_binary = [Kind::Npz, Kind::Vtu].contains(&kind) || bytes.starts_with(b"glTF") || stl::is_binary(bytes) || ply::is_binary(bytes);
    let text = if is_binary { Cow::Borrowed(bytes) } else { text::plain(bytes) };
    let bytes = &*text;
    match kind {
        Kind::Obj => obj::read(name, bytes),
        Kind::Ply => ply::read(name, bytes, false),
        Kind::Stl => stl::read(name, bytes),
        Kind::Off => off::read(name, bytes),
        Kind::Gltf => gltf::read(name, bytes, folder),
        Kind::Msh => msh::read(name, bytes),
        Kind::Vtu => vtu::read(name, bytes),
        Kind::Npz => npz::read(name, bytes),
    }
}

/// Writes triangles. The recipe goes along where the format has room for a comment; attributes in `.ply`, `.vtu` and `.npz`.
///
/// # Errors
/// As [`Target::write`]; for GeoJSON, which is flat, and for a mesh whose parts do not fit together.
pub fn write_triangles(mesh: &TriangleMesh, format: MeshFormat, recipe: &str, target: &Target) -> Result<(), Error> {
    check(mesh).map_err(|problem| Error::content(target.name(), problem))?;
    let is_too_large = |x: &f64| x.abs() > f64::from(f32::MAX);
    if format == MeshFormat::Stl && mesh.vertices.iter().flatten().any(is_too_large) {
        return Err(Error::content(target.name(), "STL has no numbers above 3.4e38; write .ply or .obj"));
    }
    let recipe = recipe.replace(['\n', '\r'], " ");
    let bytes = encoded(&mesh.into(), &mesh.vertices, format, &recipe, target, || shaded_figure(mesh, &recipe))?;
    target.write(&bytes)
}

/// What the single precision of STL does to a mesh, in words for the user, if it is much: more than a thousandth of its shortest edge.
pub fn stl_rounding(mesh: &TriangleMesh) -> Option<String> {
    let rounded = |p: &[f64; 3]| p.map(|x| f64::from(x as f32));
    let length = |p: &[f64; 3], q: &[f64; 3]| (0..3).map(|k| (p[k] - q[k]).powi(2)).sum::<f64>().sqrt();
    let farthest = mesh.vertices.iter().map(|p| length(p, &rounded(p))).fold(0.0, f64::max);
    let sides = |t: &[usize; 3]| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
    let edges = mesh.triangles.iter().flat_map(sides);
    let shortest = edges.map(|[a, b]| length(&mesh.vertices[a], &mesh.vertices[b])).fold(f64::INFINITY, f64::min);
    if farthest <= 1e-3 * shortest {
        return None;
    }
    let area = |t: &&[usize; 3]| {
        let [a, b, c] = t.map(|v| rounded(&mesh.vertices[v]));
        let (u, v) = ([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
        [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]].iter().all(|&x| x == 0.0)
    };
    let n_flat = mesh.triangles.iter().filter(area).count();
    Some(format!(
        "STL has seven digits: positions are rounded by up to {farthest:.1e}, and {n_flat} triangles lose their area; write .ply or .obj, or move the mesh nearer to 0"
    ))
}

/// Gives a mesh the positions that it has as STL.
pub fn round_as_stl(mesh: &mut TriangleMesh) {
    mesh.vertices.as_flattened_mut().iter_mut().for_each(|x| *x = f64::from(*x as f32));
}

/// Draws meshes, shaded, side by side under their captions where there are several. The recipe goes along as a comment.
///
/// # Errors
/// As [`Target::write`]; [`Error::Format`] for a target that holds points.
pub fn write_triangles_figure(meshes: &[(&str, &TriangleMesh)], recipe: &str, target: &Target) -> Result<(), Error> {
    let recipe = recipe.replace(['\n', '\r'], " ");
    let svg = match meshes {
        [(_, mesh)] => shaded_figure(mesh, &recipe),
        _ => compared_svg(meshes),
    };
    write_svg(svg, &recipe, target)
}

/// That triangles have vertices, and vertices their attributes.
fn check(mesh: &TriangleMesh) -> Result<(), String> {
    let n = mesh.vertices.len();
    if mesh.triangles.is_empty() {
        return Err("the mesh has no triangles".into());
    }
    if let Some(t) = mesh.triangles.iter().position(|t| t.iter().any(|&v| v >= n)) {
        return Err(format!("triangle {t} of the mesh has the vertices {:?}, but there are only {n}", mesh.triangles[t]));
    }
    match mesh.attributes.iter().find(|attribute| attribute.values.len() != n) {
        Some(attribute) => Err(format!("the attribute {:?} has {} values for {n} vertices", attribute.name, attribute.values.len())),
        None => Ok(()),
    }
}

/// Triangles in space drawn as SVG, seen obliquely from above.
pub fn triangles_svg(mesh: &TriangleMesh) -> String {
    shaded_figure(mesh, "")
}

#[cfg(test)]
mod tests;
