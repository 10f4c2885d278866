//! Many orbits at given times.

use crate::analyse::answer;
use crate::errors::{of_json, python};
use crate::study::{Study, plan};
use crate::watch::Caller;
use motiform_lab::ensemble::{Member, Track, random_members, tracks};
use motiform_study::Error;
use numpy::{PyArray1, PyArray3, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;

/// Starts of an ensemble, (member, entry): `count` random ones of the study.
#[pyfunction]
pub(crate) fn random_starts(study: &Study, count: usize) -> PyResult<Vec<Vec<f64>>> {
    let starts = || -> Result<Vec<Vec<f64>>, Error> {
        let random = study.0.starts(count as u64)?;
        let members = random_members(&plan(study)?, count, random)?;
        Ok(members.into_iter().map(|member| member.start).collect())
    };
    starts().map_err(python)
}

/// The states (member, time, entry), NaN at times that a member did not reach, and how each member ended, as JSON.
#[pyfunction]
#[pyo3(signature = (study, parameters, starts, times, threads, progress=None))]
pub(crate) fn ensemble<'py>(
    py: Python<'py>,
    study: &Study,
    parameters: PyReadonlyArray2<'py, f64>,
    starts: PyReadonlyArray2<'py, f64>,
    times: Vec<f64>,
    threads: usize,
    progress: Option<Py<PyAny>>,
) -> PyResult<(Bound<'py, PyArray3<f64>>, String)> {
    let entries = starts.shape()[1];
    let rows = |array: &PyReadonlyArray2<'py, f64>| -> PyResult<Vec<Vec<f64>>> {
        Ok(array.as_slice()?.chunks_exact(array.shape()[1]).map(<[f64]>::to_vec).collect())
    };
    let members = rows(&parameters)?.into_iter().zip(rows(&starts)?);
    let members: Vec<Member> = members.map(|(parameters, start)| Member { parameters, start }).collect();
    let found = answer(Caller::here(py, progress, |watch| {
        let mut study = study.clone();
        study.0.run.dt_out = 0.0; // there are no rows: those of a preset may be too many for this span
        tracks(&plan(&study)?, &members, &times, threads.max(1), watch)
    }))?;
    told(py, &found, times.len(), entries)
}

/// The states (member, time, entry), NaN at times that a member did not reach, and how each member ended, as JSON.
pub(crate) fn told<'py>(
    py: Python<'py>,
    tracks: &[Track],
    times: usize,
    entries: usize,
) -> PyResult<(Bound<'py, PyArray3<f64>>, String)> {
    let outcomes = serde_json::to_string(&tracks.iter().map(ended).collect::<Vec<_>>()).map_err(of_json)?;
    let mut block = vec![f64::NAN; tracks.len() * times * entries];
    for (track, room) in tracks.iter().zip(block.chunks_exact_mut((times * entries).max(1))) {
        for (state, room) in track.states.iter().zip(room.chunks_exact_mut(entries)) {
            room.copy_from_slice(state);
        }
    }
    Ok((PyArray1::from_vec(py, block).reshape([tracks.len(), times, entries])?, outcomes))
}

/// The outcome, whether it is complete, and the same as text.
fn ended(track: &Track) -> (motiform_dynamics::Outcome, bool, String) {
    (track.outcome, track.outcome.is_complete(), track.outcome.to_string())
}
