//! Files that the command line writes.

use crate::errors::python;
use crate::run::{Columns, Run, TableArrays};
use crate::scan_files::load;
use crate::scan_plan::{Arrays, ScanPlan};
use motiform_lab::dataset::{read_dataset, read_table_file};
use motiform_store::read_fields as fields;
use motiform_study::Dataset;
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods};
use pyo3::prelude::*;
use std::path::PathBuf;

/// A dataset folder.
#[pyfunction]
pub(crate) fn read_run(py: Python<'_>, path: PathBuf) -> PyResult<Run> {
    Run::new(py, py.detach(|| read_dataset(&path)).map_err(python)?)
}

/// One table: a run, if the file contains its manifest and is the trajectory, otherwise its columns.
#[pyfunction]
pub(crate) fn read_table(py: Python<'_>, path: PathBuf) -> PyResult<(Option<Run>, Option<TableArrays>)> {
    match py.detach(|| read_table_file(&path)).map_err(python)? {
        (trajectory, Some(manifest)) if trajectory.get("speed").is_some() => {
            let run = Run::new(py, Dataset { manifest, trajectory, crossings: None })?;
            Ok((Some(run), None))
        }
        (table, _) => Ok((None, Some(Columns::new(py, table)?.parts(py)))),
    }
}

/// The plan and the rows of a scan folder, and descriptions of damaged parts.
#[pyfunction]
pub(crate) fn read_scan(
    py: Python<'_>,
    path: PathBuf,
    whys: bool,
) -> PyResult<(ScanPlan, Arrays, Vec<String>)> {
    load(py, path, whys)
}

/// `t`, `s`, `phi` (t, s), `outline` (t, point, xy) and the attributes.
type FieldArrays<'py> = (
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray3<f64>>,
    Vec<(String, String)>,
);

/// The fields of `fields.h5`.
#[pyfunction]
pub(crate) fn read_fields(py: Python<'_>, path: PathBuf) -> PyResult<FieldArrays<'_>> {
    let read = py.detach(|| fields(&path)).map_err(|error| python(error.into()))?;
    let (times, arcs) = (read.times.len(), read.arcs.len());
    let phi = PyArray1::from_vec(py, read.phi).reshape([times, arcs])?;
    let outlines = PyArray1::from_vec(py, read.outlines).reshape([times, read.points, 2])?;
    let (times, arcs) = (PyArray1::from_vec(py, read.times), PyArray1::from_vec(py, read.arcs));
    Ok((times, arcs, phi, outlines, read.attributes))
}
