//! The folder of statistics: tables as Parquet, `statistics.json`, figures.

use crate::draw::FigureFormat;
use crate::statistics::{Measurement, Result, draw, summary, tables};
use motiform_store::mend;
use motiform_store::{Folder, Journal as _, Kind, Opening, WORK, columns, end_of_work};
use motiform_study::dataset::VERSION;
use motiform_study::plan::pretty;
use motiform_study::{Error, RunPlan};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::path::Path;

/// The file of the summary.
const FILE: &str = "statistics.json";

/// The file of the plan of bodies, by which results are compared.
const PLAN: &str = "plan.json";

/// Opens a folder of the statistics of so many bodies of a plan (`None`: of datasets), to write it or to go on with it.
///
/// # Errors
/// [`Error::OtherPlan`] where it holds those of another plan; [`Error::Store`] where it exists, is not ours,
/// is used by others or cannot be
/// written.
pub fn open(
    path: &Path,
    opening: Opening,
    bodies: Option<(&RunPlan, u64)>,
) -> std::result::Result<Folder, Error> {
    let asked =
        bodies.map(|(plan, count)| Asked { plan_hash: plan.hash(), plan: Some(plan.clone()), bodies: count });
    if let Some(asked) = asked.as_ref().filter(|_| opening == Opening::Resume) {
        mend(path)?;
        // Another plan is refused before anything is written.
        if let Some(there) = there(path).filter(|there| !there.is(asked)) {
            let (path, differences) = (path.to_owned(), there.differences(asked));
            return Err(Error::OtherPlan { path, kind: Kind::Statistics, differences });
        }
    }
    let folder = Folder::open(path, Kind::Statistics, opening, &[])?;
    folder.check()?;
    if let Some(asked) = asked {
        folder.finish(PLAN, &pretty(&asked, path)?)?;
    }
    Ok(folder)
}

/// The bodies that statistics are of.
#[derive(Serialize, Deserialize)]
struct Asked {
    plan_hash: String,
    /// Absent in what version 0.2.0 left unfinished.
    plan: Option<RunPlan>,
    bodies: u64,
}

impl Asked {
    fn is(&self, other: &Self) -> bool {
        self.plan_hash == other.plan_hash && self.bodies == other.bodies
    }

    fn differences(&self, asked: &Self) -> String {
        let plans = self.plan.as_ref().zip(asked.plan.as_ref());
        let plans =
            plans.map_or_else(|| "other settings".to_owned(), |(there, asked)| there.differences(asked));
        let bodies = format!("bodies: {} there, {} requested", self.bodies, asked.bodies);
        let said = [(plans, self.plan_hash != asked.plan_hash), (bodies, self.bodies != asked.bodies)];
        said.into_iter().filter_map(|(text, differs)| differs.then_some(text)).collect::<Vec<_>>().join("; ")
    }
}

/// The bodies of a folder: those that were begun, or those of its result.
fn there(path: &Path) -> Option<Asked> {
    let read = |name: &str| std::fs::read(path.join(name)).ok();
    let begun = read(&format!("{WORK}{PLAN}")).and_then(|bytes| serde_json::from_slice(&bytes).ok());
    let finished =
        || serde_json::from_value(serde_json::from_slice::<Value>(&read(FILE)?).ok()?["source"].take()).ok();
    begun.or_else(finished)
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
    for picture in draw(measurement, format)? {
        folder.put(&picture.name, &picture.bytes).map_err(Error::from)?;
    }
    folder.put(FILE, &pretty(&object, folder.shown())?).map_err(Error::from)?;
    if !measurement.complete {
        return Ok(folder.settle().map_err(Error::from)?);
    }
    end_of_work(folder);
    Ok(folder.complete().map_err(Error::from)?)
}
