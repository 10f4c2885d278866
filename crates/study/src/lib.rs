//! Studies: file -> [`Study`] -> [`Plan`] -> [`Dataset`] -> figure. One function per arrow; the same verbs serve the
//! command line, Python and the explorer.

pub mod analyse;
pub mod dataset;
pub mod draw;
mod ending;
pub mod equilibria;
mod error;
pub mod fields;
pub mod files;
pub mod flow;
mod initial;
pub mod live;
mod named;
pub mod naming;
mod perturbation;
pub mod plan;
pub mod presets;
mod random;
mod readings;
pub mod registry;
pub mod report;
pub mod reproduction;
mod run_settings;
pub mod saddle;
pub mod samples;
pub mod scan;
pub mod section;
pub mod simulate;
pub mod study;
mod study_toml;
pub mod table;
mod titles;
mod toml_reader;

pub use dataset::{Dataset, Manifest};
pub use ending::Ending;
pub use error::Error;
pub use perturbation::Perturbation;
pub use plan::Plan;
pub use random::Random;
pub use scan::ScanPlan;
pub use study::Study;
