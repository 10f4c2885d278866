//! Compiled functions as vector fields.

use crate::analyse::{answer, exponents_json};
use crate::ensemble::told;
use crate::errors::{of_json, python};
use crate::foreign::Foreign;
use crate::run::{Columns, TableArrays};
use crate::study::table;
use crate::watch::Caller;
use motiform_dynamics::{Section, StepControl};
use motiform_lab::given::{Flow, Recording, Settings, Span, exponents, record, tracks};
use motiform_store::quantity::state::{RISING, T};
use motiform_store::table::{Column, Table};
use motiform_study::Ending;
use motiform_study::study::RunSettings;
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::{Value, json};

/// Outcome as JSON, whether it is complete, and the same as text.
type End = (String, bool, String);

/// Rows (row, 1 + coordinate) with the time first, how the orbit ended, and the exception that stopped it.
type Rows = (Py<PyArray2<f64>>, End, Option<PyErr>);

/// A compiled function with the values of its parameters.
#[pyclass(frozen, module = "motiform._motiform")]
pub(crate) struct Field {
    given: Foreign,
    names: Vec<String>,
    parameters: Vec<f64>,
    /// The objects that own the compiled code.
    _owners: Py<PyAny>,
}

fn span(run: &RunSettings) -> Span {
    Span { transient: run.transient, t_end: run.t_end, dt_out: run.dt_out }
}

fn accuracy(settings: &Settings) -> Value {
    let mut entry = match settings.control {
        StepControl::Adaptive { rtol, atol } => json!({ "rtol": rtol, "atol": atol }),
        StepControl::Fixed { step } => json!({ "step": step }),
    };
    entry["stepper"] = json!(settings.method.name());
    entry
}

fn end(ending: &Ending) -> PyResult<End> {
    Ok((serde_json::to_string(ending).map_err(of_json)?, ending.is_complete(), ending.to_string()))
}

#[pymethods]
impl Field {
    #[new]
    #[pyo3(signature = (names, parameters, function, jacobian, owners))]
    fn new(
        names: Vec<String>,
        parameters: Vec<f64>,
        function: usize,
        jacobian: Option<usize>,
        owners: Py<PyAny>,
    ) -> PyResult<Self> {
        let given = Foreign::new((names.len(), parameters.len()), function, jacobian)?;
        Ok(Self { given, names, parameters, _owners: owners })
    }

    /// The rates of many states at one time, (state, coordinate).
    fn rates<'py>(
        &self,
        py: Python<'py>,
        t: f64,
        states: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let dim = self.names.len();
        if states.shape()[1] != dim {
            return Err(PyTypeError::new_err(format!("a state of this field has {dim} entries")));
        }
        let values = states.as_slice()?.to_vec();
        let flow = self.flow();
        let rates = py.detach(|| {
            let mut rates = vec![0.0; values.len()];
            for (x, dx) in values.chunks_exact(dim).zip(rates.chunks_exact_mut(dim)) {
                flow.rates(t, x, dx);
            }
            rates
        });
        PyArray1::from_vec(py, rates).reshape([states.shape()[0], dim])
    }

    /// One orbit with rows.
    #[pyo3(signature = (start, run, progress=None))]
    fn simulate(
        &self,
        py: Python<'_>,
        start: Vec<f64>,
        run: &Bound<'_, PyDict>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Rows> {
        let (run, settings) = self.settings(run)?;
        let (found, raised) = Caller::here(py, progress, |watch| {
            record(&self.flow(), &start, &span(&run), &settings, &[], watch)
        });
        let found = found.map_err(python)?;
        let mut rows = Vec::with_capacity(found.trajectory.len() * (1 + start.len()));
        for (t, state) in found.trajectory.iter() {
            rows.push(t);
            rows.extend_from_slice(state);
        }
        let rows = PyArray1::from_vec(py, rows).reshape([found.trajectory.len(), 1 + start.len()])?;
        Ok((rows.unbind(), end(&found.ending)?, raised))
    }

    /// The crossings of `coordinate number place = value`.
    #[pyo3(signature = (start, section, run, progress=None))]
    fn section(
        &self,
        py: Python<'_>,
        start: Vec<f64>,
        section: (usize, f64, &str),
        run: &Bound<'_, PyDict>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<(TableArrays, End)> {
        let (run, settings) = self.settings(run)?;
        let (place, value, direction) = section;
        let direction = crate::analyse::direction(direction)?;
        let found = answer(Caller::here(py, progress, |watch| {
            motiform_study::plan::check("value", value, true, "give a finite number")?;
            let g = |_t: f64, u: &[f64]| u[place] - value;
            let sections = [Section { g: &g, direction, terminal: false }];
            let span = Span { dt_out: f64::INFINITY, ..span(&run) };
            record(&self.flow(), &start, &span, &settings, &sections, watch).map(Some)
        }))?;
        Ok((Columns::new(py, self.crossings(&found))?.parts(py), end(&found.ending)?))
    }

    /// Many orbits at given times: as `ensemble`.
    #[pyo3(signature = (parameters, starts, times, run, threads, progress=None))]
    #[allow(clippy::too_many_arguments, reason = "the arguments of the Python function")]
    fn ensemble<'py>(
        &self,
        py: Python<'py>,
        parameters: Vec<Vec<f64>>,
        starts: Vec<Vec<f64>>,
        times: Vec<f64>,
        run: &Bound<'_, PyDict>,
        threads: usize,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<(Bound<'py, PyArray3<f64>>, String)> {
        let settings = self.settings(run)?.1;
        let members: Vec<_> = parameters.into_iter().zip(starts).collect();
        let found = answer(Caller::beside(py, progress, |watch| {
            tracks(&self.given, &members, &times, &settings, threads.max(1), watch)
        }))?;
        told(py, &found, times.len(), self.names.len())
    }

    /// The largest exponents, as `lyapunov`.
    #[pyo3(signature = (start, count, times, run, progress=None))]
    fn lyapunov(
        &self,
        py: Python<'_>,
        start: Vec<f64>,
        count: usize,
        times: (f64, f64),
        run: &Bound<'_, PyDict>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<String> {
        let (settings, (transient, t_end)) = (self.settings(run)?.1, times);
        let found = answer(Caller::here(py, progress, |watch| {
            exponents(&self.flow(), &start, count, transient, t_end, &settings, watch).map(Some)
        }))?;
        exponents_json(&found, accuracy(&settings))
    }
}

impl Field {
    fn flow(&self) -> Flow<'_> {
        Flow::new(&self.given, self.parameters.clone())
    }

    /// The settings of `run`, and its times.
    fn settings(&self, run: &Bound<'_, PyDict>) -> PyResult<(RunSettings, Settings)> {
        let typed: RunSettings = table(run)?;
        let settings = Settings::new(&typed, &self.flow()).map_err(python)?;
        Ok((typed, settings))
    }

    fn crossings(&self, found: &Recording) -> Table {
        let crossings = found.trajectory.crossings();
        let mut table = Table::of(&[&T], vec![crossings.iter().map(|crossing| crossing.t).collect()]);
        for (place, name) in self.names.iter().enumerate() {
            table.push(name, name.clone(), crossings.iter().map(|crossing| crossing.state[place]).collect());
        }
        let rising = crossings.iter().map(|crossing| f64::from(u8::from(crossing.rising))).collect();
        table.columns.push(Column::of(&RISING, rising));
        table
    }
}
