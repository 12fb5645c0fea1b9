//! Pictures as dots.

use std::path::PathBuf;

use evenly_cli::stippled::stipple as stippled;
use evenly_io::Photograph;
use numpy::{PyReadonlyArray3, PyUntypedArrayMethods as _};
use pyo3::prelude::*;

use crate::answer::{answer, value_error};
use crate::arrays::{array, numbers};
use crate::job::{Terms, run};

/// A picture: pixels, row by row from the top, red, green, blue and opacity from 0 to 1; or a file.
#[derive(FromPyObject)]
pub enum Picture<'py> {
    Pixels(PyReadonlyArray3<'py, f32>),
    File(PathBuf),
}

/// The picture's width and height, and for each layer its name, colour, dots, areas and the widest dot.
#[pyfunction]
pub fn stipple(
    py: Python,
    picture: Picture,
    n: usize,
    words: Vec<String>,
    threads: Option<usize>,
    callback: Option<Py<PyAny>>,
) -> PyResult<Py<PyAny>> {
    let photograph = match picture {
        Picture::File(path) => py.detach(|| Photograph::read(&path)).map_err(value_error)?,
        Picture::Pixels(pixels) => {
            let shape = [1, 0].map(|axis| pixels.shape()[axis]);
            let colours = pixels.as_slice().map_err(value_error)?.as_chunks::<4>().0;
            Photograph::of_colours("the picture", shape, colours).ok_or_else(|| value_error("a picture has height x width x 4 values"))?
        }
    };
    run(py, Terms { threads, callback }, move |context, _| {
        let size = photograph.size();
        let layers = stippled(&photograph, n, &words, context)?;
        answer(move |py| {
            let layers = layers.into_iter().map(|layer| {
                let dots = array(py, layer.points.into_positions())?;
                Ok((layer.name, layer.colour, dots, numbers(py, layer.areas), layer.widest))
            });
            let whole = (size, layers.collect::<PyResult<Vec<_>>>()?);
            Ok(whole.into_pyobject(py)?.into_any().unbind())
        })
    })
}
