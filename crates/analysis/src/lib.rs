//! Analysis: numbers that say what an orbit is. Samples in, values out; knows no model, no solver, no file.

pub mod equilibrium;
mod error;
mod linear;
pub mod regime;
mod spectrum;
pub mod symmetry;

pub use equilibrium::RelativeEquilibrium;
pub use error::{Error, Result};
pub use regime::{Attractor, Estimate, Regime, Spread, Verdict};
pub use spectrum::{Spectrum, welch};
