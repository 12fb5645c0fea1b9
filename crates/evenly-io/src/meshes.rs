//! Meshes as files: for solvers, for modellers, for maps, and drawn.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;

use evenly::{EdgeKind, Mesh};

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
    let rendered = |result: Result<Vec<u8>, String>| result.map_err(|e| Error::content(target.name(), e));
    let bytes = match format {
        MeshFormat::Msh => msh(mesh, &recipe).into_bytes(),
        MeshFormat::Vtu => vtu(mesh, &recipe).into_bytes(),
        MeshFormat::Obj => obj(mesh, &recipe).into_bytes(),
        MeshFormat::Ply => ply(mesh, &recipe).into_bytes(),
        MeshFormat::Off => off(mesh, &recipe).into_bytes(),
        MeshFormat::Stl => stl(mesh),
        MeshFormat::GeoJson => polygons(mesh.triangles.iter().map(|t| t.map(|v| mesh.vertices[v]).to_vec()), &recipe).into_bytes(),
        MeshFormat::Npz => npz(mesh).map_err(Error::io(&target.name()))?,
        MeshFormat::Svg => mesh_figure(mesh, &recipe).into_bytes(),
        MeshFormat::Png => rendered(render::png(&mesh_figure(mesh, &recipe), &recipe))?,
        MeshFormat::Pdf => rendered(render::pdf(&mesh_figure(mesh, &recipe), &recipe))?,
    };
    target.write(&bytes)
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

/// The number by which an edge is tagged: of the border 1 and up, of lines after that.
fn tag(kind: EdgeKind, n_segments: usize) -> usize {
    match kind {
        EdgeKind::Border { segment } => segment + 1,
        EdgeKind::Line { line } => n_segments + line + 1,
    }
}

fn n_segments(mesh: &Mesh) -> usize {
    let segments = mesh.edges.iter().filter_map(|edge| if let EdgeKind::Border { segment } = edge.kind { Some(segment + 1) } else { None });
    segments.max().unwrap_or(0)
}

/// The physical groups: the inside, the border, the lines.
const GROUPS: [(usize, usize, &str); 3] = [(2, 1, "domain"), (1, 1, "border"), (1, 2, "lines")];

/// Nodes that no element needs do not exist here, so one surface entity holds them all; each segment of the border, and each line, is a curve entity of its own.
fn msh(mesh: &Mesh, recipe: &str) -> String {
    let n_segments = n_segments(mesh);
    let mut curves: Vec<(usize, Vec<[usize; 2]>)> = Vec::new();
    let mut edges: Vec<(usize, [usize; 2])> = mesh.edges.iter().map(|edge| (tag(edge.kind, n_segments), edge.ends)).collect();
    edges.sort_by_key(|&(tag, _)| tag);
    for (tag, ends) in edges {
        match curves.last_mut() {
            Some((last, all)) if *last == tag => all.push(ends),
            _ => curves.push((tag, vec![ends])),
        }
    }
    let mut text = format!("$Comments\n{recipe}\n$EndComments\n$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n{}\n", GROUPS.len());
    for (dimension, number, name) in GROUPS {
        let _ = writeln!(text, "{dimension} {number} \"{name}\"");
    }
    text.push_str("$EndPhysicalNames\n");
    let bounds = |points: &mut dyn Iterator<Item = usize>| {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for v in points {
            for axis in 0..2 {
                (low[axis], high[axis]) = (low[axis].min(mesh.vertices[v][axis]), high[axis].max(mesh.vertices[v][axis]));
            }
        }
        format!("{} {} 0 {} {} 0", low[0], low[1], high[0], high[1])
    };
    let _ = writeln!(text, "$Entities\n0 {} 1 0", curves.len());
    for (tag, edges) in &curves {
        let group = if *tag > n_segments { 2 } else { 1 };
        let _ = writeln!(text, "{tag} {} 1 {group} 0", bounds(&mut edges.iter().flatten().copied()));
    }
    let border: Vec<String> = curves.iter().filter(|(tag, _)| *tag <= n_segments).map(|(tag, _)| tag.to_string()).collect();
    let _ = writeln!(text, "1 {} 1 1 {} {}\n$EndEntities", bounds(&mut (0..mesh.vertices.len())), border.len(), border.join(" "));
    let n = mesh.vertices.len();
    let _ = writeln!(text, "$Nodes\n1 {n} 1 {n}\n2 1 0 {n}");
    (1..=n).for_each(|v| {
        let _ = writeln!(text, "{v}");
    });
    for [x, y] in &mesh.vertices {
        let _ = writeln!(text, "{x} {y} 0");
    }
    let n_elements = mesh.edges.len() + mesh.triangles.len();
    let _ = writeln!(text, "$EndNodes\n$Elements\n{} {n_elements} 1 {n_elements}", curves.len() + 1);
    let mut number = 0;
    for (tag, edges) in &curves {
        let _ = writeln!(text, "1 {tag} 1 {}", edges.len());
        for [a, b] in edges {
            number += 1;
            let _ = writeln!(text, "{number} {} {}", a + 1, b + 1);
        }
    }
    let _ = writeln!(text, "2 1 2 {}", mesh.triangles.len());
    for [a, b, c] in &mesh.triangles {
        number += 1;
        let _ = writeln!(text, "{number} {} {} {}", a + 1, b + 1, c + 1);
    }
    text.push_str("$EndElements\n");
    text
}

/// Triangles, and after them the edges of the border and of lines; the cell array `tag` tells which.
fn vtu(mesh: &Mesh, recipe: &str) -> String {
    let n_segments = n_segments(mesh);
    let (n, n_triangles, n_edges) = (mesh.vertices.len(), mesh.triangles.len(), mesh.edges.len());
    let comment = recipe.replace("--", "- -");
    let mut text = format!(
        "<?xml version=\"1.0\"?>\n<!-- {comment} -->\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"{n}\" NumberOfCells=\"{}\">\n\
         <Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n",
        n_triangles + n_edges
    );
    for [x, y] in &mesh.vertices {
        let _ = writeln!(text, "{x} {y} 0");
    }
    text.push_str("</DataArray>\n</Points>\n<Cells>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n");
    for [a, b, c] in &mesh.triangles {
        let _ = writeln!(text, "{a} {b} {c}");
    }
    for edge in &mesh.edges {
        let _ = writeln!(text, "{} {}", edge.ends[0], edge.ends[1]);
    }
    text.push_str("</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n");
    (1..=n_triangles).map(|k| 3 * k).chain((1..=n_edges).map(|k| 3 * n_triangles + 2 * k)).for_each(|end| {
        let _ = writeln!(text, "{end}");
    });
    text.push_str("</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n");
    text.push_str(&"5\n".repeat(n_triangles));
    text.push_str(&"3\n".repeat(n_edges));
    text.push_str("</DataArray>\n</Cells>\n<CellData Scalars=\"tag\">\n<DataArray type=\"Int64\" Name=\"tag\" format=\"ascii\">\n");
    text.push_str(&"0\n".repeat(n_triangles));
    for edge in &mesh.edges {
        let _ = writeln!(text, "{}", tag(edge.kind, n_segments));
    }
    text.push_str("</DataArray>\n</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    text
}

fn obj(mesh: &Mesh, recipe: &str) -> String {
    let mut text = format!("# {recipe}\n");
    for [x, y] in &mesh.vertices {
        let _ = writeln!(text, "v {x} {y} 0");
    }
    for [a, b, c] in &mesh.triangles {
        let _ = writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1);
    }
    text
}

fn ply(mesh: &Mesh, recipe: &str) -> String {
    let mut text = format!(
        "ply\nformat ascii 1.0\ncomment {recipe}\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.vertices.len(),
        mesh.triangles.len()
    );
    for [x, y] in &mesh.vertices {
        let _ = writeln!(text, "{x} {y} 0");
    }
    for [a, b, c] in &mesh.triangles {
        let _ = writeln!(text, "3 {a} {b} {c}");
    }
    text
}

fn off(mesh: &Mesh, recipe: &str) -> String {
    let mut text = format!("OFF\n# {recipe}\n{} {} 0\n", mesh.vertices.len(), mesh.triangles.len());
    for [x, y] in &mesh.vertices {
        let _ = writeln!(text, "{x} {y} 0");
    }
    for [a, b, c] in &mesh.triangles {
        let _ = writeln!(text, "3 {a} {b} {c}");
    }
    text
}

/// Single precision is all that the format has.
fn stl(mesh: &Mesh) -> Vec<u8> {
    let mut bytes = vec![0u8; 80];
    bytes[..6].copy_from_slice(b"evenly");
    bytes.extend((mesh.triangles.len() as u32).to_le_bytes());
    for t in &mesh.triangles {
        for x in [0f32, 0.0, 1.0] {
            bytes.extend(x.to_le_bytes());
        }
        for [x, y] in t.map(|v| mesh.vertices[v]) {
            for x in [x as f32, y as f32, 0.0] {
                bytes.extend(x.to_le_bytes());
            }
        }
        bytes.extend([0, 0]);
    }
    bytes
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

/// Vertices (n, 2), triangles (m, 3), edges (k, 2) and their tags (k).
fn npz(mesh: &Mesh) -> std::io::Result<Vec<u8>> {
    use npyz::WriterBuilder as _;
    let mut bytes = std::io::Cursor::new(Vec::new());
    let mut archive = npyz::npz::NpzWriter::new(&mut bytes);
    let n_segments = n_segments(mesh);
    {
        let shape = [mesh.vertices.len() as u64, 2];
        let mut array = archive.array("vertices", Default::default())?.default_dtype().shape(&shape).begin_nd()?;
        array.extend(mesh.vertices.iter().flatten())?;
        array.finish()?;
    }
    let numbers = |all: &mut dyn Iterator<Item = usize>| all.map(|number| number as i64).collect::<Vec<i64>>();
    let arrays = [
        ("triangles", vec![mesh.triangles.len() as u64, 3], numbers(&mut mesh.triangles.iter().flatten().copied())),
        ("edges", vec![mesh.edges.len() as u64, 2], numbers(&mut mesh.edges.iter().flat_map(|edge| edge.ends))),
        ("edge_tags", vec![mesh.edges.len() as u64], numbers(&mut mesh.edges.iter().map(|edge| tag(edge.kind, n_segments)))),
    ];
    for (name, shape, numbers) in arrays {
        let mut array = archive.array(name, Default::default())?.default_dtype().shape(&shape).begin_nd()?;
        array.extend(numbers)?;
        array.finish()?;
    }
    drop(archive);
    bytes.flush()?;
    Ok(bytes.into_inner())
}
