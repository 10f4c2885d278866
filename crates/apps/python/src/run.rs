//! A run: its table as one NumPy array, and its outlines.

use crate::errors::{of_json, python};
use crate::study::{Study, plan};
use crate::watch::Caller;
use motiform_dynamics::{Model, Outline};
use motiform_lab::readings::dimension;
use motiform_lab::{draw, naming};
use motiform_store::table::Table;
use motiform_study::{Dataset, Dimension, Manifest};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use std::hint::black_box;
use std::sync::OnceLock;
use std::time::Instant;

/// A recorded motion.
#[pyclass(frozen, module = "motiform._motiform")]
pub(crate) struct Run {
    manifest: Manifest,
    /// Made for the first outline: that of a cell takes longer than a short run.
    model: OnceLock<Box<dyn Model>>,
    table: Columns,
    crossings: Option<Columns>,
}

/// Names and meanings of columns, and the array (column, row).
pub(crate) type TableArrays = (Vec<String>, Vec<String>, Py<PyArray2<f64>>);

/// A table as one block: row `k` of the array is column `names[k]`, so that each column is a view of contiguous memory.
pub(crate) struct Columns {
    pub(crate) names: Vec<String>,
    meanings: Vec<String>,
    pub(crate) block: Py<PyArray2<f64>>,
}

impl Columns {
    pub(crate) fn new(py: Python<'_>, table: Table) -> PyResult<Self> {
        let (count, rows) = (table.columns.len(), table.rows());
        let (mut names, mut meanings) = (Vec::with_capacity(count), Vec::with_capacity(count));
        let mut block = Vec::with_capacity(count * rows);
        for column in table.columns {
            block.extend_from_slice(&column.values); // and frees the column
            names.push(column.name);
            meanings.push(column.meaning.into_owned());
        }
        let block = PyArray1::from_vec(py, block).reshape([count, rows])?;
        Ok(Self { names, meanings, block: block.unbind() })
    }

    pub(crate) fn parts(&self, py: Python<'_>) -> TableArrays {
        (self.names.clone(), self.meanings.clone(), self.block.clone_ref(py))
    }
}

impl Run {
    pub(crate) fn new(py: Python<'_>, dataset: Dataset) -> PyResult<Self> {
        let table = Columns::new(py, dataset.trajectory)?;
        let crossings = dataset.crossings.map(|table| Columns::new(py, table)).transpose()?;
        Ok(Self { manifest: dataset.manifest, model: OnceLock::new(), table, crossings })
    }

    fn model(&self) -> PyResult<&dyn Model> {
        if let Some(model) = self.model.get() {
            return Ok(model.as_ref());
        }
        let plan = &self.manifest.plan;
        let model = plan.body().map_err(python)?;
        Ok(self.model.get_or_init(|| model).as_ref())
    }

    /// The shape in a row, as the model computes with it.
    fn shape(&self, py: Python<'_>, row: usize) -> PyResult<Vec<f64>> {
        let block = self.table.block.bind(py).readonly();
        let block = block.as_array();
        if row >= block.ncols() {
            return Err(PyIndexError::new_err(format!("row {row}: the run has {} rows", block.ncols())));
        }
        let model = self.model()?;
        let place = |name: &str| self.table.names.iter().position(|known| known == name);
        let coordinates = model.coordinates().iter();
        let named: Vec<f64> = coordinates.filter_map(|c| Some(block[[place(c.name)?, row]])).collect();
        let shape = model.encoded(&named);
        Ok(shape)
    }
}

#[pymethods]
impl Run {
    /// A run from the results of `manifest`, `table` and `crossings`: for pickling.
    #[staticmethod]
    #[pyo3(signature = (manifest, table, crossings=None))]
    fn of(manifest: &str, table: TableArrays, crossings: Option<TableArrays>) -> PyResult<Self> {
        let columns = |(names, meanings, block): TableArrays| Columns { names, meanings, block };
        Ok(Self {
            manifest: serde_json::from_str(manifest).map_err(of_json)?,
            model: OnceLock::new(),
            table: columns(table),
            crossings: crossings.map(columns),
        })
    }

    /// The array (column, row).
    fn block(&self, py: Python<'_>) -> Py<PyArray2<f64>> {
        self.table.block.clone_ref(py)
    }

    /// Names and meanings of the columns, and the array (column, row).
    fn table(&self, py: Python<'_>) -> TableArrays {
        self.table.parts(py)
    }

    /// The powers of length and time of each column, and whether it is an angle.
    fn dimensions(&self) -> PyResult<Vec<(i8, i8, bool)>> {
        let model = self.model()?;
        let powers = |name: &String| match dimension(model, name) {
            Dimension::Powers { length, time, angle } => (length, time, angle),
            Dimension::Mixed => (0, 0, false),
        };
        Ok(self.table.names.iter().map(powers).collect())
    }

    /// The same for the crossings of the return map, if there is one.
    fn crossings(&self, py: Python<'_>) -> Option<TableArrays> {
        self.crossings.as_ref().map(|table| table.parts(py))
    }

    /// The manifest as JSON.
    fn manifest(&self) -> PyResult<String> {
        serde_json::to_string(&self.manifest).map_err(of_json)
    }

    /// `true` if the run reached its end.
    #[getter]
    fn complete(&self) -> bool {
        self.manifest.outcome.is_complete()
    }

    /// The end of the run, as text.
    #[getter]
    fn ended(&self) -> String {
        self.manifest.outcome.to_string()
    }

    /// The regime of the motion if a short integration from the end of the run is conclusive; otherwise `None`.
    fn regime(&self, py: Python<'_>) -> PyResult<Option<String>> {
        let (verdict, raised) = Caller::here(py, None, |watch| naming::name(&self.manifest, watch));
        match raised {
            Some(error) => Err(error),
            None => Ok(verdict.map_err(python)?.map(|verdict| verdict.regime.name().to_owned())),
        }
    }

    /// The undeformed radius: the model's, or a round one that shows the deformation over these rows.
    fn radius(&self, py: Python<'_>) -> PyResult<f64> {
        let model = self.model()?;
        if let Some(fixed) = model.radius() {
            return Ok(fixed);
        }
        let rows = self.table.block.bind(py).shape()[1];
        let mut largest = 0.0_f64;
        for row in (0..rows).step_by(rows.div_ceil(4096).max(1)) {
            largest = largest.max(model.deformation(&self.shape(py, row)?));
        }
        Ok(draw::radius_for(largest))
    }

    /// The boundary in a row about the centre of mass, (points, 2); `None` if the shape is not a closed curve.
    fn outline<'py>(
        &self,
        py: Python<'py>,
        row: usize,
        radius: f64,
        points: usize,
    ) -> PyResult<Option<Bound<'py, PyArray2<f64>>>> {
        match self.model()?.outline(&self.shape(py, row)?, radius, points) {
            Outline::Curve(curve) => {
                let count = curve.len();
                let flat = curve.into_iter().flatten().collect();
                PyArray1::from_vec(py, flat).reshape([count, 2]).map(Some)
            }
            Outline::NotACurve { .. } | Outline::NotClosed { .. } => Ok(None),
        }
    }
}

/// Runs a study. The second value is the exception of a signal or the callable, which stopped the run.
#[pyfunction]
#[pyo3(signature = (study, progress=None))]
pub(crate) fn simulate(
    py: Python<'_>,
    study: &Study,
    progress: Option<Py<PyAny>>,
) -> PyResult<(Run, Option<PyErr>)> {
    let (dataset, raised) =
        Caller::here(py, progress, |watch| motiform_lab::simulate::simulate(&plan(study)?, watch));
    Ok((Run::new(py, dataset.map_err(python)?)?, raised))
}

/// Seconds of one run without Python, the mean of `count`: a reference for calls from Python.
#[pyfunction]
pub(crate) fn seconds_of_run(study: &Study, count: u32) -> PyResult<f64> {
    let began = Instant::now();
    for _ in 0..count {
        let run = plan(study).and_then(|plan| motiform_lab::simulate::simulate(&plan, &()));
        black_box(run.map_err(python)?);
    }
    Ok(began.elapsed().as_secs_f64() / f64::from(count))
}
