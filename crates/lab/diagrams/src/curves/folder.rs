//! The folder of curves: `manifest.json`, `points.parquet`, `summary.json`, and `curves.json`, from which the
//! work goes on.

use super::result::Curves;
use super::summary::curve_summary;
use super::table::curve_columns;
use crate::branches::folder::{Kept, KeptFolder, put_table};
use motiform_store::Folder;
use motiform_study::curves::CurveComputation;
use motiform_study::plan::pretty;
use motiform_study::{CurvePlan, Error, Provenance};
use std::path::Path;

/// A folder that holds curves.
pub type CurveFolder = KeptFolder<Curves>;

impl Kept for Curves {
    type Question = CurveComputation;
    const STATE: &'static str = "curves.json";

    /// Rejects curves that start nowhere on their branches.
    fn check(&self, path: &Path) -> Result<(), Error> {
        match self.curves.iter().any(|curve| self.branches.at(curve.start).is_none()) {
            true => Err(Error::unreadable(&path.join(Self::STATE), "a curve starts at no point of a branch")),
            false => Ok(()),
        }
    }

    fn is_complete(&self) -> bool {
        self.complete
    }

    fn put(&self, plan: &CurvePlan, folder: &Folder) -> Result<(), Error> {
        let provenance = Provenance::new(plan, Some(self.complete));
        put_table(folder, "points.parquet", &curve_columns(plan, self)?, &provenance)?;
        Ok(folder.put("summary.json", &pretty(&curve_summary(plan, self), folder.shown())?)?)
    }
}
