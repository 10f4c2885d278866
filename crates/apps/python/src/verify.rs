//! Results on disk, verified.

use crate::errors::python;
use crate::watch::Caller;
use motiform_study::Error;
use pyo3::prelude::*;
use std::path::PathBuf;

/// The findings of a folder as JSON.
#[pyfunction]
#[pyo3(signature = (path, all, progress=None))]
pub(crate) fn verify(
    py: Python<'_>,
    path: PathBuf,
    all: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<String> {
    let (found, raised) =
        Caller::beside(py, progress, |watch| motiform_diagrams::Verification::of(&path, all, watch));
    match (found.map_err(python)?, raised) {
        (_, Some(error)) => Err(error),
        (Some(found), None) => Ok(found.json().to_string()),
        (None, None) => Err(python(Error::Interrupted)),
    }
}
