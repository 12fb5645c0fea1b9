//! Meshes in space: remeshed, and points on them.

use std::path::{Path, PathBuf};

use evenly::{Attribute, Outcome, Surface, SurfacePoint, SurfaceSizing, TriangleMesh};
use evenly_cli::remeshed::{self, notes_on, place_attributes, remeshed, surface_of, welded};
use evenly_cli::sampled::{self, sampled};
use evenly_io::{MeshFormat, Target, read_triangles};
use pyo3::prelude::*;

use crate::answer::{answer, json, value_error};
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
    /// The mesh, how it is called in errors, and what was done to it.
    fn mesh(&self, py: Python) -> PyResult<(TriangleMesh, PathBuf, Vec<String>)> {
        match self {
            Self::Arrays(vertices, triangles) => {
                let mesh = TriangleMesh { vertices: rows(vertices)?, triangles: indices(triangles)?, attributes: Vec::new() };
                Ok((mesh, "the mesh".into(), Vec::new()))
            }
            Self::File(path) => {
                let read = py.detach(|| read_triangles(path)).map_err(value_error)?;
                Ok((read.mesh, path.clone(), read.notes))
            }
        }
    }
}

/// A surface, and all notes on it.
fn surface(mesh: &TriangleMesh, name: &Path, is_repaired: bool, notes: &mut Vec<String>) -> anyhow::Result<Surface> {
    let surface = surface_of(mesh, name, is_repaired)?;
    notes.extend(notes_on(&surface));
    Ok(surface)
}

/// Positions, facets, weights and normals of places.
fn place_arrays(py: Python, places: &[SurfacePoint]) -> PyResult<[Py<PyAny>; 4]> {
    Ok([
        array(py, places.iter().map(|place| place.position).collect())?,
        numbers(py, places.iter().map(|place| place.facet as i64).collect()),
        array(py, places.iter().map(|place| place.barycentric).collect())?,
        array(py, places.iter().map(|place| place.normal).collect())?,
    ])
}

/// Vertices, triangles, where the vertices lie, the input's attributes there, and the rest as JSON.
#[pyfunction]
pub fn remesh(
    py: Python,
    shape: Shape,
    words: Vec<String>,
    sizes: Option<Vec<f64>>,
    points: Option<Rows>,
    threads: Option<usize>,
    callback: Option<Py<PyAny>>,
) -> PyResult<Py<PyAny>> {
    let (mesh, name, mut notes) = shape.mesh(py)?;
    let points = points.map(|points| rows(&points)).transpose()?;
    run(py, Terms { threads, callback }, move |context, _| {
        let wishes = remeshed::wishes(&words)?;
        let mesh = welded(mesh, wishes.weld, &mut notes)?;
        let surface = surface(&mesh, &name, wishes.repair, &mut notes)?;
        let sizing = match sizes {
            Some(sizes) => Some(SurfaceSizing::Given(sizes)),
            None => remeshed::sizing(wishes.density.as_deref())?,
        };
        let points = match points {
            Some(points) => points,
            None => remeshed::points(&wishes)?,
        };
        let made = remeshed(&surface, &name, &wishes, sizing.as_ref(), points, |_| {}, context)?;
        let measured = made.measured(&surface)?;
        notes.extend(made.report.notes.iter().chain(&measured.notes).cloned());
        let said = json(&serde_json::json!({
            "quality": measured.quality,
            "distance": measured.distance,
            "self_intersections": measured.self_intersections,
            "breaches": measured.breaches,
            "run": made.report,
            "notes": notes,
        }))?;
        let remeshed = made.remeshed;
        answer(move |py| {
            let triangles = remeshed.mesh.triangles.iter().map(|corners| corners.map(|v| v as i64)).collect();
            let attributes: Vec<_> = remeshed.mesh.attributes.into_iter().map(|each| (each.name, numbers(py, each.values))).collect();
            let whole = (place_arrays(py, &remeshed.places)?, array(py, triangles)?, attributes, said);
            Ok(whole.into_pyobject(py)?.into_any().unbind())
        })
    })
}

/// Where points lie, and the rest as JSON.
#[pyfunction]
pub fn sample(
    py: Python,
    shape: Shape,
    words: Vec<String>,
    sizes: Option<Vec<f64>>,
    threads: Option<usize>,
    callback: Option<Py<PyAny>>,
) -> PyResult<Py<PyAny>> {
    let (mesh, name, mut notes) = shape.mesh(py)?;
    run(py, Terms { threads, callback }, move |context, _| {
        let wishes = sampled::wishes(&words)?;
        let mesh = welded(mesh, wishes.weld, &mut notes)?;
        let surface = surface(&mesh, &name, wishes.repair, &mut notes)?;
        let sizing = match sizes {
            Some(sizes) => Some(SurfaceSizing::Given(sizes)),
            None => remeshed::sizing(wishes.density.as_deref())?,
        };
        let (places, report) = sampled(&surface, &name, &wishes, sizing.as_ref(), context)?;
        notes.extend(report.notes.iter().cloned());
        let has_missed = report.outcome == Outcome::IterationLimit;
        let said = json(&serde_json::json!({ "run": report, "notes": notes, "has_missed": has_missed }))?;
        answer(move |py| Ok((place_arrays(py, &places)?, said).into_pyobject(py)?.into_any().unbind()))
    })
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
    let (mesh, name, mut notes) = shape.mesh(py)?;
    let points: Vec<[f64; 3]> = rows(&points)?;
    run(py, Terms { threads, callback: None }, move |_, _| {
        let surface = surface(&mesh, &name, is_repaired, &mut notes)?;
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
