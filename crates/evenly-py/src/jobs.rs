//! Jobs: a request as JSON and its data in, arrays out.

use std::collections::HashMap;

use evenly::Mesh;
use evenly_jobs::{MeshOutcome, Message, Outcome, PointsOutcome, RemeshOutcome, Request, SampleOutcome, StippleOutcome};
use pyo3::prelude::*;
use serde_json::json;

use crate::answer::{Answer, Keywords, answer, value_error};
use crate::arrays::{array, numbers};
use crate::data::{Data, Given};
use crate::job::{Terms, run};
use crate::meshes::tag;
use crate::surfaces::place_arrays;

/// Does what a request asks for; what comes back is the job's own.
#[pyfunction]
pub fn perform(
    py: Python,
    request: &str,
    data: HashMap<String, Given>,
    threads: Option<usize>,
    callback: Option<Py<PyAny>>,
) -> PyResult<Py<PyAny>> {
    // By way of a value, errors have no line and column.
    let request = serde_json::from_str(request).and_then(serde_json::from_value::<Request>).map_err(value_error)?;
    let mut data = Data::new(&data)?;
    run(py, Terms { threads, callback }, move |context| match request.run(&mut data, context)? {
        Outcome::Points(outcome) => points(&outcome),
        Outcome::Mesh(outcome) => mesh(outcome),
        Outcome::Remesh(outcome) => remesh(outcome),
        Outcome::Sample(outcome) => sample(outcome),
        Outcome::Stipple(outcome) => stipple(outcome),
        Outcome::Compare(_) => Err(evenly_jobs::Error::Resource("the package compares by itself".into())),
    })
}

fn shown(notes: &[Message]) -> Vec<String> {
    notes.iter().map(|note| note.shown(&Keywords)).collect()
}

/// Positions, and the rest as JSON.
fn points(outcome: &PointsOutcome) -> Result<Answer, evenly_jobs::Error> {
    let is_measured = outcome.has_targets() && !outcome.is_cancelled();
    let unmet = is_measured.then(|| outcome.measured().unmet).flatten().unwrap_or_default();
    let unmet: Vec<String> =
        unmet.iter().map(|unmet| format!("{} is {:.6}, wanted {}", unmet.name, unmet.measured, unmet.wanted)).collect();
    let said = json!({ "run": outcome.report, "notes": shown(&outcome.notes), "unmet": unmet }).to_string();
    let positions = outcome.restored()?.into_positions();
    answer(move |py| Ok((array(py, positions)?, said).into_pyobject(py)?.into_any().unbind()))
}

/// Vertices, triangles, the edges that had to be, what each is part of, the rest as JSON, the lengths wanted at vertices and the regions of triangles.
fn mesh(outcome: MeshOutcome) -> Result<Answer, evenly_jobs::Error> {
    let measured = outcome.measured();
    let unmet: Vec<String> = measured.unmet.iter().map(ToString::to_string).collect();
    let notes: Vec<String> = shown(&outcome.notes).into_iter().chain(shown(&measured.notes)).collect();
    let said = json!({
        "quality": measured.quality, "run": outcome.report, "notes": notes, "unmet": unmet,
        "region_names": outcome.mesh.region_names, "n_in_corners": outcome.mesh.n_in_corners,
    });
    let (said, Mesh { vertices, triangles, edges, sizes, regions, .. }) = (said.to_string(), outcome.mesh);
    answer(move |py| {
        let ends = edges.iter().map(|edge| edge.ends.map(|v| v as i64)).collect();
        let triangles = triangles.iter().map(|corners| corners.map(|v| v as i64)).collect();
        let regions = regions.iter().map(|&region| if region == u32::MAX { -1 } else { i64::from(region) });
        let (tags, regions) = (numbers(py, edges.iter().map(tag).collect()), numbers(py, regions.collect()));
        let whole = (array(py, vertices)?, array(py, triangles)?, array(py, ends)?, tags, said, sizes, regions);
        Ok(whole.into_pyobject(py)?.into_any().unbind())
    })
}

/// Vertices, triangles, where the vertices lie, the input's attributes there, and the rest as JSON.
fn remesh(outcome: RemeshOutcome) -> Result<Answer, evenly_jobs::Error> {
    let measured = outcome.measured()?;
    let notes: Vec<String> = shown(&outcome.notes).into_iter().chain(shown(&measured.notes)).collect();
    let said = json!({
        "quality": measured.quality, "distance": measured.distance, "self_intersections": measured.self_intersections,
        "breaches": measured.breaches, "run": outcome.report, "notes": notes,
    });
    let (said, remeshed) = (said.to_string(), outcome.remeshed);
    answer(move |py| {
        let triangles = remeshed.mesh.triangles.iter().map(|corners| corners.map(|v| v as i64)).collect();
        let attributes: Vec<_> = remeshed.mesh.attributes.into_iter().map(|each| (each.name, numbers(py, each.values))).collect();
        let whole = (place_arrays(py, &remeshed.places)?, array(py, triangles)?, attributes, said);
        Ok(whole.into_pyobject(py)?.into_any().unbind())
    })
}

/// Where points lie, and the rest as JSON.
fn sample(outcome: SampleOutcome) -> Result<Answer, evenly_jobs::Error> {
    let said = json!({ "run": outcome.report, "notes": shown(&outcome.notes) }).to_string();
    answer(move |py| Ok((place_arrays(py, &outcome.points)?, said).into_pyobject(py)?.into_any().unbind()))
}

/// The picture's width and height, and for each layer its name, colour, dots, areas and the widest dot.
fn stipple(outcome: StippleOutcome) -> Result<Answer, evenly_jobs::Error> {
    answer(move |py| {
        let layers = outcome.layers.into_iter().map(|layer| {
            let dots = array(py, layer.points.into_positions())?;
            Ok((layer.name, layer.colour, dots, numbers(py, layer.areas), layer.widest_px))
        });
        let whole = (outcome.picture_px, layers.collect::<PyResult<Vec<_>>>()?);
        Ok(whole.into_pyobject(py)?.into_any().unbind())
    })
}
