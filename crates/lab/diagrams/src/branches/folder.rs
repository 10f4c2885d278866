//! The folder of branches: `manifest.json`, `points.parquet`, `samples.parquet` if motions were sampled,
//! `summary.json`, and `branches.json`, from which the work goes on. That of curves is alike.

use super::result::Branches;
use super::summary::summary;
use super::table::{columns as table, sweep_columns};
use motiform_lab::draw::Picture;
use motiform_store::columns::{Column, encode};
use motiform_store::{Folder, Opening, end_of_work};
use motiform_study::branches::BranchComputation;
use motiform_study::plan::{Plan, pretty};
use motiform_study::{BranchPlan, Error, Provenance, Question, input};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Results that are kept in a folder as far as they are found, so that the work can go on from there.
pub trait Kept: Serialize + for<'d> Deserialize<'d> {
    /// The question that they answer.
    type Question: Question;
    /// The file from which the work goes on.
    const STATE: &'static str;

    /// Rejects those in the folder at `path` that do not belong together.
    ///
    /// # Errors
    /// [`Error::Store`], naming the file.
    fn check(&self, _path: &Path) -> Result<(), Error> {
        Ok(())
    }

    /// Returns `true` if nothing is left to find.
    fn is_complete(&self) -> bool;

    /// Writes their tables and their summary.
    ///
    /// # Errors
    /// Files that cannot be written.
    fn put(&self, plan: &Plan<Self::Question>, folder: &Folder) -> Result<(), Error>;
}

/// A folder that holds results, as far as they are found.
#[derive(Clone, Debug, PartialEq)]
pub struct KeptFolder<T: Kept> {
    /// The plan.
    pub plan: Plan<T::Question>,
    /// The results.
    pub found: T,
}

/// A folder that holds branches.
pub type BranchFolder = KeptFolder<Branches>;

impl<T: Kept> KeptFolder<T> {
    /// Reads a folder.
    ///
    /// # Errors
    /// [`Error::NoResult`], [`Error::Store`] where a file is missing or damaged.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let plan = Provenance::read(path)?.plan;
        let found: T = read(path, T::STATE)?;
        found.check(path)?;
        Ok(Self { plan, found })
    }

    /// Opens the folder of the results of `plan` to write it, and reads what it holds of them, to go on with.
    ///
    /// # Errors
    /// [`Error::OtherPlan`] for another plan; [`Error::Store`] where it exists, is not ours, is used by
    /// others or cannot be written.
    pub fn open(
        path: &Path,
        plan: &Plan<T::Question>,
        opening: Opening,
    ) -> Result<(Folder, Option<T>), Error> {
        let (folder, earlier) = plan.open(path, opening, Some(false))?;
        if !earlier {
            return Ok((folder, None));
        }
        folder.check()?;
        let found = folder.read(T::STATE).map(|bytes| serde_json::from_slice(&bytes)).transpose();
        let found: Option<T> = found.map_err(|error| Error::unreadable(&path.join(T::STATE), error))?;
        found.iter().try_for_each(|found| found.check(path))?;
        Ok((folder, found))
    }

    /// Keeps results that are not all of them.
    ///
    /// # Errors
    /// They cannot be written.
    pub fn keep(found: &T, folder: &Folder) -> Result<(), Error> {
        keep(T::STATE, found, folder)
    }

    /// Writes everything.
    ///
    /// # Errors
    /// Files that cannot be written.
    pub fn write(&self, pictures: &[Picture], folder: &Folder) -> Result<(), Error> {
        self.found.put(&self.plan, folder)?;
        keep(T::STATE, &self.found, folder)?;
        finish(folder, pictures, &Provenance::new(&self.plan, Some(self.found.is_complete())))
    }
}

impl Kept for Branches {
    type Question = BranchComputation;
    const STATE: &'static str = "branches.json";

    fn is_complete(&self) -> bool {
        self.complete
    }

    fn put(&self, plan: &BranchPlan, folder: &Folder) -> Result<(), Error> {
        let provenance = Provenance::new(plan, Some(self.complete));
        put_table(folder, "points.parquet", &table(plan, self)?, &provenance)?;
        if let Some(sweeps) = &self.sweeps {
            put_table(folder, "samples.parquet", &sweep_columns(plan, sweeps), &provenance)?;
        }
        Ok(folder.put("summary.json", &pretty(&summary(plan, self), folder.shown())?)?)
    }
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
    let text = input::manifest(&path).map_err(|error| Error::unreadable(&path, error))?;
    serde_json::from_slice(text.as_bytes()).map_err(|error| Error::unreadable(&path, error))
}
