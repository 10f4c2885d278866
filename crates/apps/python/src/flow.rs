//! The vector field, callable from Python.

use crate::errors::python;
use crate::study::Study;
use motiform_dynamics::Model;
use numpy::{PyArray2, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::sync::{Mutex, PoisonError};

/// Rates of a study's model in its coordinates.
#[pyclass(frozen, module = "motiform._motiform")]
pub(crate) struct Flow {
    flow: Mutex<motiform_lab::flow::Flow<Box<dyn Model>>>,
}

#[pymethods]
impl Flow {
    #[new]
    fn new(study: &Study) -> PyResult<Self> {
        let values = study.0.values().map_err(python)?;
        let model = study.0.info().map_err(python)?.build(&values).map_err(|error| python(error.into()))?;
        Ok(Self { flow: Mutex::new(motiform_lab::flow::Flow::new(model)) })
    }

    /// The rates of many states, (state, entry); the entries are the coordinates, or these and `x, y`.
    fn rates<'py>(
        &self,
        py: Python<'py>,
        states: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let mut flow = self.flow.lock().unwrap_or_else(PoisonError::into_inner);
        let (dim, entries) = (flow.dim(), states.shape()[1]);
        if entries != dim && entries != dim + 2 {
            return Err(PyValueError::new_err(format!(
                "a state of this model has {dim} entries, or {} with its position, not {entries}",
                dim + 2
            )));
        }
        let values = states.as_slice()?;
        let mut rates = vec![0.0; values.len()];
        for (state, rates) in values.chunks_exact(entries).zip(rates.chunks_exact_mut(entries)) {
            flow.rates(state, rates);
        }
        numpy::PyArray1::from_vec(py, rates).reshape([states.shape()[0], entries])
    }

    /// The velocities of many shapes, (shape, entry) to (shape, 2).
    fn velocities<'py>(
        &self,
        py: Python<'py>,
        shapes: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let mut flow = self.flow.lock().unwrap_or_else(PoisonError::into_inner);
        if shapes.shape()[1] != flow.dim() {
            return Err(PyValueError::new_err(format!("a shape of this model has {} entries", flow.dim())));
        }
        let velocities =
            shapes.as_slice()?.chunks_exact(flow.dim()).flat_map(|shape| flow.velocity(shape)).collect();
        numpy::PyArray1::from_vec(py, velocities).reshape([shapes.shape()[0], 2])
    }
}
