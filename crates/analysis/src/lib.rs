//! Analysis: numbers that say what an orbit is. Samples in, values out; knows no model, no solver, no file.

mod batch_means;
mod checks;
mod error;
mod spectrum;

pub use batch_means::{Estimate, batch_means};
pub use error::{Error, Result};
pub use spectrum::{Spectrum, welch};
