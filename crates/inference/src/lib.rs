//! From observed tracks of shape modes to amplitude equations.
mod chi_square;
mod definition;
mod error;
mod field;
mod filter;
mod fit;
mod handed;
mod identifiability;
mod library;
mod linear;
mod names;
mod observation;
mod scales;
mod subsets;

pub use definition::equations;
pub use error::{Error, Result};
pub use fit::{
    Coefficient, Ending, Estimate, Fit, Likelihood, Natural, Noise, Parameters, Settings, fit, fit_from, likelihood,
};
pub use handed::{HANDED_RATE, Handedness, Symmetry, handedness};
pub use identifiability::{Combination, EquationKnowledge, FIXED, FREE, Identifiability, Knowledge, identifiability};
pub use library::{Library, MOST_MODES, Term};
pub use names::paper;
pub use observation::{LEAST_FRAMES, OBSERVED, Observation, Track};
pub use scales::Scales;
pub use subsets::{Selection, Subset, Subsets, TIE, select, subsets};
