//! Statistics of many bodies.

use crate::errors::{of_json, python};
use crate::study::Study;
use crate::watch::Caller;
use motiform_lab::statistics::{Error, Measurement, read, simulated, summary, tables};
use motiform_statistics::Settings;
use motiform_store::columns::to_csv;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::path::PathBuf;

/// The summary as JSON, the tables by name as CSV (every digit), and what a signal or the callable raised: then not all bodies are
/// finished.
type Measured<'py> = (String, Vec<(&'static str, Bound<'py, PyBytes>)>, Option<PyErr>);

/// Radii of discs; quantity and threshold of residence times.
type Asked = (Vec<f64>, Option<(String, Option<f64>)>);

/// Statistics of `bodies` bodies of a study, on so many threads.
#[pyfunction]
#[pyo3(signature = (study, counts, asked, progress=None))]
pub(crate) fn statistics<'py>(
    py: Python<'py>,
    study: &Study,
    counts: (usize, usize),
    asked: Asked,
    progress: Option<Py<PyAny>>,
) -> PyResult<Measured<'py>> {
    let ((bodies, threads), settings) = (counts, settings(asked));
    let (found, raised) =
        Caller::beside(py, progress, |watch| simulated(&study.0, bodies, &settings, threads.max(1), watch));
    match (found, raised) {
        (Ok(found), raised) => shown(py, &found, raised),
        (Err(_), Some(raised)) => Err(raised),
        (Err(error), None) => Err(refused(error)),
    }
}

/// Time between samples of so many bodies that run for `t_end`, where it is not given.
#[pyfunction]
pub(crate) fn samples_apart(study: &Study, t_end: f64, bodies: u64) -> f64 {
    motiform_lab::statistics::samples_apart(&study.0.run, t_end, bodies)
}

/// Statistics of the bodies in dataset folders.
#[pyfunction]
pub(crate) fn statistics_of(
    py: Python<'_>,
    folders: Vec<PathBuf>,
    transient: f64,
    asked: Asked,
) -> PyResult<Measured<'_>> {
    let found = read(&folders, transient, &settings(asked)).map_err(refused)?;
    shown(py, &found, None)
}

fn settings((radii, threshold): Asked) -> Settings {
    Settings { radii, threshold }
}

fn refused(error: Error) -> PyErr {
    match error {
        Error::Study(error) => python(error),
        other => PyValueError::new_err(other.to_string()),
    }
}

fn shown<'py>(py: Python<'py>, found: &Measurement, raised: Option<PyErr>) -> PyResult<Measured<'py>> {
    let text = serde_json::to_string(&summary(found)).map_err(of_json)?;
    let tables = tables(&found.statistics);
    let tables = tables.iter().map(|table| (table.name, PyBytes::new(py, &to_csv(&table.columns)))).collect();
    Ok((text, tables, raised))
}
