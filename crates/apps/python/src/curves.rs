//! Curves of special points over two parameters.

use crate::errors::{of_json, python};
use crate::study::{Study, table};
use crate::watch::Caller;
use motiform_diagrams::curves::{CurveFolder, curve_columns, curve_summary, follow_curves};
use motiform_store::columns::to_csv;
use motiform_study::study::FollowSettings;
use motiform_study::{BranchPlan, CurvePlan};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use std::path::PathBuf;

/// The summary as JSON, the points as CSV (every digit), and what a signal or the callable raised: then not all is followed.
type Followed<'py> = (String, Bound<'py, PyBytes>, Option<PyErr>);

/// The curves of some kinds through the special points of the branches along one side of the plane.
#[pyfunction]
#[pyo3(name = "follow_curves", signature = (study, settings, progress=None))]
pub(crate) fn follow<'py>(
    py: Python<'py>,
    study: &Study,
    settings: &Bound<'_, PyDict>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Followed<'py>> {
    let asked: FollowSettings = table(settings)?;
    let study = study.0.perturbed().map_err(python)?.0;
    let plan = BranchPlan::new(&study, &asked.branches().map_err(python)?).map_err(python)?;
    let settings = asked.curves().map_err(python)?;
    let settings = settings.ok_or_else(|| PyTypeError::new_err("curves need their kinds and a plane"))?;
    let plan = CurvePlan::new(&study, plan, &settings).map_err(python)?;
    let (found, raised) = Caller::here(py, progress, |watch| follow_curves(&plan, None, watch));
    let found = found.map_err(python)?;
    shown(py, &CurveFolder { plan, found }, raised)
}

/// The curves in a folder.
#[pyfunction]
pub(crate) fn read_curves(py: Python<'_>, path: PathBuf) -> PyResult<Followed<'_>> {
    let folder = CurveFolder::read(&path).map_err(python)?;
    shown(py, &folder, None)
}

fn shown<'py>(py: Python<'py>, folder: &CurveFolder, raised: Option<PyErr>) -> PyResult<Followed<'py>> {
    let points = curve_columns(&folder.plan, &folder.found).map_err(python)?;
    let text = serde_json::to_string(&curve_summary(&folder.plan, &folder.found)).map_err(of_json)?;
    Ok((text, PyBytes::new(py, &to_csv(&points)), raised))
}
