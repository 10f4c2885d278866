//! Branches of a motion along a parameter.

use crate::errors::{of_json, python};
use crate::study::Study;
use crate::watch::Caller;
use motiform_diagrams::starts::StartPoint;
use motiform_diagrams::{BranchFolder, columns, follow, summary};
use motiform_store::columns::to_csv;
use motiform_study::branches::{Along, BranchSettings, origin};
use motiform_study::{BranchPlan, Stride, Towards};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use serde_json::{Value, json};
use std::path::PathBuf;

/// The summary as JSON, the points as CSV (every digit), and what a signal or the callable raised: then not all is followed.
type Followed<'py> = (String, Bound<'py, PyBytes>, Option<PyErr>);

/// Direction, longest step, first step, tolerance; steady motions alone, and orbits that begin on stable motions alone.
type Steps<'s> = (&'s str, Option<f64>, Option<f64>, Option<f64>, (bool, bool));

/// The branches of the motion that a study's start settles on, or of that at a point of an earlier result.
#[pyfunction]
#[pyo3(signature = (study, along, starts, counts, steps, progress=None))]
pub(crate) fn follow_branches<'py>(
    py: Python<'py>,
    study: &Study,
    along: (String, f64, f64),
    starts: (Option<&str>, Option<&str>),
    counts: (usize, usize),
    steps: Steps<'_>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Followed<'py>> {
    let ((name, from, to), (branches, points), (motion, point)) = (along, counts, starts);
    let origin = motion.map(origin).transpose().map_err(python)?;
    let (mut study, mut given) = (study.0.clone(), None);
    if let Some(point) = point {
        let point = StartPoint::read(point).map_err(python)?;
        point.put(&mut study).map_err(python)?;
        given = Some(point.given);
    }
    let (direction, branch_step, first_step, tolerance, (steady, from_stable)) = steps;
    let direction = Towards::find(direction).map_err(python)?;
    let stride = Stride { first_step, branch_step, tolerance, direction, steady, from_stable };
    let along = Along { name, from, to };
    let settings = BranchSettings { origin, points, branches, stride, given, ..BranchSettings::over(along) };
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
    let table = columns(&folder.plan, &folder.found).map_err(python)?;
    let text = serde_json::to_string(&entry).map_err(of_json)?;
    Ok((text, PyBytes::new(py, &to_csv(&table)), raised))
}
