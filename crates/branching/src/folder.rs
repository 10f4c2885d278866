//! The folder of branches: `manifest.json`, `points.parquet`, `samples.parquet` if motions were sampled, `summary.json`, and `branches.json`, from which the work goes on.

use super::follow::Branches;
use super::summary::summary;
use super::table::{columns as table, sweep_columns};
use motiform_files::{Staging, columns};
use motiform_lab::draw::Picture;
use motiform_study::dataset::VERSION;
use motiform_study::{BranchPlan, Error, input};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

pub(crate) const MANIFEST: &str = "manifest.json";
const STATE: &str = "branches.json";

/// Provenance of branches. Knows no host, no user, no time of day.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Manifest {
    motiform: String,
    plan_hash: String,
    complete: bool,
    branches: BranchPlan,
}

/// A folder that holds branches, as far as they are followed.
#[derive(Clone, Debug, PartialEq)]
pub struct BranchFolder {
    /// What was asked for.
    pub plan: BranchPlan,
    /// What was found.
    pub found: Branches,
}

/// The folder of branches whose place is not given.
#[must_use]
pub fn default_folder(plan: &BranchPlan) -> String {
    let model = &plan.computation.start.model;
    if plan.name == model.as_str() {
        format!("{model}-branches")
    } else {
        format!("{model}-{}-branches", plan.name)
    }
}

impl BranchFolder {
    /// Whether a folder holds branches.
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
        if manifest.branches.hash() != manifest.plan_hash {
            let path = path.join(MANIFEST);
            return Err(Error::unreadable(&path, "it was changed: its plan does not give its hash"));
        }
        Ok(Self { plan: manifest.branches, found: read(&path.join(STATE))? })
    }

    /// Reads what a folder holds of the branches of `plan`, to go on with; `None` if there is no folder.
    ///
    /// # Errors
    /// [`Error::OtherBranches`] for another plan, [`Error::Unreadable`].
    pub fn resume(path: &Path, plan: &BranchPlan) -> Result<Option<Branches>, Error> {
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
            branches: self.plan.clone(),
        };
        let text = serde_json::to_string(&manifest).map_err(|error| failed(error.to_string()))?;
        let points = columns::encode(&table(&self.plan, &self.found)?, vec![("motiform", text)]);
        staging.write("points.parquet", &points.map_err(|error| failed(error.to_string()))?)?;
        if let Some(sweeps) = &self.found.sweeps {
            let text = serde_json::to_string(&manifest).map_err(|error| failed(error.to_string()))?;
            let samples = columns::encode(&sweep_columns(&self.plan, sweeps), vec![("motiform", text)]);
            staging.write("samples.parquet", &samples.map_err(|error| failed(error.to_string()))?)?;
        }
        staging.write(MANIFEST, &pretty(&manifest, &staging)?)?;
        staging.write("summary.json", &pretty(&summary(&self.plan, &self.found), &staging)?)?;
        let state = serde_json::to_vec(&self.found).map_err(|error| failed(error.to_string()))?;
        staging.write(STATE, &state)?;
        for picture in pictures {
            staging.write(&picture.name, &picture.bytes)?;
        }
        staging.commit()
    }
}

pub(crate) fn pretty(value: &impl Serialize, staging: &Staging) -> Result<Vec<u8>, Error> {
    let mut json =
        serde_json::to_vec_pretty(value).map_err(|error| Error::write_failed(staging.target(), error))?;
    json.push(b'\n');
    Ok(json)
}

pub(crate) fn read<T: for<'d> Deserialize<'d>>(path: &Path) -> Result<T, Error> {
    let text = input::manifest(path).map_err(|error| {
        Error::unreadable(path, format!("{error}; give a folder written by `motiform continue`"))
    })?;
    serde_json::from_str(&text).map_err(|error| Error::unreadable(path, error))
}
