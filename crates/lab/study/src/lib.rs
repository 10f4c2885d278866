//! Studies as data: a file or a preset -> [`Study`] (as typed) -> [`Plan`] of a run, a scan, branches, curves or an atlas
//! (explicit, checked, hashed). A run produces a
//! [`Dataset`]: tables, and a manifest with their provenance.
//!
//! This crate does not compute, draw or write.

mod amplitudes;
pub mod atlas;
pub mod branches;
mod checks;
mod control;
pub mod curves;
pub mod dataset;
mod described;
mod ending;
mod error;
mod follow_settings;
mod given;
pub mod initial;
pub mod input;
mod named;
mod perturbation;
mod plain;
pub mod plan;
pub mod presets;
mod random;
mod remarks;
mod run_settings;
mod scales;
pub mod scan;
mod stride;
pub mod study;
mod study_reader;
mod study_toml;
mod ties;
pub mod titles;
mod toml_reader;
pub mod units;
mod written;

pub use atlas::AtlasPlan;
pub use branches::BranchPlan;
pub use curves::CurvePlan;
pub use dataset::{Dataset, Manifest};
pub use described::{Key, Settings};
pub use ending::Ending;
pub use error::Error;
pub use given::Given;
pub use motiform_store::counted;
pub use motiform_store::{Dimension, Quantity, quantity};
pub use perturbation::Perturbation;
pub use plan::{Plan, Provenance, Question, RunPlan};
pub use random::Random;
pub use remarks::{idle_ties, remarks};
pub use scales::Scales;
pub use scan::ScanPlan;
pub use stride::{DOUBLINGS, Stride, Towards};
pub use study::Study;
pub use ties::Ties;
pub use units::{Shown, UnitSettings};
