//! Mean lives of transient chaos along a parameter.

use crate::analyse::answer;
use crate::atlas::{Place, opening_of};
use crate::errors::{of_json, of_keywords, python};
use crate::scan_plan::axis;
use crate::study::Study;
use crate::watch::Caller;
use motiform_lab::answers::Lived;
use motiform_lab::draw::FigureFormat;
use motiform_lab::lifetimes::{ask, follow_into, open, write};
use motiform_study::{ScanPlan, Shown};
use pyo3::prelude::*;

/// Random starts at each value, threads; longest time of an orbit, and the time after which a life counts.
type Counts = (u64, usize, Option<f64>, Option<f64>);

/// Lives along an axis, a name with its values, as the JSON of the command line.
#[pyfunction]
#[pyo3(signature = (study, along, counts, out, progress=None))]
pub(crate) fn lifetimes(
    py: Python<'_>,
    study: &Study,
    along: (String, Bound<'_, PyAny>),
    counts: Counts,
    out: Place,
    progress: Option<Py<PyAny>>,
) -> PyResult<String> {
    let ((samples, threads, until, transient), mut study) = (counts, study.0.clone());
    ask(&mut study, axis(along.0, &along.1)?, samples, [until, transient]).map_err(of_keywords)?;
    let plan = ScanPlan::new(&study).map_err(of_keywords)?;
    let place = out.map(|(path, opening)| open(&path, opening_of(&opening), &plan));
    let place = place.transpose().map_err(python)?;
    let (lives, files) = answer(Caller::beside(py, progress, |watch| {
        let found = follow_into(&plan, place, threads, watch)?;
        Ok(found.0.is_complete().then_some(found))
    }))?;
    let found = lives.summarised(&plan, transient).map_err(python)?;
    let units = Shown::default();
    let answer = Lived::new(&plan, &found, &units);
    if let Some(files) = files {
        write(&answer, &files, &FigureFormat::default()).map_err(python)?;
    }
    serde_json::to_string(&answer).map_err(of_json)
}
