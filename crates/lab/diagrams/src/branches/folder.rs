//! The folder of branches: `manifest.json`, `points.parquet`, `samples.parquet` if motions were sampled,
//! `summary.json`, and `branches.json`, from which the work goes on.

use super::result::Branches;
use super::summary::summary;
use super::table::{columns as table, sweep_columns};
use motiform_lab::draw::Picture;
use motiform_store::columns::{Column, encode};
use motiform_store::{Folder, Opening, end_of_work};
use motiform_study::plan::{Plan, pretty};
use motiform_study::{BranchPlan, Error, Provenance, Question, input};
use serde::{Deserialize, Serialize};
use std::path::Path;

const STATE: &str = "branches.json";

/// A folder that holds branches, as far as they are followed.
#[derive(Clone, Debug, PartialEq)]
pub struct BranchFolder {
    /// The plan.
    pub plan: BranchPlan,
    /// The results.
    pub found: Branches,
}

impl BranchFolder {
    /// Reads a folder.
    ///
    /// # Errors
    /// [`Error::NoResult`], [`Error::Store`] where a file is missing or damaged.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let plan = Provenance::read(path)?.plan;
        Ok(Self { plan, found: read(path, STATE)? })
    }

    /// Opens the folder of the branches of `plan` to write it, and reads what it holds of them, to go on with.
    ///
    /// # Errors
    /// [`Error::OtherPlan`] for another plan; [`Error::Store`] where it exists, is not ours, is used by
    /// others or cannot be written.
    pub fn open(
        path: &Path,
        plan: &BranchPlan,
        opening: Opening,
    ) -> Result<(Folder, Option<Branches>), Error> {
        open(plan, path, opening, STATE)
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
        let provenance = Provenance::new(&self.plan, Some(self.found.complete));
        put_table(folder, "points.parquet", &table(&self.plan, &self.found)?, &provenance)?;
        if let Some(sweeps) = &self.found.sweeps {
            put_table(folder, "samples.parquet", &sweep_columns(&self.plan, sweeps), &provenance)?;
        }
        folder.put("summary.json", &pretty(&summary(&self.plan, &self.found), folder.shown())?)?;
        keep(STATE, &self.found, folder)?;
        finish(folder, pictures, &provenance)
    }
}

/// Opens the folder of a plan to write it, and reads the state that an earlier run left, if there is any.
pub(crate) fn open<C: Question, T: for<'d> Deserialize<'d>>(
    plan: &Plan<C>,
    path: &Path,
    opening: Opening,
    state: &str,
) -> Result<(Folder, Option<T>), Error> {
    let (folder, earlier) = plan.open(path, opening, Some(false))?;
    if !earlier {
        return Ok((folder, None));
    }
    folder.check()?;
    let found = folder.read(state).map(|bytes| serde_json::from_slice(&bytes)).transpose();
    Ok((folder, found.map_err(|error| Error::unreadable(&path.join(state), error))?))
}

/// Writes a state from which the work can go on.
pub(crate) fn keep(name: &str, state: &impl Serialize, folder: &Folder) -> Result<(), Error> {
    let state = serde_json::to_vec(state).map_err(|error| Error::write_failed(folder.shown(), error))?;
    Ok(folder.put(name, &state)?)
}

/// Writes a table with its provenance.
pub(crate) fn put_table<C: Question>(
    folder: &Folder,
    name: &str,
    columns: &[Column],
    provenance: &Provenance<C>,
) -> Result<(), Error> {
    let bytes = encode(columns, provenance.metadata(folder.shown())?);
    Ok(folder.put(name, &bytes.map_err(|error| Error::write_failed(folder.shown(), error))?)?)
}

/// Writes the figures and, last, the manifest, which says whether the result is complete.
pub(crate) fn finish<C: Question>(
    folder: &Folder,
    pictures: &[Picture],
    provenance: &Provenance<C>,
) -> Result<(), Error> {
    for picture in pictures {
        folder.put(&picture.name, &picture.bytes)?;
    }
    let complete = provenance.complete == Some(true);
    if complete {
        end_of_work(folder);
    }
    folder.put(C::MANIFEST, &provenance.encode(folder.shown())?)?;
    Ok(if complete { folder.complete() } else { folder.settle() }?)
}

/// Reads a state.
pub(crate) fn read<T: for<'d> Deserialize<'d>>(folder: &Path, name: &str) -> Result<T, Error> {
    let path = folder.join(name);
    input::json(&path).map_err(|error| Error::unreadable(&path, error))
}
