//! The folder of curves: `manifest.json`, `points.parquet`, `summary.json`, and `curves.json`, from which the
//! work goes on.

use super::result::Curves;
use super::summary::curve_summary;
use super::table::curve_columns;
use crate::branches::folder::{finish, keep, open, put_table, read};
use motiform_lab::draw::Picture;
use motiform_store::{Folder, Opening};
use motiform_study::plan::pretty;
use motiform_study::{CurvePlan, Error, Provenance};
use std::path::Path;

const STATE: &str = "curves.json";

/// A folder that holds curves, as far as they are followed.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveFolder {
    /// The plan.
    pub plan: CurvePlan,
    /// The results.
    pub found: Curves,
}

impl CurveFolder {
    /// Reads a folder.
    ///
    /// # Errors
    /// [`Error::NoResult`], [`Error::Store`] where a file is missing or damaged.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let plan = Provenance::read(path)?.plan;
        let found: Curves = read(path, STATE)?;
        check_starts(path, &found)?;
        Ok(Self { plan, found })
    }

    /// Opens the folder of the curves of `plan` to write it, and reads what it holds of them, to go on with.
    ///
    /// # Errors
    /// [`Error::OtherPlan`] for another plan; [`Error::Store`] where it exists, is not ours, is used by
    /// others or cannot be written.
    pub fn open(path: &Path, plan: &CurvePlan, opening: Opening) -> Result<(Folder, Option<Curves>), Error> {
        let (folder, found) = open(plan, path, opening, STATE)?;
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
        let provenance = Provenance::new(&self.plan, Some(self.found.complete));
        put_table(folder, "points.parquet", &curve_columns(&self.plan, &self.found)?, &provenance)?;
        folder.put("summary.json", &pretty(&curve_summary(&self.plan, &self.found), folder.shown())?)?;
        keep(STATE, &self.found, folder)?;
        finish(folder, pictures, &provenance)
    }
}

/// Rejects curves that start nowhere on their branches.
fn check_starts(path: &Path, found: &Curves) -> Result<(), Error> {
    match found.curves.iter().any(|curve| found.branches.at(curve.start).is_none()) {
        true => Err(Error::unreadable(&path.join(STATE), "a curve starts at no point of a branch")),
        false => Ok(()),
    }
}
