//! The folder of branches: `manifest.json`, `points.parquet`, `samples.parquet` if motions were sampled, `summary.json`, and `branches.json`, from which the work goes on.

use super::result::Branches;
use super::summary::summary;
use super::table::{columns as table, sweep_columns};
use motiform_lab::draw::Picture;
use motiform_store::mend;
use motiform_store::{Folder, Kind, Opening, columns, end_of_work};
use motiform_study::dataset::VERSION;
use motiform_study::{BranchPlan, Error, input};
use serde::{Deserialize, Serialize};
use std::path::Path;

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
    /// Reads a folder.
    ///
    /// # Errors
    /// [`Error::Store`] where a file is missing or damaged.
    pub fn read(path: &Path) -> Result<Self, Error> {
        mend(path)?;
        let manifest: Manifest = read(&path.join(MANIFEST))?;
        if manifest.branches.hash() != manifest.plan_hash {
            let path = path.join(MANIFEST);
            return Err(Error::unreadable(&path, "it was changed: its plan does not give its hash"));
        }
        Ok(Self { plan: manifest.branches, found: read(&path.join(STATE))? })
    }

    /// Opens the folder of the branches of `plan` to write it, and reads what it holds of them, to go on with.
    ///
    /// # Errors
    /// [`Error::OtherBranches`] for another plan; [`Error::Store`] where it exists, is not ours, is used by others or cannot be written.
    pub fn open(
        path: &Path,
        plan: &BranchPlan,
        opening: Opening,
    ) -> Result<(Folder, Option<Branches>), Error> {
        let same = |path: &Path| {
            let there: Manifest = read(&path.join(MANIFEST))?;
            Ok(there.branches.hash() == plan.hash())
        };
        let manifest = pretty(&manifest(plan, false), path)?;
        open(path, (Kind::Branches, opening), &manifest, same, STATE)
    }

    /// Keeps branches that are not all of them.
    ///
    /// # Errors
    /// They cannot be written.
    pub fn keep(found: &Branches, folder: &Folder) -> Result<(), Error> {
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
        let points = columns::encode(&table(&self.plan, &self.found)?, vec![("motiform", text.clone())]);
        folder.put("points.parquet", &points.map_err(|error| failed(error.to_string()))?)?;
        if let Some(sweeps) = &self.found.sweeps {
            let samples = columns::encode(&sweep_columns(&self.plan, sweeps), vec![("motiform", text)]);
            folder.put("samples.parquet", &samples.map_err(|error| failed(error.to_string()))?)?;
        }
        folder.put("summary.json", &pretty(&summary(&self.plan, &self.found), folder.shown())?)?;
        let state = serde_json::to_vec(&self.found).map_err(|error| failed(error.to_string()))?;
        finish(folder, (STATE, &state), pictures, &pretty(&manifest, folder.shown())?, self.found.complete)
    }
}

fn manifest(plan: &BranchPlan, complete: bool) -> Manifest {
    Manifest { motiform: VERSION.to_owned(), plan_hash: plan.hash(), complete, branches: plan.clone() }
}

/// Opens a folder of branches or curves to write it, and reads its state, if there is any.
pub(crate) fn open<T: for<'d> Deserialize<'d>>(
    path: &Path,
    (kind, opening): (Kind, Opening),
    manifest: &[u8],
    same: impl FnOnce(&Path) -> Result<bool, Error>,
    state: &str,
) -> Result<(Folder, Option<T>), Error> {
    if opening != Opening::Resume || !path.exists() {
        return Ok((Folder::open(path, kind, opening, &[(MANIFEST, manifest)])?, None));
    }
    mend(path)?;
    if !same(path)? {
        return Err(Error::OtherBranches { path: path.to_owned() });
    }
    let folder = Folder::resume(path, kind)?;
    folder.check()?;
    let found = folder.read(state).map(|bytes| serde_json::from_slice(&bytes)).transpose();
    Ok((folder, found.map_err(|error| Error::unreadable(&path.join(state), error))?))
}

/// Writes a state from which the work can go on.
pub(crate) fn keep(name: &str, state: &impl Serialize, folder: &Folder) -> Result<(), Error> {
    let state = serde_json::to_vec(state).map_err(|error| Error::write_failed(folder.shown(), error))?;
    Ok(folder.put(name, &state)?)
}

/// Writes the state, the figures and, last, the manifest, which says whether the result is complete.
pub(crate) fn finish(
    folder: &Folder,
    (name, state): (&str, &[u8]),
    pictures: &[Picture],
    manifest: &[u8],
    complete: bool,
) -> Result<(), Error> {
    folder.put(name, state)?;
    for picture in pictures {
        folder.put(&picture.name, &picture.bytes)?;
    }
    if complete {
        end_of_work(folder);
    }
    folder.put(MANIFEST, manifest)?;
    Ok(if complete { folder.complete() } else { folder.settle() }?)
}

pub(crate) fn pretty(value: &impl Serialize, target: &Path) -> Result<Vec<u8>, Error> {
    let mut json = serde_json::to_vec_pretty(value).map_err(|error| Error::write_failed(target, error))?;
    json.push(b'\n');
    Ok(json)
}

pub(crate) fn read<T: for<'d> Deserialize<'d>>(path: &Path) -> Result<T, Error> {
    let text = input::manifest(path).map_err(|error| {
        Error::unreadable(path, format!("{error}; give a folder written by `motiform continue`"))
    })?;
    serde_json::from_str(&text).map_err(|error| Error::unreadable(path, error))
}
