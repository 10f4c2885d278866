//! The folder of a result: `summary.json`, `modes.parquet`, and for fits `coefficients.parquet` and a study file per cell.

use crate::{
    CellFit, Observation, Result, Sample, coefficient_columns, fits_json, mode_columns, observations_json,
};
use motiform_files::Staging;
use motiform_files::columns::{Column, encode};
use motiform_study::Error;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// What shows that a folder is one of these.
const SUMMARY: &str = "summary.json";
const MODES: &str = "modes.parquet";

/// Names of the folders of results.
#[derive(Debug, Clone, Copy)]
pub struct FitFolder;

impl FitFolder {
    /// Whether a folder was written by `motiform fit` or `motiform observe`.
    #[must_use]
    pub fn is_one(path: &Path) -> bool {
        path.join(SUMMARY).is_file() && path.join(MODES).is_file()
    }
}

/// Writes fits. Returns the folder.
///
/// # Errors
/// Files that cannot be written.
pub fn write_fits(sample: &Sample, fits: &[CellFit], staging: Staging) -> Result<PathBuf> {
    common(sample, &fits_json(sample, fits), &staging)?;
    table("coefficients.parquet", &coefficient_columns(fits), &staging)?;
    let mut names: Vec<String> = Vec::new();
    for fit in fits {
        let Ok(fitted) = &fit.fitted else { continue };
        let name = unique(&fit.name, &mut names);
        staging.write(&format!("{name}.toml"), fitted.study(&fit.name)?.to_toml()?.as_bytes())?;
    }
    Ok(staging.commit()?)
}

/// Writes observations. Returns the folder.
///
/// # Errors
/// Files that cannot be written.
pub fn write_observations(sample: &Sample, found: &[Observation], staging: Staging) -> Result<PathBuf> {
    common(sample, &observations_json(sample, found), &staging)?;
    Ok(staging.commit()?)
}

fn common(sample: &Sample, summary: &Value, staging: &Staging) -> Result<()> {
    let mut text =
        serde_json::to_vec_pretty(summary).map_err(|error| Error::write_failed(staging.target(), error))?;
    text.push(b'\n');
    staging.write(SUMMARY, &text)?;
    table(MODES, &mode_columns(&sample.cells), staging)
}

fn table(name: &str, columns: &[Column], staging: &Staging) -> Result<()> {
    let bytes = encode(columns, Vec::new()).map_err(|error| Error::write_failed(staging.target(), error))?;
    Ok(staging.write(name, &bytes)?)
}

/// A name for a file: `cell-` and letters, digits, `-`, `_` of the cell's name; a number where it is taken.
fn unique(cell: &str, names: &mut Vec<String>) -> String {
    let plain: String =
        cell.chars().map(|c| if c.is_ascii_alphanumeric() || "-_".contains(c) { c } else { '-' }).collect();
    let base = format!("cell-{plain}");
    let taken = |name: &String| names.contains(name);
    let mut numbered = (2..).map(|number| format!("{base}-{number}"));
    let name = if taken(&base) { numbered.find(|name| !names.contains(name)).unwrap_or(base) } else { base };
    names.push(name.clone());
    name
}
