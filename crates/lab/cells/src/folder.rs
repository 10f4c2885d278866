//! The folder of a result: `summary.json`, `modes.parquet`, and for fits `coefficients.parquet` and a study file per cell.

use crate::provenance::study_file;
use crate::{
    CellFit, FitOptions, Observation, Result, Sample, coefficient_columns, file_names, fits_json,
    mode_columns, number_columns, observations_json,
};
use motiform_store::Staged;
use motiform_store::columns::{Column, encode, to_csv};
use motiform_study::Error;
use serde_json::Value;
use std::path::{Path, PathBuf};

pub(crate) const SUMMARY: &str = "summary.json";
const NUMBERS: &str = "numbers.csv";
pub(crate) const MODES: &str = "modes.parquet";

/// The files of fits, by name; `target` is what errors name.
pub(crate) fn result_files(
    sample: &Sample,
    fits: &[CellFit],
    options: &FitOptions,
    target: &Path,
) -> Result<Vec<(String, Vec<u8>)>> {
    let mut files = common(sample, &fits_json(sample, fits), target)?;
    files.push(("coefficients.parquet".to_owned(), table(&coefficient_columns(fits), target)?));
    for (fit, name) in fits.iter().zip(file_names(fits.iter().map(|fit| fit.name.as_str()))) {
        // a search that did not converge is no model
        let Some(fitted) = fit.fitted.as_ref().ok().filter(|fitted| fitted.model().converged()) else {
            continue;
        };
        files.push((format!("{name}.toml"), study_file(sample, fit, fitted, options)?.into_bytes()));
    }
    Ok(files)
}

/// Writes observations, beside what was written before, such as pages. Returns the folder, and what stayed there, in sentences.
///
/// # Errors
/// Files that cannot be written.
pub fn write_observations(
    sample: &Sample,
    found: &[Observation],
    staged: Staged,
) -> Result<(PathBuf, Vec<String>)> {
    for (name, bytes) in &common(sample, &observations_json(sample, found), staged.target())? {
        staged.write(name, bytes)?;
    }
    staged.write(NUMBERS, &to_csv(&number_columns(found)))?;
    Ok(staged.commit()?)
}

/// Parts that both kinds of results have.
fn common(sample: &Sample, summary: &Value, target: &Path) -> Result<Vec<(String, Vec<u8>)>> {
    let mut text = serde_json::to_vec_pretty(summary).map_err(|error| Error::write_failed(target, error))?;
    text.push(b'\n');
    Ok(vec![(SUMMARY.to_owned(), text), (MODES.to_owned(), table(&mode_columns(&sample.cells), target)?)])
}

fn table(columns: &[Column], target: &Path) -> Result<Vec<u8>> {
    Ok(encode(columns, Vec::new()).map_err(|error| Error::write_failed(target, error))?)
}
