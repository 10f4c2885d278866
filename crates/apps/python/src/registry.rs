//! The registry of names. The Python side and its stubs are generated from it.

use crate::errors::{of_json, python};
use motiform_study::Dimension;
use pyo3::prelude::*;
use std::collections::BTreeMap;

/// The registry as JSON.
#[pyfunction]
pub(crate) fn registry() -> PyResult<String> {
    serde_json::to_string(&motiform_lab::registry::registry().map_err(python)?).map_err(of_json)
}

/// Powers of length and time, and an angle or none.
type Powers = (i8, i8, bool);

/// The meaning of each quantity of a subject (`motion`, `statistic`, ...), and its dimension; `None` where it has none in common.
#[pyfunction]
pub(crate) fn quantities(subject: &str) -> BTreeMap<&'static str, (&'static str, Option<Powers>)> {
    let dimension = |dimension| match dimension {
        Dimension::Powers { length, time, angle } => Some((length, time, angle)),
        Dimension::Mixed => None,
    };
    let all = motiform_store::quantity::subjects().into_iter().filter(|entry| entry.0 == subject);
    all.flat_map(|entry| entry.1).map(|one| (one.name, (one.meaning, dimension(one.dimension)))).collect()
}
