//! Atlases of a plane of two parameters.

use crate::errors::{of_json, python};
use crate::study::{Study, apply};
use crate::watch::Caller;
use motiform_diagrams::atlas::{
    AtlasFolder, atlas_map, atlas_summary, cell_columns, curve_columns, survey, trace,
};
use motiform_dynamics::{Part, Watch};
use motiform_figures::{Style, Width};
use motiform_lab::draw::{FigureFormat, files};
use motiform_store::columns::{Column, to_csv};
use motiform_store::{Folder, Journal, Opening};
use motiform_study::Error;
use motiform_study::atlas::{self, AtlasPlan};
use motiform_study::scan::Axis;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyType};
use std::path::PathBuf;

/// A finished atlas.
#[pyclass(frozen, module = "motiform._motiform")]
pub(crate) struct Atlas(AtlasFolder);

/// Initial states of a cell, model time for classifying a motion, threads.
type Counts = (Option<u64>, Option<f64>, usize);

/// A folder, and whether it is new, resumed or replaced.
pub(crate) type Place = Option<(PathBuf, String)>;

/// The atlas of a plane: both axes as text, as on the command line; what a signal or the callable raised in its place.
#[pyfunction]
#[pyo3(signature = (study, axes, counts, settings, out, progress=None))]
pub(crate) fn make_atlas(
    py: Python<'_>,
    study: &Study,
    axes: Option<Vec<String>>,
    counts: Counts,
    settings: &Bound<'_, PyDict>,
    out: Place,
    progress: Option<Py<PyAny>>,
) -> PyResult<Option<Atlas>> {
    let (samples, budget, threads) = counts;
    let mut study = study.0.clone();
    apply(settings, &mut study.atlas)?;
    if let Some(axes) = axes {
        let axes: Result<Vec<Axis>, Error> = axes.iter().map(|text| atlas::axis(text)).collect();
        study.scan.axes = axes.map_err(python)?;
    }
    study.scan.samples = atlas::samples(&study, samples);
    study.scan.budget = budget.unwrap_or(study.scan.budget);
    let study = study.perturbed().map_err(python)?.0;
    let plan = AtlasPlan::new(&study).map_err(python)?;
    let folder = out.map(|(path, opening)| AtlasFolder::open(&path, &plan, opening_of(&opening)));
    let folder: Option<Folder> = folder.transpose().map_err(python)?;
    let journal: &dyn Journal = folder.as_ref().map_or(&(), |folder| folder);
    let (found, raised) = Caller::beside(py, progress, |watch| compute(&plan, threads, journal, watch));
    let found = found.map_err(python)?;
    if let Some(error) = raised {
        folder.map(|folder| folder.settle()).transpose().map_err(|error| python(error.into()))?;
        return Err(error);
    }
    let Some((grid, lines)) = found else { return Ok(None) };
    let atlas = AtlasFolder { plan, grid, lines };
    if let Some(folder) = folder {
        atlas.write(&folder, Some(&FigureFormat::default())).map_err(python)?;
    }
    Ok(Some(Atlas(atlas)))
}

/// The cells, then the lines; nothing if it was stopped.
fn compute(
    plan: &AtlasPlan,
    threads: usize,
    journal: &dyn Journal,
    watch: &dyn Watch,
) -> Result<Option<(motiform_diagrams::atlas::Grid, Vec<motiform_diagrams::atlas::Line>)>, Error> {
    let cells = Part { watch, from: 0.0, to: 0.5 };
    let Some(grid) = survey(plan, threads, journal, &cells, &|_| {})? else { return Ok(None) };
    let part = Part { watch, from: 0.5, to: 1.0 };
    let lines = trace(plan, &grid, threads, journal, &part, &|_| {})?;
    Ok(lines.map(|lines| (grid, lines)))
}

pub(crate) fn opening_of(text: &str) -> Opening {
    match text {
        "resume" => Opening::Resume,
        "replace" => Opening::Replace,
        _ => Opening::New,
    }
}

/// The atlas in a folder.
#[pyfunction]
pub(crate) fn read_atlas(path: PathBuf) -> PyResult<Atlas> {
    AtlasFolder::read(&path).map(Atlas).map_err(python)
}

#[pymethods]
impl Atlas {
    /// The atlas of this JSON.
    #[staticmethod]
    fn of_json(text: &str) -> PyResult<Self> {
        serde_json::from_str(text).map(Self).map_err(of_json)
    }

    fn __reduce__(&self, py: Python<'_>) -> PyResult<(Py<PyAny>, (String,))> {
        let text = serde_json::to_string(&self.0).map_err(of_json)?;
        Ok((PyType::new::<Self>(py).getattr("of_json")?.unbind(), (text,)))
    }

    /// The JSON of the command line.
    fn summary(&self) -> PyResult<String> {
        serde_json::to_string(&atlas_summary(&self.0)).map_err(of_json)
    }

    /// A row per cell and motion, and a row per point of each curve, as CSV (every digit).
    fn tables<'py>(&self, py: Python<'py>) -> [Bound<'py, PyBytes>; 2] {
        let AtlasFolder { plan, grid, lines } = &self.0;
        let csv = |table: Vec<Column>| PyBytes::new(py, &to_csv(&table));
        [csv(cell_columns(plan, grid)), csv(curve_columns(plan, lines))]
    }

    /// The map as a file of a format (`svg`, `png`, `pdf`, or its numbers as `csv`).
    #[pyo3(signature = (format, width=None, title=None, caption=true))]
    fn figure<'py>(
        &self,
        py: Python<'py>,
        format: &str,
        width: Option<&str>,
        title: Option<String>,
        caption: bool,
    ) -> PyResult<Option<Bound<'py, PyBytes>>> {
        let undrawable = |error| python(motiform_lab::draw::undrawable(error));
        let width = width.map(str::parse::<Width>).transpose().map_err(undrawable)?;
        let style = Style { title, no_caption: !caption, width, ..Style::default() };
        let style = FigureFormat { pdf: format == "pdf", style, ..FigureFormat::default() };
        let drawn = py.detach(|| files(vec![("atlas", Box::new(atlas_map(&self.0)?) as _)], true, &style));
        let name = format!("atlas.{format}");
        let picture = drawn.map_err(python)?.into_iter().find(|picture| picture.name == name);
        Ok(picture.map(|picture| PyBytes::new(py, &picture.bytes)))
    }
}
