//! Scans as data: axes of parameters, and the plan with all numbers that the rows depend on.

mod axis;
mod plan;
mod shard;
mod start;

pub use axis::{Axis, number};
pub use plan::{SCAN_FORMAT, ScanComputation, ScanPlan};
pub use shard::Shard;
