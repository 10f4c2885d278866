//! Scans in folders.

use crate::atlas::opening_of;
use crate::errors::python;
use crate::scan_plan::{Arrays, ScanPlan, arrays};
use crate::watch::Caller;
use motiform_lab::scan::{
    Classify, Scan, ScanFolder, ScanTable, Shard, for_each_part, merge as merge_folders,
};
use numpy::PyReadonlyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::path::PathBuf;

/// A scan folder that is being computed; locked while this lives.
#[pyclass(frozen, module = "motiform._motiform")]
pub(crate) struct ScanFiles(Scan);

#[pymethods]
impl ScanFiles {
    /// Opens the folder: `opening` is "new", "resume" or "replace", `shard` like "2/8".
    #[new]
    fn new(path: PathBuf, plan: &ScanPlan, shard: Option<&str>, opening: &str) -> PyResult<Self> {
        let shard = shard.map_or(Ok(Shard::WHOLE), Shard::parse).map_err(python)?;
        Scan::open(&path, &plan.0, shard, opening_of(opening)).map(Self).map_err(python)
    }

    /// Damaged parts that were found, each with a description; they are recomputed.
    fn damaged(&self) -> Vec<String> {
        self.0.damaged().to_vec()
    }

    /// The parts still to compute.
    fn left(&self) -> Vec<usize> {
        self.0.parts_left().collect()
    }

    /// Computes the remaining parts on `threads` threads; returns what stopped it, if anything.
    #[pyo3(signature = (threads, progress=None))]
    fn run(&self, py: Python<'_>, threads: usize, progress: Option<Py<PyAny>>) -> PyResult<Option<PyErr>> {
        let (ended, raised) =
            Caller::beside(py, progress, |watch| self.0.run(&Classify, threads.max(1), watch));
        ended.map_err(python)?;
        Ok(raised)
    }

    /// Stores the rows of a part that an executor computed: codes of regimes, attractors and courses, numbers, evidence.
    fn keep(
        &self,
        part: usize,
        motions: (Vec<i8>, Vec<i8>, Vec<i8>),
        numbers: Vec<PyReadonlyArray1<'_, f64>>,
        whys: Vec<String>,
    ) -> PyResult<()> {
        let codes = |codes: Vec<i8>| codes.into_iter().map(i8::cast_unsigned).collect();
        let columns: Vec<Vec<f64>> = numbers.iter().map(|column| column.as_array().to_vec()).collect();
        let numbers = columns.try_into().map_err(|_| PyValueError::new_err("columns are missing"))?;
        let (regimes, attractors, courses) = motions;
        let (regimes, attractors, courses) = (codes(regimes), codes(attractors), codes(courses));
        let table = ScanTable { regimes, attractors, courses, numbers, whys: Some(whys) };
        let plan = self.0.folder().plan();
        let samples = plan.computation.samples;
        let cells = plan.cells_of(part);
        let places = cells.flat_map(|cell| (0..samples).map(move |sample| (cell, sample)));
        let rows: Option<Vec<_>> =
            places.enumerate().map(|(place, (cell, sample))| table.row(place, cell, sample)).collect();
        let rows = rows.ok_or_else(|| PyValueError::new_err("rows are missing"))?;
        self.0.keep(part, &rows).map_err(python)
    }
}

/// Merges the folders of shards; returns the number of missing parts and the damaged ones.
#[pyfunction]
pub(crate) fn merge(
    py: Python<'_>,
    folders: Vec<PathBuf>,
    out: PathBuf,
    force: bool,
) -> PyResult<(usize, Vec<String>)> {
    let merged = py.detach(|| merge_folders(&folders, &out, force)).map_err(python)?;
    Ok((merged.missing, merged.damaged))
}

/// The plan and the rows of a scan folder, and descriptions of damaged parts.
pub(crate) fn load(py: Python<'_>, path: PathBuf, whys: bool) -> PyResult<(ScanPlan, Arrays, Vec<String>)> {
    let loaded = py.detach(|| {
        let folder = ScanFolder::read(&path)?;
        let mut table = ScanTable::empty(folder.plan().rows(), whys);
        let damaged = for_each_part(&folder, |rows| {
            for row in rows {
                table.put(ScanTable::place(folder.plan(), row), row.clone());
            }
        })?;
        Ok((folder.plan().clone(), table, damaged))
    });
    let (plan, table, damaged) = loaded.map_err(python)?;
    Ok((ScanPlan(plan), arrays(py, table), damaged))
}
