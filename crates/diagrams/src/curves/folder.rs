//! The folder of curves: `manifest.json`, `points.parquet`, `summary.json`, and `curves.json`, from which the work goes on.

use super::follow::Curves;
use super::summary::curve_summary;
use super::table::curve_columns;
use crate::branches::folder::{MANIFEST, finish, keep, open, pretty, read};
use motiform_lab::draw::Picture;
use motiform_store::mend;
use motiform_store::{Folder, Kind, Opening, columns};
use motiform_study::dataset::VERSION;
use motiform_study::{CurvePlan, Error};
use serde::{Deserialize, Serialize};
use std::path::Path;

const STATE: &str = "curves.json";

/// Provenance of curves. Knows no host, no user, no time of day.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Manifest {
    motiform: String,
    plan_hash: String,
    complete: bool,
    curves: CurvePlan,
}

/// A folder that holds curves, as far as they are followed.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveFolder {
    /// What was asked for.
    pub plan: CurvePlan,
    /// What was found.
    pub found: Curves,
}

/// The folder of curves whose place is not given.
#[must_use]
pub fn default_curve_folder(plan: &CurvePlan) -> String {
    let model = &plan.computation.branches.start.model;
    if plan.name == model.as_str() {
        format!("{model}-curves")
    } else {
        format!("{model}-{}-curves", plan.name)
    }
}

impl CurveFolder {
    /// Reads a folder.
    ///
    /// # Errors
    /// [`Error::Store`] where a file is missing or damaged.
    pub fn read(path: &Path) -> Result<Self, Error> {
        mend(path)?;
        let manifest: Manifest = read(&path.join(MANIFEST))?;
        if manifest.curves.hash() != manifest.plan_hash {
            let path = path.join(MANIFEST);
            return Err(Error::unreadable(&path, "it was changed: its plan does not give its hash"));
        }
        let found: Curves = read(&path.join(STATE))?;
        check_starts(path, &found)?;
        Ok(Self { plan: manifest.curves, found })
    }

    /// Opens the folder of the curves of `plan` to write it, and reads what it holds of them, to go on with.
    ///
    /// # Errors
    /// [`Error::OtherBranches`] for another plan; [`Error::Store`] where it exists, is not ours, is used by others or cannot be written.
    pub fn open(path: &Path, plan: &CurvePlan, opening: Opening) -> Result<(Folder, Option<Curves>), Error> {
        let same = |path: &Path| {
            let there: Manifest = read(&path.join(MANIFEST))?;
            Ok(there.curves.hash() == plan.hash())
        };
        let manifest = pretty(&manifest(plan, false), path)?;
        let (folder, found) = open(path, (Kind::Curves, opening), &manifest, same, STATE)?;
        if let Some(found) = &found {
            check_starts(path, found)?;
        }
        Ok((folder, found))
    }

    /// Keeps branches and curves that are not all of them.
    ///
    /// # Errors
    /// They cannot be written.
    pub fn keep(found: &Curves, folder: &Folder) -> Result<(), Error> {
        keep(STATE, found, folder)
    }

    /// Writes everything.
    ///
    /// # Errors
    /// Files that cannot be written.
    pub fn write(&self, pictures: &[Picture], folder: &Folder) -> Result<(), Error> {
        let failed = |error: String| Error::write_failed(folder.shown(), error);
        let manifest = manifest(&self.plan, self.found.complete);
        let text = serde_json::to_string(&manifest).map_err(|error| failed(error.to_string()))?;
        let points = columns::encode(&curve_columns(&self.plan, &self.found)?, vec![("motiform", text)]);
        folder.put("points.parquet", &points.map_err(|error| failed(error.to_string()))?)?;
        folder.put("summary.json", &pretty(&curve_summary(&self.plan, &self.found), folder.shown())?)?;
        let state = serde_json::to_vec(&self.found).map_err(|error| failed(error.to_string()))?;
        finish(folder, (STATE, &state), pictures, &pretty(&manifest, folder.shown())?, self.found.complete)
    }
}

fn manifest(plan: &CurvePlan, complete: bool) -> Manifest {
    Manifest { motiform: VERSION.to_owned(), plan_hash: plan.hash(), complete, curves: plan.clone() }
}

/// Rejects curves that start nowhere on their branches.
fn check_starts(path: &Path, found: &Curves) -> Result<(), Error> {
    match found.curves.iter().any(|curve| found.branches.at(curve.start).is_none()) {
        true => Err(Error::unreadable(&path.join(STATE), "a curve starts at no point of a branch")),
        false => Ok(()),
    }
}
