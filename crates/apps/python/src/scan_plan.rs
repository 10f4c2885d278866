//! A scan's plan, and computing it: on all threads here, or cell by cell in tasks of an executor.

use crate::analyse::answer;
use crate::errors::{of_json, of_keywords, python};
use crate::study::{Study, number};
use crate::watch::Caller;
use motiform_lab::scan::{Axis, Classify, Row, ScanTable, Store, compute, rows_of};
use motiform_study::{Error, ScanPlan as Inner};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyType;
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

/// The plan of a scan.
#[pyclass(frozen, module = "motiform._motiform")]
pub(crate) struct ScanPlan(pub(crate) Inner);

/// Codes of regimes, attractors and courses; -1: not computed, and where there is no course.
pub(crate) type Motions = (Py<PyArray1<i8>>, Py<PyArray1<i8>>, Py<PyArray1<i8>>);
/// Rows as arrays: codes, numbers, and the evidence if requested.
pub(crate) type Arrays = (Motions, Vec<Py<PyArray1<f64>>>, Option<Vec<String>>);

/// A table as NumPy arrays, which take over the numbers' memory.
pub(crate) fn arrays(py: Python<'_>, table: ScanTable) -> Arrays {
    let codes = |codes: Vec<u8>| {
        let code = |code: u8| i8::try_from(code).unwrap_or(-1);
        PyArray1::from_vec(py, codes.into_iter().map(code).collect::<Vec<_>>()).unbind()
    };
    let numbers = table.numbers.into_iter().map(|column| PyArray1::from_vec(py, column).unbind()).collect();
    ((codes(table.regimes), codes(table.attractors), codes(table.courses)), numbers, table.whys)
}

/// Parts go into a table in memory.
struct Memory<'m> {
    plan: &'m Inner,
    table: Mutex<ScanTable>,
}

impl Store for Memory<'_> {
    fn put(&self, _part: usize, rows: Vec<Row>) -> Result<(), Error> {
        let mut table = self.table.lock().unwrap_or_else(PoisonError::into_inner);
        for row in rows {
            let place = ScanTable::place(self.plan, &row);
            table.put(place, row);
        }
        Ok(())
    }
}

#[pymethods]
impl ScanPlan {
    /// The plan of a study's scan. An axis is a name with the text of its values as on the command line, or an array;
    /// settings that are not given are those of the study.
    #[new]
    #[pyo3(signature = (study, axes=None, samples=None, seed=None, budget=None))]
    fn new(
        study: &Study,
        axes: Option<Vec<(String, Bound<'_, PyAny>)>>,
        samples: Option<u64>,
        seed: Option<u64>,
        budget: Option<f64>,
    ) -> PyResult<Self> {
        let mut study = study.0.clone();
        let scan = &mut study.scan;
        if let Some(axes) = axes {
            let read = |(name, values): (String, Bound<'_, PyAny>)| axis(name, &values);
            scan.axes = axes.into_iter().map(read).collect::<PyResult<_>>()?;
        }
        scan.samples = samples.unwrap_or(scan.samples);
        scan.budget = budget.unwrap_or(scan.budget);
        study.run.seed = seed.unwrap_or(study.run.seed);
        Inner::new(&study).map(Self).map_err(of_keywords)
    }

    /// The plan of this JSON.
    #[staticmethod]
    fn of_json(text: &str) -> PyResult<Self> {
        serde_json::from_str(text).map(Self).map_err(of_json)
    }

    fn to_json(&self) -> PyResult<String> {
        serde_json::to_string(&self.0).map_err(of_json)
    }

    fn __reduce__(&self, py: Python<'_>) -> PyResult<(Py<PyAny>, (String,))> {
        Ok((PyType::new::<Self>(py).getattr("of_json")?.unbind(), (self.to_json()?,)))
    }

    /// SHA-256 of everything the rows depend on.
    #[getter]
    fn hash(&self) -> String {
        self.0.hash()
    }

    #[getter]
    fn model(&self) -> &str {
        self.0.computation.model.as_str()
    }

    /// The entry of its model in the registry, as JSON.
    fn info(&self) -> PyResult<String> {
        let info = self.0.info().map_err(python)?;
        serde_json::to_string(&motiform_lab::registry::entry(info).map_err(python)?).map_err(of_json)
    }

    #[getter]
    fn title(&self) -> &str {
        &self.0.title
    }

    #[getter]
    fn cells(&self) -> usize {
        self.0.cells()
    }

    #[getter]
    fn samples(&self) -> usize {
        self.0.computation.samples
    }

    #[getter]
    fn parts(&self) -> usize {
        self.0.parts()
    }

    /// The parameters that no axis varies.
    #[getter]
    fn parameters(&self) -> Vec<(String, f64)> {
        self.0.computation.parameters.0.clone()
    }

    /// First and last cell (exclusive) of a part.
    fn cells_of(&self, part: usize) -> (usize, usize) {
        let cells = self.0.cells_of(part);
        (cells.start, cells.end)
    }

    /// The axes: name and values; the first runs fastest.
    fn axes<'py>(&self, py: Python<'py>) -> Vec<(String, Bound<'py, PyArray1<f64>>)> {
        let axes = self.0.computation.axes.iter();
        axes.map(|axis| (axis.name.clone(), PyArray1::from_slice(py, &axis.values))).collect()
    }

    /// The whole scan, on `threads` threads. If the third value is an exception, it stopped the scan: rows are missing.
    #[pyo3(signature = (threads, whys, progress=None))]
    fn compute(
        &self,
        py: Python<'_>,
        threads: usize,
        whys: bool,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<(Arrays, Option<PyErr>)> {
        let rows = self.0.rows();
        let store = Memory { plan: &self.0, table: Mutex::new(ScanTable::empty(rows, whys)) };
        let parts = (0..self.0.parts()).collect();
        let (ended, raised) = Caller::beside(py, progress, |watch| {
            compute(&self.0, parts, &Classify, threads.max(1), watch, &store)
        });
        ended.map_err(python)?;
        let table = store.table.into_inner().unwrap_or_else(PoisonError::into_inner);
        Ok((arrays(py, table), raised))
    }

    /// The rows of the first of the cells `first..last`, on this thread: as many as begin within `seconds`. Returns them,
    /// the next cell, and the seconds that they took. One task of an executor.
    fn task(
        &self,
        py: Python<'_>,
        first: usize,
        last: usize,
        seconds: f64,
        whys: bool,
    ) -> PyResult<(Arrays, usize, f64)> {
        if first >= last || last > self.0.cells() {
            let cells = self.0.cells();
            return Err(PyValueError::new_err(format!("cells {first} to {last}: the scan has {cells}")));
        }
        let began = Instant::now();
        let (rows, raised) = Caller::here(py, None, |watch| {
            rows_of(&self.0, first..last, &|| began.elapsed().as_secs_f64() < seconds, &Classify, watch)
        });
        let rows = answer((Ok(rows), raised))?;
        let next = first + rows.len() / self.0.computation.samples;
        let mut table = ScanTable::empty(rows.len(), whys);
        for (place, row) in rows.into_iter().enumerate() {
            table.put(place, row);
        }
        Ok((arrays(py, table), next, began.elapsed().as_secs_f64()))
    }
}

/// An axis from its text (`0.1:1.6:64`, as on the command line) or its values.
pub(crate) fn axis(name: String, values: &Bound<'_, PyAny>) -> PyResult<Axis> {
    if let Ok(text) = values.extract::<String>() {
        return Axis::parse(&format!("{name}={text}")).map_err(python);
    }
    if let Ok(array) = values.extract::<PyReadonlyArray1<'_, f64>>() {
        return Ok(Axis { name, values: array.as_array().to_vec() });
    }
    Ok(Axis { values: vec![number(&name, values)?], name })
}
