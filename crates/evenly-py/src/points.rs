//! Points: measured, and drawn.

use evenly::{PointSet, RadialSpectrum};
use evenly_io::{Draw, Subject};
use evenly_jobs::Error;
use pyo3::prelude::*;

use crate::answer::{answer, value_error};
use crate::arrays::{Rows, array, numbers, rows};
use crate::job::{Terms, run};
use crate::spaces::{DensityArg, SpaceArg, measured_set, point_set};

/// All measures, as JSON.
#[pyfunction]
pub fn measure(py: Python, points: Rows, space: SpaceArg, density: Option<DensityArg>, threads: Option<usize>) -> PyResult<Py<PyAny>> {
    let points = measured_set(py, &points, space, density)?;
    run(py, Terms { threads, callback: None }, move |_| {
        let said = serde_json::json!(evenly::measure(&points)?).to_string();
        answer(move |py| Ok(said.into_pyobject(py)?.into_any().unbind()))
    })
}

/// The plane of power, row by row from the least frequency along y, its width and height, the steps between frequencies, and the means over rings.
#[pyfunction]
pub fn power_spectrum(py: Python, sets: Vec<Rows>, space: SpaceArg, max_frequency: f64, threads: Option<usize>) -> PyResult<Py<PyAny>> {
    let sets = all(&sets, space)?;
    run(py, Terms { threads, callback: None }, move |_| {
        let spectrum = evenly::power_spectrum(&sets, max_frequency)?;
        let [half_width, half_height] = spectrum.half_size().map(|n| n as i64);
        let plane = (-half_height..=half_height).flat_map(|b| (-half_width..=half_width).map(move |a| (a, b)));
        let power: Vec<f64> = plane.map(|(a, b)| spectrum.power(a, b).unwrap_or(f64::NAN)).collect();
        answer(move |py| {
            let whole = (
                numbers(py, power),
                (2 * half_width + 1, 2 * half_height + 1),
                spectrum.step(),
                numbers(py, spectrum.ring_frequencies),
                numbers(py, spectrum.ring_power),
                numbers(py, spectrum.anisotropy_db),
            );
            Ok(whole.into_pyobject(py)?.into_any().unbind())
        })
    })
}

/// The radial means, and what is derived from them.
#[pyfunction]
pub fn radial_spectrum(py: Python, sets: Vec<Rows>, space: SpaceArg, threads: Option<usize>) -> PyResult<Py<PyAny>> {
    let sets = all(&sets, space)?;
    run(py, Terms { threads, callback: None }, move |_| {
        let radial = evenly::radial_spectrum(&sets)?;
        answer(move |py| Ok(radial_arrays(py, radial).into_pyobject(py)?.into_any().unbind()))
    })
}

/// Frequencies and power, distances and correlation, the effective Nyquist frequency and the oscillation.
pub fn radial_arrays(py: Python, radial: RadialSpectrum) -> (Py<PyAny>, Py<PyAny>, Py<PyAny>, Py<PyAny>, f64, f64) {
    let RadialSpectrum { effective_nyquist, oscillation, .. } = radial;
    let [frequencies, power] = [radial.frequencies, radial.radial_power].map(|values| numbers(py, values));
    let [distances, correlation] = [radial.distances, radial.pair_correlation].map(|values| numbers(py, values));
    (frequencies, power, distances, correlation, effective_nyquist, oscillation)
}

fn all(sets: &[Rows], space: SpaceArg) -> PyResult<Vec<PointSet>> {
    let is_unit = space.is_unit();
    let space = space.space()?;
    let read = |set: &Rows| {
        let points = PointSet::new(&space, rows(set)?);
        if is_unit { points.and_then(|points| points.in_unit_square()) } else { points }.map_err(value_error)
    };
    sets.iter().map(read).collect()
}

/// The corners of the Delaunay triangles, as (3 k, 2) places: on a torus those near the seam reach out of the domain.
#[pyfunction]
pub fn triangles(py: Python, points: Rows, space: SpaceArg, threads: Option<usize>) -> PyResult<Py<PyAny>> {
    let points = point_set(py, &points, space, None, 0)?;
    run(py, Terms { threads, callback: None }, move |_| {
        let corners: Vec<[f64; 2]> = evenly::tessellate(&points)?.corners.into_iter().flatten().collect();
        answer(move |py| array(py, corners))
    })
}

/// A figure of points as SVG, by the command line's names of what is drawn.
#[pyfunction]
pub fn figure(py: Python, points: Rows, space: SpaceArg, density: Option<DensityArg>, draw: Vec<String>) -> PyResult<Py<PyAny>> {
    let points = measured_set(py, &points, space, density)?;
    run(py, Terms { threads: None, callback: None }, move |_| {
        let unknown = |name: &str| Error::Resource(format!("nothing to draw has the name {name:?}"));
        let draw = draw.iter().map(|name| Draw::named(name).ok_or_else(|| unknown(name))).collect::<Result<Vec<_>, _>>()?;
        let svg = evenly_io::figure(&Subject::from(&points), &draw, "")?;
        answer(move |py| Ok(svg.into_pyobject(py)?.into_any().unbind()))
    })
}

/// A figure as PNG.
#[pyfunction]
pub fn rendered(py: Python, svg: String) -> PyResult<Py<PyAny>> {
    run(py, Terms { threads: None, callback: None }, move |_| {
        let png = evenly_io::rendered(&svg)?;
        answer(move |py| Ok(pyo3::types::PyBytes::new(py, &png).into_any().unbind()))
    })
}
