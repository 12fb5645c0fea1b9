//! What a job answers: made without Python, and handed over once it is back; and what is wrong.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Hands a result over to Python.
pub type Answer = Box<dyn FnOnce(Python) -> PyResult<Py<PyAny>> + Send>;

/// What hands this over.
pub fn answer(hand_over: impl FnOnce(Python) -> PyResult<Py<PyAny>> + Send + 'static) -> anyhow::Result<Answer> {
    Ok(Box::new(hand_over))
}

/// What is said, as JSON.
pub fn json(value: &impl serde::Serialize) -> anyhow::Result<String> {
    Ok(serde_json::to_string(value)?)
}

/// Bad input.
pub fn value_error(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}
