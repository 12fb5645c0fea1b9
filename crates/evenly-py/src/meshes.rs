//! Meshes of polygons.

use std::path::PathBuf;

use evenly::{EdgeKind, Mesh, MeshEdge, Polygon};
use evenly_cli::meshed::{Given, Names, meshed, wishes};
use evenly_io::{MeshFormat, Target};
use pyo3::prelude::*;

use crate::answer::{answer, json, value_error};
use crate::arrays::{Integers, Rows, array, indices, numbers, rows};
use crate::job::{Terms, run};
use crate::spaces::{DensityArg, Rings, density};

/// Vertices, triangles, the edges that had to be, what each is part of, and the rest as JSON.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "the package's wrappers name them all")]
pub fn mesh(
    py: Python,
    rings: Rings,
    words: Vec<String>,
    fixed: Rows,
    lines: Vec<Rows>,
    sizes: Option<Rows>,
    wanted: Option<DensityArg>,
    threads: Option<usize>,
    callback: Option<Py<PyAny>>,
) -> PyResult<Py<PyAny>> {
    let polygon = py.detach(|| Polygon::from_rings(rings)).map_err(value_error)?;
    let given = Given {
        fixed: rows(&fixed)?,
        lines: lines.iter().map(rows).collect::<PyResult<_>>()?,
        regions: Vec::new(),
        sizes: sizes.as_ref().map(rows).transpose()?,
        density: wanted.map(|wanted| density(py, Some(wanted))).transpose()?,
    };
    run(py, Terms { threads, callback }, move |context, _| {
        let names = Names { polygon: "the polygon".as_ref(), fixed: "fixed".as_ref(), lines: "lines".as_ref() };
        let made = meshed(&polygon, names, &wishes(&words)?, given, context)?;
        let unmet: Vec<String> = made.unmet.iter().map(ToString::to_string).collect();
        let said = json(&serde_json::json!({ "quality": made.quality, "run": made.report, "notes": made.report.notes, "unmet": unmet }))?;
        let Mesh { vertices, triangles, edges, sizes, .. } = made.mesh;
        answer(move |py| {
            let ends = edges.iter().map(|edge| edge.ends.map(|v| v as i64)).collect();
            let triangles = triangles.iter().map(|corners| corners.map(|v| v as i64)).collect();
            let whole =
                (array(py, vertices)?, array(py, triangles)?, array(py, ends)?, numbers(py, edges.iter().map(tag).collect()), said, sizes);
            Ok(whole.into_pyobject(py)?.into_any().unbind())
        })
    })
}

/// A segment of the border as 0, 1, ..., a line as -1, -2, ...
fn tag(edge: &MeshEdge) -> i64 {
    match edge.kind {
        EdgeKind::Border { segment } => segment as i64,
        EdgeKind::Line { line } => -1 - line as i64,
        EdgeKind::Between => i64::MIN,
    }
}

/// The same mesh as numbers.
fn whole(vertices: &Rows, triangles: &Integers, edges: &Integers, tags: Vec<i64>, sizes: Vec<f64>) -> PyResult<Mesh> {
    let kind = |tag: i64| match usize::try_from(tag) {
        Ok(segment) => EdgeKind::Border { segment },
        Err(_) => EdgeKind::Line { line: (-1 - tag) as usize },
    };
    let ends = indices(edges)?;
    let edges = ends.into_iter().zip(tags).map(|(ends, tag)| MeshEdge { ends, kind: kind(tag) }).collect();
    Ok(Mesh { vertices: rows(vertices)?, triangles: indices(triangles)?, edges, sizes, ..Mesh::default() })
}

/// Writes a mesh, whose format the path tells.
#[pyfunction]
pub fn write_mesh(
    py: Python,
    path: PathBuf,
    vertices: Rows,
    triangles: Integers,
    edges: Integers,
    tags: Vec<i64>,
    sizes: Vec<f64>,
) -> PyResult<()> {
    let mesh = whole(&vertices, &triangles, &edges, tags, sizes)?;
    py.detach(|| {
        let target = Target::any(&path, true)?;
        evenly_io::write_mesh(&mesh, MeshFormat::of_path(&path)?, "evenly", &target)
    })
    .map_err(value_error)
}

/// A mesh as SVG.
#[pyfunction]
pub fn mesh_figure(vertices: Rows, triangles: Integers, edges: Integers, tags: Vec<i64>) -> PyResult<String> {
    Ok(evenly_io::mesh_svg(&whole(&vertices, &triangles, &edges, tags, Vec::new())?))
}
