//! Which motion is it? The decision, with its evidence.

mod verdict;

pub use verdict::{Attractor, Estimate, Regime, Spread, Verdict};
