//! Studies: file -> [`Study`] -> [`Plan`] -> [`Dataset`] -> figure. One function per arrow; the same verbs serve the
//! command line, Python and the explorer.

pub mod analyse;
pub mod dataset;
pub mod draw;
mod error;
pub mod fields;
pub mod figures;
pub mod files;
mod initial;
pub mod plan;
pub mod presets;
pub mod report;
pub mod reproduction;
pub mod saddle;
pub mod scan;
pub mod simulate;
pub mod study;
pub mod table;
mod toml_reader;

pub use dataset::{Dataset, Manifest};
pub use error::Error;
pub use plan::Plan;
pub use scan::ScanPlan;
pub use study::Study;
