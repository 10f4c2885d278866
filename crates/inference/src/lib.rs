//! From observed tracks of shape modes to amplitude equations.
mod error;
mod field;
mod filter;
mod fit;
mod library;
mod linear;
mod observation;
mod scales;
mod subsets;

pub use error::{Error, Result};
pub use fit::{
    Coefficient, Ending, Estimate, Fit, Likelihood, Natural, Noise, Parameters, Settings, fit, fit_from, likelihood,
};
pub use library::{Library, MOST_MODES, Term};
pub use observation::{LEAST_FRAMES, OBSERVED, Observation, Track};
pub use scales::Scales;
pub use subsets::{Selection, Subset, Subsets, TIE, select, subsets};
