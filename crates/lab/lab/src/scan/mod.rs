//! Scans: a model over one or two axes of parameters, several initial states per cell, each evaluated to a verdict.
//!
//! [`ScanPlan`] -> [`Scan`] (a folder being computed) -> [`ScanFolder`] (read) -> [`Totals`], [`CellSummary`].
//!
//! A scan is a list of *rows*, one per cell and initial state. A row is determined by the plan and its
//! number alone, so threads, shards, kills and resumes do not change its bits. Rows are stored in *parts*: complete files, determined by
//! the plan, each with the hash of the plan and a digest of its own bytes.

mod evaluate;
mod folder;
mod lanes;
mod merge;
mod part;
mod queue;
mod reasons;
mod rows;
mod run;
mod summary;
mod table;
mod work;

pub use evaluate::{Classify, Done, Evaluate};
pub use folder::{ScanFolder, ScanManifest};
pub use merge::{Merged, merge};
pub use motiform_store::Opening;
pub use motiform_study::scan::{Axis, SCAN_FORMAT, ScanComputation, ScanPlan, Shard};
pub use part::{PartError, Parts, read_part};
pub use reasons::Reasons;
pub use rows::{NUMBERS, Row, rows_to_csv};
pub use run::Scan;
pub use summary::{CellSummary, Motion, Totals, cells, for_each_part, motion_mark};
pub use table::ScanTable;
pub use work::{Ended, Store, compute, rows_at, rows_of};
