//! Curves of special points over two parameters.

use crate::errors::{of_json, python};
use crate::study::Study;
use crate::watch::Caller;
use motiform_diagrams::curves::{CurveFolder, curve_columns, curve_summary, follow_curves};
use motiform_store::columns::to_csv;
use motiform_study::branches::{Along, BranchSettings, origin};
use motiform_study::curves::{CurveKind, CurveSettings, Plane};
use motiform_study::{BranchPlan, CurvePlan};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::path::PathBuf;

/// The summary as JSON, the points as CSV (every digit), and what a signal or the callable raised: then not all is followed.
type Followed<'py> = (String, Bound<'py, PyBytes>, Option<PyErr>);

/// A parameter with its range.
type Side = (String, f64, f64);

/// The curves of these kinds through the special points of the branches along the first side of the plane.
#[pyfunction]
#[pyo3(name = "follow_curves", signature = (study, kinds, plane, from_, counts, progress=None))]
pub(crate) fn follow<'py>(
    py: Python<'py>,
    study: &Study,
    kinds: Vec<String>,
    plane: (Side, Side),
    from_: Option<&str>,
    counts: (usize, usize),
    progress: Option<Py<PyAny>>,
) -> PyResult<Followed<'py>> {
    let ((name, from, to), (second, low, high)) = plane;
    let ((branches, points), along) = (counts, Along { name: name.clone(), from, to });
    let origin = from_.map(origin).transpose().map_err(python)?;
    let settings = BranchSettings { origin, points, branches, ..BranchSettings::over(along) };
    let study = study.0.perturbed().map_err(python)?.0;
    let plan = BranchPlan::new(&study, &settings).map_err(python)?;
    let kinds = CurveKind::list(&kinds.join(",")).map_err(python)?;
    let settings = CurveSettings { kinds, plane: Plane([(name, None), (second, Some((low, high)))]) };
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
    let table = curve_columns(&folder.plan, &folder.found).map_err(python)?;
    let text = serde_json::to_string(&curve_summary(&folder.plan, &folder.found)).map_err(of_json)?;
    Ok((text, PyBytes::new(py, &to_csv(&table)), raised))
}
