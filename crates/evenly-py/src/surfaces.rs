//! Meshes in space: points on them measured; written, and drawn.

use std::path::PathBuf;

use evenly::{Attribute, SurfacePoint, TriangleMesh};
use evenly_io::{MeshFormat, Target, read_triangles};
use evenly_jobs::{place_attributes, surface_of};
use pyo3::prelude::*;

use crate::answer::{answer, value_error};
use crate::arrays::{Integers, Rows, array, indices, numbers, rows};
use crate::job::{Terms, run};
use crate::points::radial_arrays;

/// A mesh: vertices and triangles, or a file.
#[derive(FromPyObject)]
pub enum Shape<'py> {
    Arrays(Rows<'py>, Integers<'py>),
    File(PathBuf),
}

impl Shape<'_> {
    /// The mesh, and how it is called in errors.
    fn mesh(&self, py: Python) -> PyResult<(TriangleMesh, String)> {
        match self {
            Self::Arrays(vertices, triangles) => {
                let mesh = TriangleMesh { vertices: rows(vertices)?, triangles: indices(triangles)?, attributes: Vec::new() };
                Ok((mesh, "the mesh".into()))
            }
            Self::File(path) => {
                let read = py.detach(|| read_triangles(path)).map_err(value_error)?;
                Ok((read.mesh, path.display().to_string()))
            }
        }
    }
}

/// Positions, facets, weights and normals of places.
pub fn place_arrays(py: Python, places: &[SurfacePoint]) -> PyResult<[Py<PyAny>; 4]> {
    Ok([
        array(py, places.iter().map(|place| place.position).collect())?,
        numbers(py, places.iter().map(|place| place.facet as i64).collect()),
        array(py, places.iter().map(|place| place.barycentric).collect())?,
        array(py, places.iter().map(|place| place.normal).collect())?,
    ])
}

/// The smallest and the mean distance of points on a surface, and the curves of their distances.
#[pyfunction]
pub fn surface_spectrum(
    py: Python,
    shape: Shape,
    points: Rows,
    is_local: bool,
    is_repaired: bool,
    threads: Option<usize>,
) -> PyResult<Py<PyAny>> {
    let (mesh, name) = shape.mesh(py)?;
    let points: Vec<[f64; 3]> = rows(&points)?;
    run(py, Terms { threads, callback: None }, move |_| {
        let surface = surface_of(&mesh, &name, is_repaired)?;
        let measures = evenly::measure_on_surface(&surface, &points)?;
        let radial = evenly::surface_spectrum(&surface, &points, is_local)?;
        let distances = (measures.min_distance, measures.mean_distance);
        answer(move |py| Ok((distances, radial_arrays(py, radial)).into_pyobject(py)?.into_any().unbind()))
    })
}

/// A mesh with what its vertices know of the surface, from arrays.
fn whole(places: (Rows, Vec<i64>, Rows, Rows), triangles: &Integers, attributes: Vec<(String, Vec<f64>)>) -> PyResult<TriangleMesh> {
    let (positions, facets, weights, normals) = places;
    let vertices: Vec<[f64; 3]> = rows(&positions)?;
    let (weights, normals): (Vec<[f64; 3]>, Vec<[f64; 3]>) = (rows(&weights)?, rows(&normals)?);
    let facets = facets.iter().map(|&facet| usize::try_from(facet).map_err(value_error)).collect::<PyResult<Vec<usize>>>()?;
    let columns = facets.into_iter().zip(weights).zip(normals);
    let places: Vec<SurfacePoint> = { vertices.iter().zip(columns) }
        .map(|(&position, ((facet, barycentric), normal))| SurfacePoint { position, facet, barycentric, normal })
        .collect();
    let mut all: Vec<Attribute> = attributes.into_iter().map(|(name, values)| Attribute { name, values }).collect();
    let own = place_attributes(&places);
    all.retain(|attribute| own.iter().all(|other| other.name != attribute.name));
    all.extend(own);
    Ok(TriangleMesh { vertices, triangles: indices(triangles)?, attributes: all })
}

/// Writes a mesh, whose format the path tells.
#[pyfunction]
pub fn write_surface(
    py: Python,
    path: PathBuf,
    places: (Rows, Vec<i64>, Rows, Rows),
    triangles: Integers,
    attributes: Vec<(String, Vec<f64>)>,
) -> PyResult<()> {
    let mesh = whole(places, &triangles, attributes)?;
    py.detach(|| {
        let target = Target::any(&path, true)?;
        evenly_io::write_triangles(&mesh, MeshFormat::of_path(&path)?, "evenly", &target)
    })
    .map_err(value_error)
}

/// A mesh as SVG, shaded.
#[pyfunction]
pub fn surface_figure(vertices: Rows, triangles: Integers) -> PyResult<String> {
    Ok(evenly_io::triangles_svg(&TriangleMesh { vertices: rows(&vertices)?, triangles: indices(&triangles)?, attributes: Vec::new() }))
}
