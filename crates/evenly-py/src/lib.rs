//! The native half of the Python package: arrays in, arrays out, and everything that is only said is JSON. What people see is in `python/evenly/`.

mod answer;
mod arrays;
mod data;
mod job;
mod jobs;
mod meshes;
mod points;
mod spaces;
mod surfaces;

use std::ffi::OsString;

use pyo3::prelude::*;

#[pymodule(gil_used = false)]
fn _evenly(module: &Bound<PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add("Stopped", module.py().get_type::<job::Stopped>())?;
    module.add_class::<job::Pending>()?;
    module.add_function(wrap_pyfunction!(jobs::perform, module)?)?;
    module.add_function(wrap_pyfunction!(points::measure, module)?)?;
    module.add_function(wrap_pyfunction!(points::power_spectrum, module)?)?;
    module.add_function(wrap_pyfunction!(points::radial_spectrum, module)?)?;
    module.add_function(wrap_pyfunction!(points::triangles, module)?)?;
    module.add_function(wrap_pyfunction!(points::figure, module)?)?;
    module.add_function(wrap_pyfunction!(points::rendered, module)?)?;
    module.add_function(wrap_pyfunction!(spaces::polygon, module)?)?;
    module.add_function(wrap_pyfunction!(spaces::read_polygon, module)?)?;
    module.add_function(wrap_pyfunction!(spaces::read_regions, module)?)?;
    module.add_function(wrap_pyfunction!(meshes::write_mesh, module)?)?;
    module.add_function(wrap_pyfunction!(meshes::mesh_figure, module)?)?;
    module.add_function(wrap_pyfunction!(surfaces::surface_spectrum, module)?)?;
    module.add_function(wrap_pyfunction!(surfaces::write_surface, module)?)?;
    module.add_function(wrap_pyfunction!(surfaces::surface_figure, module)?)?;
    module.add_function(wrap_pyfunction!(methods, module)?)?;
    module.add_function(wrap_pyfunction!(command, module)?)?;
    Ok(())
}

/// All methods and what they can be told, as JSON.
#[pyfunction]
fn methods() -> String {
    evenly_jobs::registry().to_string()
}

/// The command line; returns its exit code.
#[pyfunction]
fn command(py: Python, words: Vec<String>) -> u8 {
    py.detach(|| evenly_cli::run(words.into_iter().map(OsString::from)))
}
