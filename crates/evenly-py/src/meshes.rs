//! Meshes of polygons.

use std::path::PathBuf;

use evenly::{EdgeKind, Mesh, MeshEdge, MeshRegion, Polygon, Shape};
use evenly_cli::meshed::{Given, Names, meshed, wishes};
use evenly_io::{MeshFormat, Target};
use pyo3::prelude::*;

use crate::answer::{answer, json, value_error};
use crate::arrays::{Integers, Rows, array, indices, numbers, rows};
use crate::job::{Terms, run};
use crate::spaces::{DensityArg, Rings, density};

/// Vertices, triangles, the edges that had to be, what each is part of, and the rest as JSON, the regions of
/// triangles and so many of these in corners. Without rings, the polygon is what the regions cover together.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "the package's wrappers name them all")]
pub fn mesh(
    py: Python,
    rings: Rings,
    words: Vec<String>,
    fixed: Rows,
    lines: Vec<Rows>,
    sizes: Option<Rows>,
    regions: Vec<(String, Rings)>,
    wanted: Option<DensityArg>,
    threads: Option<usize>,
    callback: Option<Py<PyAny>>,
) -> PyResult<Py<PyAny>> {
    let region = |(name, rings): &(String, Rings)| {
        let told = |e| value_error(format!("region {name:?}: {e}"));
        Ok(MeshRegion { name: name.clone(), polygon: Polygon::from_rings(rings.clone()).map_err(told)? })
    };
    let (polygon, regions) = py.detach(|| {
        let shapes: Vec<Shape> = regions.iter().map(|(_, rings)| Shape { rings: rings.clone(), ..Shape::default() }).collect();
        let polygon = if rings.is_empty() { Polygon::of_shapes(&shapes) } else { Polygon::from_rings(rings) };
        let regions = regions.iter().map(region).collect::<PyResult<Vec<MeshRegion>>>()?;
        Ok::<_, PyErr>((polygon.map_err(value_error)?, regions))
    })?;
    let given = Given {
        fixed: rows(&fixed)?,
        lines: lines.iter().map(rows).collect::<PyResult<_>>()?,
        regions,
        sizes: sizes.as_ref().map(rows).transpose()?,
        density: wanted.map(|wanted| density(py, Some(wanted))).transpose()?,
    };
    run(py, Terms { threads, callback }, move |context, _| {
        let names = Names { polygon: "the polygon".as_ref(), fixed: "fixed".as_ref(), lines: "lines".as_ref() };
        let wishes = wishes(&words)?;
        let made = meshed(&polygon, names, &wishes, given, context)?;
        let measured = made.measured(&wishes);
        let unmet: Vec<String> = measured.unmet.iter().map(ToString::to_string).collect();
        let notes: Vec<&String> = made.report.notes.iter().chain(&measured.notes).collect();
        let said = json(&serde_json::json!({
            "quality": measured.quality, "run": made.report, "notes": notes, "unmet": unmet,
            "region_names": made.mesh.region_names, "n_in_corners": made.mesh.n_in_corners,
        }))?;
        let Mesh { vertices, triangles, edges, sizes, regions, .. } = made.mesh;
        answer(move |py| {
            let ends = edges.iter().map(|edge| edge.ends.map(|v| v as i64)).collect();
            let triangles = triangles.iter().map(|corners| corners.map(|v| v as i64)).collect();
            let regions = regions.iter().map(|&region| if region == u32::MAX { -1 } else { i64::from(region) });
            let (tags, regions) = (numbers(py, edges.iter().map(tag).collect()), numbers(py, regions.collect()));
            let whole = (array(py, vertices)?, array(py, triangles)?, array(py, ends)?, tags, said, sizes, regions);
            Ok(whole.into_pyobject(py)?.into_any().unbind())
        })
    })
}

/// What lies between two regions.
const BETWEEN: i64 = i64::MIN;

/// A segment of the border as 0, 1, ..., a line as -1, -2, ...
fn tag(edge: &MeshEdge) -> i64 {
    match edge.kind {
        EdgeKind::Border { segment } => segment as i64,
        EdgeKind::Line { line } => -1 - line as i64,
        EdgeKind::Between => BETWEEN,
    }
}

/// A mesh as Python has it: of each edge the tag, of each triangle the region, or none.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Parts<'py> {
    vertices: Rows<'py>,
    triangles: Integers<'py>,
    edges: Integers<'py>,
    tags: Vec<i64>,
    edge_length: Vec<f64>,
    regions: Vec<i64>,
    region_names: Vec<String>,
    n_in_corners: usize,
}

impl Parts<'_> {
    fn mesh(&self) -> PyResult<Mesh> {
        let kind = |tag: i64| match usize::try_from(tag) {
            Ok(segment) => EdgeKind::Border { segment },
            Err(_) if tag == BETWEEN => EdgeKind::Between,
            Err(_) => EdgeKind::Line { line: (-1 - tag) as usize },
        };
        let ends = indices(&self.edges)?;
        Ok(Mesh {
            vertices: rows(&self.vertices)?,
            triangles: indices(&self.triangles)?,
            edges: ends.into_iter().zip(&self.tags).map(|(ends, &tag)| MeshEdge { ends, kind: kind(tag) }).collect(),
            sizes: self.edge_length.clone(),
            regions: self.regions.iter().map(|&region| u32::try_from(region).unwrap_or(u32::MAX)).collect(),
            region_names: self.region_names.clone(),
            n_in_corners: self.n_in_corners,
        })
    }
}

/// Writes a mesh, whose format the path tells.
#[pyfunction]
pub fn write_mesh(py: Python, path: PathBuf, parts: Parts) -> PyResult<()> {
    let mesh = parts.mesh()?;
    py.detach(|| {
        let target = Target::any(&path, true)?;
        evenly_io::write_mesh(&mesh, MeshFormat::of_path(&path)?, "evenly", &target)
    })
    .map_err(value_error)
}

/// A mesh as SVG.
#[pyfunction]
pub fn mesh_figure(parts: Parts) -> PyResult<String> {
    Ok(evenly_io::mesh_svg(&parts.mesh()?))
}
