//! The folder of statistics: tables as Parquet, `statistics.json`, figures.

use crate::draw::FigureFormat;
use crate::statistics::{Measurement, Result, draw, summary, tables};
use motiform_store::mend;
use motiform_store::{Folder, Journal as _, Kind, Opening, WORK, columns, end_of_work};
use motiform_study::dataset::VERSION;
use motiform_study::{Error, Plan};
use serde_json::{Value, json};
use std::path::Path;

/// The file of the summary.
const FILE: &str = "statistics.json";

/// The file with the plan of bodies, by which a folder is compared.
const PLAN: &str = "plan.json";

/// Opens a folder of the statistics of so many bodies of a plan (`None`: of datasets), to write it or to go on with it.
///
/// # Errors
/// [`Error::OtherBranches`] where it holds those of another plan; [`Error::Store`] where it exists, is not
/// ours, is used by others or cannot be written.
pub fn open(
    path: &Path,
    opening: Opening,
    bodies: Option<(&Plan, u64)>,
) -> std::result::Result<Folder, Error> {
    let asked = bodies.map(|(plan, count)| json!({ "plan_hash": plan.hash(), "bodies": count }));
    if let Some(asked) = asked.as_ref().filter(|_| opening == Opening::Resume) {
        mend(path)?;
        // Another plan is refused before anything is written.
        if there(path).is_some_and(|there| there != *asked) {
            return Err(Error::OtherBranches { path: path.to_owned() });
        }
    }
    let folder = Folder::open(path, Kind::Statistics, opening, &[])?;
    folder.check()?;
    if let Some(asked) = asked {
        folder.finish(PLAN, asked.to_string().as_bytes())?;
    }
    Ok(folder)
}

/// The bodies of a folder: those that were begun, or those of its result.
fn there(path: &Path) -> Option<Value> {
    let read = |name: &str| serde_json::from_slice::<Value>(&std::fs::read(path.join(name)).ok()?).ok();
    read(&format!("{WORK}{PLAN}")).or_else(|| {
        let source = &read(FILE)?["source"];
        Some(json!({ "plan_hash": source["plan_hash"], "bodies": source["bodies"] }))
    })
}

/// Writes tables, summary and figures into a folder. Of a complete result, nothing else is kept.
///
/// # Errors
/// Numbers that do not fit on an axis, files that cannot be written.
pub fn write(measurement: &Measurement, format: &FigureFormat, folder: &Folder) -> Result<()> {
    let failed = |error: String| Error::write_failed(folder.shown(), error);
    let mut object = summary(measurement);
    object["motiform"] = Value::from(VERSION);
    let source = serde_json::to_string(&object["source"]).map_err(|error| failed(error.to_string()))?;
    for table in tables(&measurement.statistics) {
        let bytes = columns::encode(&table.columns, vec![("motiform", source.clone())]);
        let bytes = bytes.map_err(|error| failed(error.to_string()))?;
        folder.put(&format!("{}.parquet", table.name), &bytes).map_err(Error::from)?;
    }
    let mut text = serde_json::to_vec_pretty(&object).map_err(|error| failed(error.to_string()))?;
    text.push(b'\n');
    for picture in draw(measurement, format)? {
        folder.put(&picture.name, &picture.bytes).map_err(Error::from)?;
    }
    folder.put(FILE, &text).map_err(Error::from)?;
    if !measurement.complete {
        return Ok(folder.settle().map_err(Error::from)?);
    }
    end_of_work(folder);
    Ok(folder.complete().map_err(Error::from)?)
}
