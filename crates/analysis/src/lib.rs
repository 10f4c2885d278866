//! Analysis: numbers that say what an orbit is. Samples in, values out; knows no model, no solver, no file.

mod error;
mod spectrum;

pub use error::{Error, Result};
pub use spectrum::{Spectrum, welch};
