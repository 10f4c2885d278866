//! Bodies from dataset folders.

use crate::accuracy::Accuracy;
use crate::dataset::read_dataset;
use crate::statistics::Result;
use crate::statistics::record::{Measurement, Recorder, at_rest, measured, title};
use motiform_dynamics::Model;
use motiform_dynamics::digits::given;
use motiform_statistics::{Settings, Track};
use motiform_store::table::Table;
use motiform_study::plan::{Computation, NoiseSettings};
use motiform_study::{Dataset, Error};
use serde_json::json;
use std::path::{Path, PathBuf};

/// A row of another time than the grid's, in sampling intervals.
const OFF_GRID: f64 = 1e-6;

/// Statistics of the bodies in dataset folders, one each, of one model with one set of parameters and one
/// noise, at one sampling interval; what was recorded before `transient` is left out. Seeds, starts, methods
/// and lengths may differ. Runs that ended early count as far as they go.
///
/// # Errors
/// Folders that are no datasets, of different models, parameters, noise or intervals, or with rows that are not evenly spaced.
///
/// # Checked by  tests/all/datasets.rs
pub fn read(folders: &[PathBuf], transient: f64, settings: &Settings) -> Result<Measurement> {
    let mut tracks = Vec::new();
    let mut first: Option<Dataset> = None;
    let mut notes = Vec::new();
    for folder in folders {
        let dataset = read_dataset(folder)?;
        check(folder, &dataset, first.as_ref())?;
        let plan = &dataset.manifest.plan;
        let model = plan.body()?;
        tracks.push(track(&dataset.trajectory, model.as_ref(), Accuracy::of(&dataset.manifest), transient));
        if !dataset.manifest.outcome.is_complete() {
            notes.push(format!(
                "{}: {}; it counts as far as it goes",
                folder.display(),
                dataset.manifest.outcome
            ));
        }
        first.get_or_insert(dataset);
    }
    let Some(first) = first else { return Err(motiform_statistics::Error::NoBody.into()) };
    let statistics = measured(&first.manifest.plan, tracks, settings, &())?;
    notes.extend(at_rest(&statistics));
    let shown: Vec<String> = folders.iter().map(|folder| folder.display().to_string()).collect();
    let source = json!({ "folders": shown, "transient": transient, "plan": first.manifest.plan });
    let title = title(&first.manifest.plan);
    let plan = first.manifest.plan;
    Ok(Measurement { title, plan, source, seeds: Vec::new(), notes, complete: true, statistics })
}

/// The same body and interval as the first one, and evenly spaced rows.
fn check(folder: &Path, dataset: &Dataset, first: Option<&Dataset>) -> Result<()> {
    let c = &dataset.manifest.plan.computation;
    let refuse = |reason: String| Err(Error::unreadable(folder, reason).into());
    if let Some(first) = first.map(|first| &first.manifest.plan.computation) {
        if let Some(reason) = other_body(first, c) {
            return refuse(reason);
        }
        if (first.dt_out / c.dt_out - 1.0).abs() > OFF_GRID {
            return refuse(format!(
                "its dt_out is {}, that of the first folder {}: record with one dt_out",
                c.dt_out, first.dt_out
            ));
        }
    }
    let times = dataset.trajectory.get("t").unwrap_or(&[]);
    let uneven = |pair: &[f64]| {
        let off = (pair[1] - pair[0] - c.dt_out).abs();
        off.is_nan() || off > OFF_GRID * c.dt_out + 1e-14 * pair[1].abs()
    };
    match times.windows(2).position(uneven) {
        Some(row) => refuse(format!("its rows are not {} apart after t = {}", c.dt_out, times[row])),
        None => Ok(()),
    }
}

/// The reason why these are runs of different bodies, whose mean is that of no body: another model, parameter
/// or noise.
fn other_body(first: &Computation, c: &Computation) -> Option<String> {
    if first.model != c.model {
        return Some(format!(
            "it is of model {}, the first folder of {}: give one model",
            c.model, first.model
        ));
    }
    let remedy = "give one set of parameters, and measure others by themselves";
    let pairs = first.parameters.0.iter().zip(&c.parameters.0);
    let mut others = pairs.filter(|((_, one), (_, other))| one.to_bits() != other.to_bits() && one != other);
    if let Some(((name, expected), (_, got))) = others.next() {
        return Some(format!("its {name} is {got}, that of the first folder {expected}: {remedy}"));
    }
    let on = |noise: NoiseSettings| {
        format!("{} on the shape, {} on the velocity", given(noise.shape), given(noise.velocity))
    };
    let shown = |c: &Computation| c.noise.map_or("none".to_owned(), on);
    let strength = |c: &Computation| c.noise.map(|noise| [noise.velocity, noise.shape]);
    (strength(first) != strength(c))
        .then(|| format!("its noise is {}, that of the first folder {}: {remedy}", shown(c), shown(first)))
}

/// The track in a table of a motion, from the time `from` on.
pub(crate) fn track(table: &Table, model: &dyn Model, accuracy: Accuracy, from: f64) -> Track {
    let column = |name: &str| table.get(name).unwrap_or(&[]);
    let (t, x, y) = (column("t"), column("x"), column("y"));
    let coordinates: Vec<&[f64]> = model.coordinates().iter().map(|c| column(c.name)).collect();
    let mut recorder = Recorder::new(model, accuracy);
    let mut state = vec![0.0; coordinates.len()];
    for row in (0..t.len()).filter(|&row| t[row] >= from) {
        for (value, column) in state.iter_mut().zip(&coordinates) {
            *value = column[row];
        }
        recorder.push(&state, [x[row], y[row]]);
    }
    recorder.finish()
}
