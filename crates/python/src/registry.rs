//! The registry of names. The Python side and its stubs are generated from it.

use crate::errors::{of_json, python};
use pyo3::prelude::*;

/// The registry as JSON.
#[pyfunction]
pub(crate) fn registry() -> PyResult<String> {
    serde_json::to_string(&motiform_lab::registry::registry().map_err(python)?).map_err(of_json)
}
