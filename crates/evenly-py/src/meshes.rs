//! Meshes of polygons: written, and drawn.

use std::path::PathBuf;

use evenly::{EdgeKind, Mesh, MeshEdge};
use evenly_io::{MeshFormat, Target};
use pyo3::prelude::*;

use crate::answer::value_error;
use crate::arrays::{Integers, Rows, indices, rows};

/// What lies between two regions.
const BETWEEN: i64 = i64::MIN;

/// A segment of the boundary as 0, 1, ..., a line as -1, -2, ...
pub fn tag(edge: &MeshEdge) -> i64 {
    match edge.kind {
        EdgeKind::Boundary { segment } => segment as i64,
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
            Ok(segment) => EdgeKind::Boundary { segment },
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
