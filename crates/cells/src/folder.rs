//! The folder of a result: `summary.json`, `modes.parquet`, and for fits `coefficients.parquet` and a study file per cell.

use crate::provenance::study_file;
use crate::work::MANIFEST;
use crate::{
    CellFit, FitOptions, Observation, Result, Sample, coefficient_columns, file_names, fits_json,
    mode_columns, observations_json,
};
use motiform_files::Staging;
use motiform_files::columns::{Column, encode};
use motiform_study::Error;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// What shows that a folder is one of these.
pub(crate) const SUMMARY: &str = "summary.json";
pub(crate) const MODES: &str = "modes.parquet";

/// Names of the folders of results.
#[derive(Debug, Clone, Copy)]
pub struct FitFolder;

impl FitFolder {
    /// Whether a folder was written by `motiform fit` or `motiform observe`.
    #[must_use]
    pub fn is_one(path: &Path) -> bool {
        path.join(MANIFEST).is_file() || (path.join(SUMMARY).is_file() && path.join(MODES).is_file())
    }
}

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
        let Ok(fitted) = &fit.fitted else { continue };
        files.push((format!("{name}.toml"), study_file(sample, fit, fitted, options)?.into_bytes()));
    }
    Ok(files)
}

/// Writes observations, beside what was written before, such as pages. Returns the folder.
///
/// # Errors
/// Files that cannot be written.
pub fn write_observations(sample: &Sample, found: &[Observation], staging: Staging) -> Result<PathBuf> {
    for (name, bytes) in &common(sample, &observations_json(sample, found), staging.target())? {
        staging.write(name, bytes)?;
    }
    Ok(staging.commit()?)
}

/// What both kinds of results have.
fn common(sample: &Sample, summary: &Value, target: &Path) -> Result<Vec<(String, Vec<u8>)>> {
    let mut text = serde_json::to_vec_pretty(summary).map_err(|error| Error::write_failed(target, error))?;
    text.push(b'\n');
    Ok(vec![(SUMMARY.to_owned(), text), (MODES.to_owned(), table(&mode_columns(&sample.cells), target)?)])
}

fn table(columns: &[Column], target: &Path) -> Result<Vec<u8>> {
    Ok(encode(columns, Vec::new()).map_err(|error| Error::write_failed(target, error))?)
}
