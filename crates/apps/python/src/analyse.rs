//! Analyses of one motion; results as JSON, which the Python side converts to its classes.

use crate::errors::{of_json, python};
use crate::run::{Columns, TableArrays};
use crate::study::{Study, plan};
use crate::watch::Caller;
use motiform_analysis::Lyapunov;
use motiform_dynamics::Direction;
use motiform_lab::analyse::Spans;
use motiform_lab::answers::{Motions, OfOrbit};
use motiform_lab::samples::{self, Basins, Escapes, Samples};
use motiform_study::{Error, RunPlan};
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;
use serde_json::{Value, json};

/// The result, or what stopped the analysis.
pub(crate) fn answer<T>((answer, raised): (Result<Option<T>, Error>, Option<PyErr>)) -> PyResult<T> {
    if let Some(raised) = raised {
        return Err(raised);
    }
    answer.map_err(python)?.ok_or_else(|| PyKeyboardInterrupt::new_err("interrupted"))
}

/// The accuracy of a motion: stepper, and its tolerances or step.
fn accuracy(plan: &RunPlan) -> PyResult<Value> {
    let mut entry = serde_json::to_value(plan.computation.control).map_err(of_json)?;
    entry["stepper"] = json!(plan.computation.stepper);
    Ok(entry)
}

/// The verdict on a study's motion.
#[pyfunction]
#[pyo3(signature = (study, budget=0.0, progress=None))]
pub(crate) fn classify(
    py: Python<'_>,
    study: &Study,
    budget: f64,
    progress: Option<Py<PyAny>>,
) -> PyResult<String> {
    let perturbed = study.0.perturbed().map_err(python)?.0;
    let plan = RunPlan::new(&perturbed).map_err(python)?;
    let verdict =
        answer(Caller::here(py, progress, |watch| motiform_lab::analyse::classify(&plan, budget, watch)))?;
    let mut entry = serde_json::to_value(&verdict).map_err(of_json)?;
    entry["accuracy"] = accuracy(&plan)?;
    Ok(entry.to_string())
}

/// The motions of many initial states, with their shares.
#[pyfunction]
#[pyo3(signature = (study, samples, budget=0.0, threads=1, progress=None))]
pub(crate) fn motions(
    py: Python<'_>,
    study: &Study,
    samples: usize,
    budget: f64,
    threads: usize,
    progress: Option<Py<PyAny>>,
) -> PyResult<String> {
    let (used, verdicts, basins, escapes) = answer(Caller::here(py, progress, |watch| {
        let mut study = Study(study.0.perturbed()?.0);
        let random = study.0.starts(samples as u64)?;
        study.0.random = Some(random); // the first of many is drawn like the others
        let given = study.0.initial.iter().any(|(name, _)| !["x", "y"].contains(&name.as_str()));
        let (plan, samples) =
            (plan(&study)?, Samples { count: samples, random, given, threads: threads.max(1) });
        let Some(verdicts) = samples::classify(&plan, samples, budget, watch)? else { return Ok(None) };
        let escapes = Escapes::of_verdicts(&plan, samples, &verdicts, budget, watch)?;
        let basins = Basins::new(&samples, &verdicts);
        Ok(Some((plan, verdicts, basins, escapes)))
    }))?;
    let found = Motions::new(&used, &verdicts, &basins, escapes.as_ref());
    let mut entry = serde_json::to_value(&found).map_err(of_json)?;
    entry["words"] = json!(found.sentences());
    entry["accuracy"] = accuracy(&used)?;
    Ok(entry.to_string())
}

/// The largest exponents of a study's motion.
#[pyfunction]
#[pyo3(signature = (study, count, transient=None, t_end=None, progress=None))]
pub(crate) fn lyapunov(
    py: Python<'_>,
    study: &Study,
    count: usize,
    transient: Option<f64>,
    t_end: Option<f64>,
    progress: Option<Py<PyAny>>,
) -> PyResult<String> {
    let plan = plan(study).map_err(python)?;
    let found = answer(Caller::here(py, progress, |watch| {
        motiform_lab::analyse::lyapunov(&plan, count, Spans { transient, t_end }, watch).map(Some)
    }))?;
    exponents_json(&found, accuracy(&plan)?)
}

/// Exponents as JSON.
pub(crate) fn exponents_json(found: &Lyapunov, accuracy: Value) -> PyResult<String> {
    let mut entry = serde_json::to_value(OfOrbit::new(found)).map_err(of_json)?;
    entry["accuracy"] = accuracy;
    entry["complete"] = json!(found.outcome.is_complete());
    entry["ended"] = json!(found.outcome.to_string());
    Ok(entry.to_string())
}

/// The steady motions of a study's model.
#[pyfunction]
#[pyo3(signature = (study, starts, progress=None))]
pub(crate) fn equilibria(
    py: Python<'_>,
    study: &Study,
    starts: usize,
    progress: Option<Py<PyAny>>,
) -> PyResult<String> {
    let found = answer(Caller::here(py, progress, |watch| {
        motiform_lab::equilibria::equilibria(&plan(study)?, starts, watch)
    }))?;
    serde_json::to_string(&found).map_err(of_json)
}

/// The direction of a crossing by its name.
pub(crate) fn direction(name: &str) -> PyResult<Direction> {
    match name {
        "rising" => Ok(Direction::Rising),
        "falling" => Ok(Direction::Falling),
        "either" => Ok(Direction::Either),
        other => Err(PyValueError::new_err(format!(
            "direction = {other:?}: give \"rising\", \"falling\" or \"either\""
        ))),
    }
}

/// Names, meanings and values of the crossings; how the run ended, as JSON; whether it was complete; the same as text.
type Crossings = (TableArrays, (String, bool, String));

/// The crossings of `coordinate = value`.
#[pyfunction]
#[pyo3(signature = (study, coordinate, value, direction, progress=None))]
pub(crate) fn section(
    py: Python<'_>,
    study: &Study,
    coordinate: &str,
    value: f64,
    direction: &str,
    progress: Option<Py<PyAny>>,
) -> PyResult<Crossings> {
    let direction = self::direction(direction)?;
    let mut study = study.clone();
    study.0.run.dt_out = 0.0; // there are no rows: those of a preset may be too many for this span
    let (table, outcome) = answer(Caller::here(py, progress, |watch| {
        motiform_lab::section::section(&plan(&study)?, coordinate, value, direction, watch).map(Some)
    }))?;
    let ended = serde_json::to_string(&outcome).map_err(of_json)?;
    Ok((Columns::new(py, table)?.parts(py), (ended, outcome.is_complete(), outcome.to_string())))
}
