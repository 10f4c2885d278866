//! The folder of statistics: tables as Parquet, `statistics.json`, figures.

use crate::{Measurement, Result, draw, summary, tables};
use motiform_files::{Staging, columns};
use motiform_lab::draw::FigureFormat;
use motiform_study::Error;
use motiform_study::dataset::VERSION;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// The file that marks a folder of statistics.
const FILE: &str = "statistics.json";

/// Whether a folder holds statistics.
#[must_use]
pub fn is_one(path: &Path) -> bool {
    path.join(FILE).is_file()
}

/// Writes tables, summary and figures into a staged folder and gives it its name, which is returned.
///
/// # Errors
/// Numbers that do not fit on an axis, files that cannot be written.
pub fn write(measurement: &Measurement, format: &FigureFormat, staging: Staging) -> Result<PathBuf> {
    let failed = |error: String| Error::write_failed(staging.target(), error);
    let mut object = summary(measurement);
    object["motiform"] = Value::from(VERSION);
    let source = serde_json::to_string(&object["source"]).map_err(|error| failed(error.to_string()))?;
    for table in tables(&measurement.statistics) {
        let bytes = columns::encode(&table.columns, vec![("motiform", source.clone())]);
        let bytes = bytes.map_err(|error| failed(error.to_string()))?;
        staging.write(&format!("{}.parquet", table.name), &bytes)?;
    }
    let mut text = serde_json::to_vec_pretty(&object).map_err(|error| failed(error.to_string()))?;
    text.push(b'\n');
    staging.write(FILE, &text)?;
    for picture in draw(measurement, format)? {
        staging.write(&picture.name, &picture.bytes)?;
    }
    Ok(staging.commit()?)
}
