//! Analysis: numbers that say what an orbit is. Samples in, values out; knows no model, no solver, no file.

mod batch_means;
mod checks;
mod error;
mod escape;
mod legs;
mod rests;
mod returns;
mod spectrum;
mod zero_one;

pub use batch_means::{Estimate, batch_means};
pub use error::{Error, Result};
pub use escape::{EscapeRate, Stay, SurvivalStep, escape_rate, survival};
pub use legs::{CornerKind, Ends, Leg, Legs, PathSample, legs};
pub use rests::{Rest, Rests, rests};
pub use returns::{Dimension, correlation_dimension, return_pairs};
pub use spectrum::{Spectrum, welch};
pub use zero_one::{ZeroOne, zero_one};
