//! The folder of curves: `manifest.json`, `points.parquet`, `summary.json`, and `curves.json`, from which the work goes on.

use super::follow::Curves;
use super::summary::curve_summary;
use super::table::curve_columns;
use crate::folder::{MANIFEST, pretty, read};
use motiform_files::{Staging, columns};
use motiform_lab::draw::Picture;
use motiform_study::dataset::VERSION;
use motiform_study::{CurvePlan, Error};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

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
    /// Whether a folder holds curves.
    #[must_use]
    pub fn is_one(path: &Path) -> bool {
        path.join(STATE).is_file() && path.join(MANIFEST).is_file()
    }

    /// Reads a folder.
    ///
    /// # Errors
    /// [`Error::Unreadable`] where a file is missing or damaged.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let manifest: Manifest = read(&path.join(MANIFEST))?;
        if manifest.curves.hash() != manifest.plan_hash {
            let path = path.join(MANIFEST);
            return Err(Error::unreadable(&path, "it was changed: its plan does not give its hash"));
        }
        let found: Curves = read(&path.join(STATE))?;
        if found.curves.iter().any(|curve| found.branches.at(curve.start).is_none()) {
            return Err(Error::unreadable(&path.join(STATE), "a curve starts at no point of a branch"));
        }
        Ok(Self { plan: manifest.curves, found })
    }

    /// Reads what a folder holds of the curves of `plan`, to go on with; `None` if there is no folder.
    ///
    /// # Errors
    /// [`Error::OtherBranches`] for another plan, [`Error::Unreadable`].
    pub fn resume(path: &Path, plan: &CurvePlan) -> Result<Option<Curves>, Error> {
        if path.symlink_metadata().is_err() {
            return Ok(None);
        }
        let there = Self::read(path)?;
        if there.plan.hash() != plan.hash() {
            return Err(Error::OtherBranches { path: path.to_owned() });
        }
        Ok(Some(there.found))
    }

    /// Writes everything into a staged folder and gives it its name, which is returned.
    ///
    /// # Errors
    /// [`Error::WriteFailed`].
    pub fn write(&self, pictures: &[Picture], staging: Staging) -> Result<PathBuf, Error> {
        let failed = |error: String| Error::write_failed(staging.target(), error);
        let manifest = Manifest {
            motiform: VERSION.to_owned(),
            plan_hash: self.plan.hash(),
            complete: self.found.complete,
            curves: self.plan.clone(),
        };
        let text = serde_json::to_string(&manifest).map_err(|error| failed(error.to_string()))?;
        let points = columns::encode(&curve_columns(&self.plan, &self.found)?, vec![("motiform", text)]);
        staging.write("points.parquet", &points.map_err(|error| failed(error.to_string()))?)?;
        staging.write(MANIFEST, &pretty(&manifest, &staging)?)?;
        staging.write("summary.json", &pretty(&curve_summary(&self.plan, &self.found), &staging)?)?;
        let state = serde_json::to_vec(&self.found).map_err(|error| failed(error.to_string()))?;
        staging.write(STATE, &state)?;
        for picture in pictures {
            staging.write(&picture.name, &picture.bytes)?;
        }
        staging.commit()
    }
}
