//! What a job answers: made without Python, and handed over once it is back; and what is wrong.

use evenly_jobs::Wording;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Hands a result over to Python.
pub type Answer = Box<dyn FnOnce(Python) -> PyResult<Py<PyAny>> + Send>;

/// What hands this over.
pub fn answer(hand_over: impl FnOnce(Python) -> PyResult<Py<PyAny>> + Send + 'static) -> Result<Answer, evenly_jobs::Error> {
    Ok(Box::new(hand_over))
}

/// Parameters as keywords: `min_distance`, and `n` for the count that a function is about.
pub struct Keywords;

impl Wording for Keywords {
    fn name(&self, parameter: &str) -> String {
        match parameter {
            "n_points" | "n_vertices" => "n".into(),
            "no_warp" => "warp".into(),
            other => other.into(),
        }
    }

    fn setting(&self, parameter: &str, value: &str) -> String {
        format!("{}={value}", self.name(parameter))
    }
}

/// Bad input.
pub fn value_error(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}
