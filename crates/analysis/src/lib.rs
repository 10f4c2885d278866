//! Analysis: numbers that say what an orbit is. Samples in, values out; knows no model, no solver, no file.

mod error;
pub mod regime;
mod spectrum;

pub use error::{Error, Result};
pub use regime::{Attractor, Estimate, Regime, Spread, Verdict};
pub use spectrum::{Spectrum, welch};
