//! Tracked cells.

use crate::errors::{of_cells, of_json, of_tracks};
use crate::study::Study;
use crate::watch::Caller;
use motiform_cells::{
    CellFit, CellTrack, FitOptions, OutlineFile, coefficient_columns, fit_cells, fits_json, mode_columns,
    observations_json, observe,
};
use motiform_store::columns::to_csv;
use motiform_tracks::modes::ModeOptions;
use motiform_tracks::{Cell, Columns, Given, Options, Outline, Tracks, given};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use serde_json::{Value, json};
use std::path::PathBuf;

/// Outlines of one cell from Python: time, vertices.
type Outlines<'py> = Vec<(f64, PyReadonlyArray2<'py, f64>)>;
/// Outlines to Python: number of the frame, time, vertices.
type Drawn<'py> = Vec<(i64, f64, Bound<'py, PyArray2<f64>>)>;
/// Scale and interval, units, format, headers of columns.
type Asked =
    (Option<f64>, Option<f64>, (Option<String>, Option<String>), Option<String>, Vec<(String, String)>);
/// Units, and whether y points down.
type About = ((String, String), Option<bool>);
/// The fits as JSON, their coefficients as CSV, the models by the names of the cells, and what a signal or the callable raised.
type Fits<'py> = (String, Bound<'py, PyBytes>, Vec<(String, Study)>, Option<PyErr>);

/// Cells with their modes; immutable.
#[pyclass(frozen, module = "motiform._motiform")]
pub(crate) struct Sample(motiform_cells::Sample);

#[pymethods]
impl Sample {
    /// Files; those that stand for data `in_memory` are not named in results.
    #[staticmethod]
    #[pyo3(signature = (paths, asked, in_memory=false))]
    fn read(py: Python<'_>, paths: Vec<PathBuf>, asked: Asked, in_memory: bool) -> PyResult<Self> {
        let (pixel_size, interval, (length_unit, time_unit), format, columns) = asked;
        let format = format.map(|name| name.parse()).transpose().map_err(of_tracks)?;
        let columns = Columns::named(&columns);
        let options =
            Options { format, pixel_size, interval, length_unit, time_unit, columns, ..Options::default() };
        let read = || motiform_cells::Sample::read(&paths, &options, &ModeOptions::default());
        let mut sample = py.detach(read).map_err(of_cells)?;
        if in_memory {
            sample.tracks.files.clear();
        }
        Ok(Self(sample))
    }

    /// Outlines in memory.
    #[staticmethod]
    fn given(py: Python<'_>, cells: Vec<(String, Outlines<'_>)>, about: About) -> PyResult<Self> {
        let cells = cells.into_iter().map(cell).collect::<PyResult<Vec<Cell>>>()?;
        let ((length_unit, time_unit), y_down) = about;
        let about = Given { length_unit, time_unit, y_down };
        let tracks = py.detach(|| given(cells, about)).map_err(of_tracks)?;
        let modes = || motiform_cells::Sample::of_tracks(tracks, &ModeOptions::default());
        Ok(Self(py.detach(modes)))
    }

    /// Units, notes, and the quality of each cell, as JSON.
    fn summary(&self) -> PyResult<String> {
        let cell = |cell: &CellTrack| {
            json!({
                "name": cell.name, "frames": cell.modes.frames.len(), "counting": cell.frames(),
                "radius": cell.radius, "flags": cell.flags(), "left_out": cell.left_out(),
                "notes": notes(&self.0, &cell.name),
            })
        };
        let tracks = &self.0.tracks;
        text(&json!({
            "cells": self.0.cells.iter().map(cell).collect::<Vec<_>>(),
            "units": { "length": tracks.length_unit, "time": tracks.time_unit },
            "y_down": tracks.y_down,
            "notes": self.0.notes(),
        }))
    }

    /// Modes of all frames, as CSV.
    fn modes<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &to_csv(&mode_columns(&self.0.cells)))
    }

    /// The outlines of a cell.
    fn outlines<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Drawn<'py>> {
        let cell = self.0.tracks.cells.iter().find(|cell| cell.name == name);
        let cell = cell.ok_or_else(|| PyKeyError::new_err(name.to_owned()))?;
        let drawn = |outline: &Outline| {
            let values = PyArray1::from_vec(py, outline.points.as_flattened().to_vec());
            Ok((outline.frame, outline.t, values.reshape([outline.points.len(), 2])?))
        };
        cell.frames.iter().map(drawn).collect()
    }

    /// Writes the outlines of these cells: the long table or AmoePy's text, by the ending of the name.
    fn write(&self, py: Python<'_>, names: Vec<String>, path: PathBuf) -> PyResult<()> {
        self.chosen(&names)?;
        let tracks = &self.0.tracks;
        let cells = tracks.cells.iter().filter(|cell| names.contains(&cell.name)).cloned().collect();
        let (length_unit, time_unit) = (tracks.length_unit.clone(), tracks.time_unit.clone());
        let chosen = Tracks { cells, length_unit, time_unit, files: vec![], notes: vec![], ..*tracks };
        py.detach(|| OutlineFile::new(&path, true)?.write(&chosen)).map(drop).map_err(of_cells)
    }

    /// The observed motions of these cells, as JSON; those that an interruption left out are missing.
    #[pyo3(signature = (names, progress=None))]
    fn observe(
        &self,
        py: Python<'_>,
        names: Vec<String>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<(String, Option<PyErr>)> {
        let cells = self.chosen(&names)?;
        let (found, raised) = Caller::here(py, progress, |watch| {
            let mut found = Vec::new();
            for (number, cell) in cells.iter().enumerate() {
                if watch.stopped() {
                    break;
                }
                found.push(observe(cell));
                watch.progress((number + 1) as f64 / cells.len() as f64);
            }
            found
        });
        Ok((text(&observations_json(&self.0, &found))?, raised))
    }

    /// Fits of these cells; those that an interruption left out are missing.
    #[pyo3(signature = (names, settings, progress=None))]
    fn fit<'py>(
        &self,
        py: Python<'py>,
        names: Vec<String>,
        settings: (u32, usize, usize, u64, usize, bool, usize),
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Fits<'py>> {
        let cells = self.chosen(&names)?;
        let (order, modes, draws, seed, simulations, ladder, threads) = settings;
        let options = FitOptions { order, modes, draws, seed, simulations, ladder, ..FitOptions::default() };
        let (found, raised) =
            Caller::beside(py, progress, |watch| fit_cells(&cells, &options, threads.max(1), watch));
        let fits: Vec<CellFit> = match (found, raised.as_ref()) {
            (Ok(found), _) => found.into_iter().flatten().collect(),
            (Err(_), Some(_)) => Vec::new(),
            (Err(error), None) => return Err(of_cells(error)),
        };
        let mut models = Vec::new();
        for fit in &fits {
            let Ok(fitted) = &fit.fitted else { continue };
            models.push((
                fit.name.clone(),
                Study(fitted.study(&fit.name, self.0.radius(&fit.name)).map_err(of_cells)?),
            ));
        }
        let table = PyBytes::new(py, &to_csv(&coefficient_columns(&fits)));
        Ok((text(&fits_json(&self.0, &fits))?, table, models, raised))
    }
}

impl Sample {
    fn chosen(&self, names: &[String]) -> PyResult<Vec<&CellTrack>> {
        let find = |name: &String| self.0.cells.iter().find(|cell| cell.name == *name);
        names.iter().map(|name| find(name).ok_or_else(|| PyKeyError::new_err(name.clone()))).collect()
    }
}

fn cell((name, outlines): (String, Outlines<'_>)) -> PyResult<Cell> {
    let outline = |(t, points): (f64, PyReadonlyArray2<'_, f64>)| {
        let shape = points.shape();
        if shape[1] != 2 {
            let found =
                format!("cell {name}, time {t}: an outline must have the shape (n, 2), not {shape:?}");
            return Err(PyValueError::new_err(found));
        }
        let points = points.as_array().rows().into_iter().map(|row| [row[0], row[1]]).collect();
        Ok(Outline { frame: 0, t, points, missing: 0 }) // counted from the times
    };
    let frames = outlines.into_iter().map(outline).collect::<PyResult<Vec<Outline>>>()?;
    Ok(Cell { name, frames })
}

/// Notes that name this cell.
fn notes(sample: &motiform_cells::Sample, name: &str) -> Vec<String> {
    let of_cell = sample.tracks.notes.iter().filter(|note| note.cells().contains(&name));
    of_cell.map(ToString::to_string).collect()
}

fn text(value: &Value) -> PyResult<String> {
    serde_json::to_string(value).map_err(of_json)
}
