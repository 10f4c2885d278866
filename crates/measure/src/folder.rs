//! The folder of statistics: tables as Parquet, `statistics.json`, figures.

use crate::{Measurement, Result, draw, summary, tables};
use motiform_files::{Staged, columns};
use motiform_lab::draw::FigureFormat;
use motiform_study::Error;
use motiform_study::dataset::VERSION;
use serde_json::Value;
use std::path::PathBuf;

/// The file of the summary.
const FILE: &str = "statistics.json";

/// Writes tables, summary and figures into a staged folder and gives it its name, which is returned, with what stayed there, in sentences.
///
/// # Errors
/// Numbers that do not fit on an axis, files that cannot be written.
pub fn write(
    measurement: &Measurement,
    format: &FigureFormat,
    staged: Staged,
) -> Result<(PathBuf, Vec<String>)> {
    let failed = |error: String| Error::write_failed(staged.target(), error);
    let mut object = summary(measurement);
    object["motiform"] = Value::from(VERSION);
    let source = serde_json::to_string(&object["source"]).map_err(|error| failed(error.to_string()))?;
    for table in tables(&measurement.statistics) {
        let bytes = columns::encode(&table.columns, vec![("motiform", source.clone())]);
        let bytes = bytes.map_err(|error| failed(error.to_string()))?;
        staged.write(&format!("{}.parquet", table.name), &bytes).map_err(Error::from)?;
    }
    let mut text = serde_json::to_vec_pretty(&object).map_err(|error| failed(error.to_string()))?;
    text.push(b'\n');
    staged.write(FILE, &text).map_err(Error::from)?;
    for picture in draw(measurement, format)? {
        staged.write(&picture.name, &picture.bytes).map_err(Error::from)?;
    }
    Ok(staged.commit().map_err(Error::from)?)
}
