//! Branches of a motion along a parameter.

use crate::errors::{of_json, python};
use crate::study::Study;
use crate::watch::Caller;
use motiform_branching::{BranchFolder, columns, follow, summary};
use motiform_files::columns::to_csv;
use motiform_study::BranchPlan;
use motiform_study::branches::{Along, BranchSettings, origin};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use serde_json::{Value, json};
use std::path::PathBuf;

/// The summary as JSON, the points as CSV (every digit), and what a signal or the callable raised: then not all is followed.
type Followed<'py> = (String, Bound<'py, PyBytes>, Option<PyErr>);

/// The branches of the motion that a study's start settles on.
#[pyfunction]
#[pyo3(signature = (study, along, from_, counts, progress=None))]
pub(crate) fn follow_branches<'py>(
    py: Python<'py>,
    study: &Study,
    along: (String, f64, f64),
    from_: Option<&str>,
    counts: (usize, usize),
    progress: Option<Py<PyAny>>,
) -> PyResult<Followed<'py>> {
    let ((name, from, to), (branches, points)) = (along, counts);
    let origin = from_.map(origin).transpose().map_err(python)?;
    let settings = BranchSettings { along: Along { name, from, to }, origin, points, branches, samples: 0 };
    let study = study.0.perturbed().map_err(python)?.0;
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
    let table = columns(&folder.plan, &folder.found).map_err(python)?;
    let text = serde_json::to_string(&entry).map_err(of_json)?;
    Ok((text, PyBytes::new(py, &to_csv(&table)), raised))
}
