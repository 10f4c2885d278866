//! Branches of a motion along a parameter.

use crate::errors::{of_json, python};
use crate::study::{Study, table};
use crate::watch::Caller;
use motiform_diagrams::starts::StartPoint;
use motiform_diagrams::{BranchFolder, columns, follow, summary};
use motiform_store::columns::to_csv;
use motiform_study::BranchPlan;
use motiform_study::branches::BranchSettings;
use motiform_study::study::FollowSettings;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use serde_json::{Value, json};
use std::path::PathBuf;

/// The summary as JSON, the points as CSV (every digit), and what a signal or the callable raised: then not all is followed.
type Followed<'py> = (String, Bound<'py, PyBytes>, Option<PyErr>);

/// The branches of the motion that a study's start settles on, or of that at a point of an earlier result.
#[pyfunction]
#[pyo3(signature = (study, settings, start=None, progress=None))]
pub(crate) fn follow_branches<'py>(
    py: Python<'py>,
    study: &Study,
    settings: &Bound<'_, PyDict>,
    start: Option<&str>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Followed<'py>> {
    let asked: FollowSettings = table(settings)?;
    let (mut study, mut given) = (study.0.clone(), None);
    if let Some(point) = start {
        let point = StartPoint::read(point).map_err(python)?;
        point.put(&mut study).map_err(python)?;
        given = Some(point.given);
    }
    let settings = BranchSettings { given, ..asked.branches().map_err(python)? };
    let study = study.perturbed().map_err(python)?.0;
    let plan = BranchPlan::new(&study, &settings).map_err(python)?;
    let (found, raised) = Caller::here(py, progress, |watch| follow(&plan, None, watch));
    let found = found.map_err(python)?;
    shown(py, &BranchFolder { plan, found }, raised)
}

/// The branches in a folder.
#[pyfunction]
pub(crate) fn read_branches(py: Python<'_>, path: PathBuf) -> PyResult<Followed<'_>> {
    let folder = BranchFolder::read(&path).map_err(python)?;
    shown(py, &folder, None)
}

fn shown<'py>(py: Python<'py>, folder: &BranchFolder, raised: Option<PyErr>) -> PyResult<Followed<'py>> {
    let mut entry: Value = summary(&folder.plan, &folder.found);
    let info = folder.plan.info().map_err(python)?;
    let name = &folder.plan.computation.along.name;
    let spec = info.parameters().iter().find(|spec| spec.name == *name);
    entry["symbol"] = json!(spec.map_or(name.as_str(), |spec| spec.symbol));
    let points = columns(&folder.plan, &folder.found).map_err(python)?;
    let text = serde_json::to_string(&entry).map_err(of_json)?;
    Ok((text, PyBytes::new(py, &to_csv(&points)), raised))
}
