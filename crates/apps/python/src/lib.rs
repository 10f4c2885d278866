//! The native module of the Python package `motiform`: it parses and calls; the work is done by `motiform-lab`.
//!
//! Everything here is private to the package (`motiform._motiform`); the public interface is in `python/motiform`.

#![allow(clippy::needless_pass_by_value, reason = "PyO3 hands arguments over by value")]

mod analyse;
mod atlas;
mod branches;
mod cells;
mod chunks;
mod curves;
mod ensemble;
mod errors;
mod field;
mod flow;
mod foreign;
mod lifetimes;
mod read;
mod registry;
mod run;
mod scan_files;
mod scan_plan;
mod statistics;
mod study;
mod units;
mod verify;
mod watch;

use pyo3::prelude::*;

/// The native half of `motiform`.
#[pymodule]
mod _motiform {
    #[pymodule_export]
    use super::analyse::{classify, equilibria, lyapunov, motions, section};
    #[pymodule_export]
    use super::atlas::{Atlas, make_atlas, read_atlas};
    #[pymodule_export]
    use super::branches::{follow_branches, read_branches};
    #[pymodule_export]
    use super::cells::Sample;
    #[pymodule_export]
    use super::chunks::Chunks;
    #[pymodule_export]
    use super::curves::{follow, read_curves};
    #[pymodule_export]
    use super::ensemble::{ensemble, random_starts};
    #[pymodule_export]
    use super::field::Field;
    #[pymodule_export]
    use super::flow::Flow;
    #[pymodule_export]
    use super::lifetimes::lifetimes;
    #[pymodule_export]
    use super::read::{read_fields, read_run, read_scan, read_table};
    #[pymodule_export]
    use super::registry::{quantities, registry};
    #[pymodule_export]
    use super::run::{Run, seconds_of_run, simulate};
    #[pymodule_export]
    use super::scan_files::{ScanFiles, merge};
    #[pymodule_export]
    use super::scan_plan::ScanPlan;
    #[pymodule_export]
    use super::statistics::{samples_apart, statistics, statistics_of};
    #[pymodule_export]
    use super::study::Study;
    #[pymodule_export]
    use super::units::Units;
    #[pymodule_export]
    use super::verify::verify;
}
