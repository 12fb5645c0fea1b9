//! Arrays, each copied once on the way in and not at all on the way out.

use numpy::{PyArray1, PyArray2, PyArrayMethods as _, PyReadonlyArray2, PyUntypedArrayMethods as _};
use pyo3::prelude::*;

use crate::answer::value_error;

/// Rows of coordinates, as the package hands them over.
pub type Rows<'py> = PyReadonlyArray2<'py, f64>;

/// Rows of indices, as the package hands them over.
pub type Integers<'py> = PyReadonlyArray2<'py, i64>;

/// The rows of an array, which has so many columns.
pub fn rows<const N: usize>(array: &Rows) -> PyResult<Vec<[f64; N]>> {
    let wrong = || pyo3::exceptions::PyValueError::new_err(format!("an array of {N} columns is needed, not {:?}", array.shape()));
    let numbers = array.as_slice().map_err(|_| wrong())?;
    let (rows, rest) = numbers.as_chunks::<N>();
    if array.shape()[1] == N && rest.is_empty() { Ok(rows.to_vec()) } else { Err(wrong()) }
}

/// The rows of an array of indices.
pub fn indices<const N: usize>(array: &Integers) -> PyResult<Vec<[usize; N]>> {
    let numbers = array.as_slice().map_err(value_error)?;
    let index = |&number: &i64| usize::try_from(number).map_err(value_error);
    let numbers = numbers.iter().map(index).collect::<PyResult<Vec<usize>>>()?;
    Ok(numbers.as_chunks::<N>().0.to_vec())
}

/// An array of these rows.
pub fn array<T: numpy::Element, const N: usize>(py: Python, rows: Vec<[T; N]>) -> PyResult<Py<PyAny>> {
    let n = rows.len();
    let array: Bound<PyArray2<T>> = PyArray1::from_vec(py, rows.into_flattened()).reshape([n, N])?;
    Ok(array.into_any().unbind())
}

/// An array of these numbers.
pub fn numbers<T: numpy::Element>(py: Python, numbers: Vec<T>) -> Py<PyAny> {
    PyArray1::from_vec(py, numbers).into_any().unbind()
}
