//! A study, as represented in Python.

use crate::errors::{of_keywords, python};
use motiform_dynamics::model::Coordinate;
use motiform_models::ModelInfo;
use motiform_study::{Error, Random, Settings, Shown, presets, remarks};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString, PyType};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// A model with its parameters, an initial state and run settings; immutable, only copied with changes.
#[pyclass(frozen, module = "motiform._motiform")]
#[derive(Clone)]
pub(crate) struct Study(pub(crate) motiform_study::Study);

#[pymethods]
impl Study {
    /// A model with its defaults.
    #[staticmethod]
    fn of_model(name: &str) -> PyResult<Self> {
        let info = ModelInfo::find(name).map_err(|error| python(error.into()))?;
        Ok(Self(motiform_study::Study::of_model(info)))
    }

    /// A preset of any model.
    #[staticmethod]
    fn preset(name: &str) -> PyResult<Self> {
        presets::find_any(name, motiform_models::MODELS[0].name).map(Self).map_err(python)
    }

    /// A study file.
    #[staticmethod]
    fn read(path: PathBuf) -> PyResult<Self> {
        motiform_study::Study::read(&path).map(Self).map_err(python)
    }

    /// The text of a study file.
    #[staticmethod]
    fn parse(text: &str, name: &str) -> PyResult<Self> {
        motiform_study::Study::parse(text, name, name).map(Self).map_err(python)
    }

    /// A copy in which each of these parameters follows from others.
    fn tied(&self, ties: BTreeMap<String, String>) -> PyResult<Self> {
        let mut study = self.0.clone();
        for (name, formula) in ties {
            study.tie(&name, &formula).map_err(of_keywords)?;
        }
        Ok(Self(study))
    }

    /// Remarks on what is allowed and probably not meant, where these parameters are varied: a sentence each.
    fn remarks(&self, varied: Vec<String>) -> PyResult<Vec<String>> {
        let varied: Vec<&str> = varied.iter().map(String::as_str).collect();
        remarks(&self.0, &varied).map_err(python)
    }

    /// A copy with other parameters, initial values and run settings.
    #[pyo3(signature = (parameters=None, initial=None, run=None))]
    fn with_(
        &self,
        parameters: Option<&Bound<'_, PyDict>>,
        initial: Option<&Bound<'_, PyDict>>,
        run: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let mut study = self.0.clone();
        let specs = self.0.info().map_err(python)?.parameters();
        for (name, value) in parameters.into_iter().flatten() {
            let name: String = name.extract()?;
            let value = number(&name, &value);
            let known = specs.iter().any(|spec| spec.name == name);
            // a name that is none is refused before its value
            let value = if known { value? } else { value.unwrap_or_default() };
            study.set(&name, value).map_err(of_keywords)?;
        }
        for (name, value) in initial.into_iter().flatten() {
            let name: String = name.extract()?;
            let value = number(&name, &value)?;
            study.set_initial(&name, value).map_err(python)?;
        }
        for (name, value) in run.into_iter().flatten() {
            set(&mut study, name.cast::<PyString>()?.to_str()?, &value)?;
        }
        if parameters.is_some() {
            study.body().map_err(python)?; // refuses what is out of range
        }
        Ok(Self(study))
    }

    #[getter]
    fn model(&self) -> &str {
        self.0.model.as_str()
    }

    /// The entry of its model in the registry, as JSON.
    fn info(&self) -> PyResult<String> {
        let info = self.0.info().map_err(python)?;
        serde_json::to_string(&motiform_lab::registry::entry(info).map_err(python)?)
            .map_err(crate::errors::of_json)
    }

    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    #[getter]
    fn title(&self) -> &str {
        &self.0.title
    }

    #[getter]
    fn about(&self) -> &str {
        &self.0.about
    }

    #[getter]
    fn free(&self) -> Vec<String> {
        self.0.free.clone()
    }

    /// All parameters, in registry order.
    fn parameters(&self) -> PyResult<Vec<(&'static str, f64)>> {
        let specs = self.0.info().map_err(python)?.parameters();
        let values = self.0.values().map_err(python)?;
        Ok(specs.iter().map(|spec| spec.name).zip(values).collect())
    }

    /// The parameters that were given.
    fn given(&self) -> Vec<(String, f64)> {
        self.0.parameters.clone()
    }

    /// The initial values that were given.
    fn initial(&self) -> Vec<(String, f64)> {
        self.0.initial.clone()
    }

    /// The coordinates of the shape: name and meaning.
    fn coordinates(&self) -> PyResult<Vec<(&'static str, &'static str)>> {
        let values = self.0.values().map_err(python)?;
        let coordinates = self.0.info().map_err(python)?.coordinates(&values);
        Ok(coordinates.iter().map(|&Coordinate { name, meaning }| (name, meaning)).collect())
    }

    /// The units of length and time; empty where they are those of the model.
    #[getter]
    fn units(&self) -> &str {
        &self.0.figure.units
    }

    /// The run settings as JSON.
    fn run(&self) -> PyResult<String> {
        serde_json::to_string(&self.0.run).map_err(crate::errors::of_json)
    }

    /// The text of a study file that gives this study.
    fn to_toml(&self) -> PyResult<String> {
        self.0.to_toml().map_err(python)
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.0 == other.0
    }

    fn __reduce__(&self, py: Python<'_>) -> PyResult<(Py<PyAny>, (String, String))> {
        let parse = PyType::new::<Self>(py).getattr("parse")?;
        Ok((parse.unbind(), (self.to_toml()?, self.0.name.clone())))
    }
}

/// A real number; anything else is a `TypeError` that names the key.
pub(crate) fn number(name: &str, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    value.extract().map_err(|_| {
        let kind = value.get_type();
        PyTypeError::new_err(format!(
            "{name} must be a real number, not {}",
            kind.name().map_or_else(|_| "this".to_owned(), |name| name.to_string())
        ))
    })
}

/// A whole number of at least 0.
fn whole(name: &str, value: &Bound<'_, PyAny>) -> PyResult<u64> {
    let wrong = || {
        let shown = value.repr().map_or_else(|_| "?".to_owned(), |text| text.to_string());
        PyTypeError::new_err(format!("{name} must be a whole number of at least 0, not {shown}"))
    };
    value.extract().map_err(|_| wrong())
}

/// The distribution of random starts: a size, a pair of the smallest and the largest, or a text as on the command line.
fn random(value: &Bound<'_, PyAny>) -> PyResult<Random> {
    if let Ok(text) = value.extract::<String>() {
        return Random::parse(&text).map_err(of_keywords);
    }
    let random = match value.extract::<(f64, f64)>() {
        Ok((min, max)) => Random::Sizes { min, max },
        Err(_) => Random::Within(value.extract().map_err(|_| {
            let remedy = "give a size, such as 0.3, or the smallest and the largest, such as (0.01, 1.0)";
            PyTypeError::new_err(format!("random = {value}: {remedy}"))
        })?),
    };
    random.check().map_err(of_keywords)?;
    Ok(random)
}

/// Sets one setting of a study.
fn set(study: &mut motiform_study::Study, name: &str, value: &Bound<'_, PyAny>) -> PyResult<()> {
    match name {
        "random" => study.random = Some(random(value)?),
        "units" => {
            let text: String = value.extract()?;
            Shown::parse(&text).map_err(of_keywords)?;
            study.figure.units = text;
        }
        "perturb" => study.perturb = number(name, value)?,
        _ if set_one(&mut study.run, name, value)? => {}
        _ => return Err(PyTypeError::new_err(format!("unknown setting {name:?}"))),
    }
    Ok(())
}

/// Sets one setting of a table; `false` if this is none of them. `None` leaves it as it is.
pub(crate) fn set_one<S: Settings>(table: &mut S, name: &str, value: &Bound<'_, PyAny>) -> PyResult<bool> {
    let Some(key) = S::keys().iter().find(|key| key.name() == name) else { return Ok(false) };
    let value: Value = match key.kind().as_str() {
        _ if value.is_none() => return Ok(true),
        "number" => number(name, value)?.into(),
        "integer" => whole(name, value)?.into(),
        "boolean" => value.extract::<bool>()?.into(),
        "array" => value.extract::<Vec<String>>()?.into(),
        _ => value.extract::<String>()?.into(),
    };
    table.set(name, &value).map_err(of_keywords)
}

/// A table with these settings, the others with their defaults.
pub(crate) fn table<S: Settings + Default>(given: &Bound<'_, PyDict>) -> PyResult<S> {
    let mut table = S::default();
    apply(given, &mut table)?;
    Ok(table)
}

/// Sets these settings of a table; `None` leaves one as it is.
pub(crate) fn apply<S: Settings>(given: &Bound<'_, PyDict>, table: &mut S) -> PyResult<()> {
    for (name, value) in given {
        let name = name.cast::<PyString>()?;
        if !set_one(table, name.to_str()?, &value)? {
            return Err(PyTypeError::new_err(format!("unknown setting {name:?}")));
        }
    }
    Ok(())
}

/// The plan of a study.
pub(crate) fn plan(study: &Study) -> Result<motiform_study::RunPlan, Error> {
    motiform_study::RunPlan::new(&study.0)
}
