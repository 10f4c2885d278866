//! Analysis: numbers that say what an orbit is. Samples in, values out; knows no model, no solver, no file.

mod batch_means;
mod checks;
pub mod equilibrium;
mod error;
mod linear;
pub mod lyapunov;
pub mod periodic;
pub mod regime;
mod spectrum;
pub mod symmetry;

pub use batch_means::{Estimate, batch_means};
pub use equilibrium::RelativeEquilibrium;
pub use error::{Error, Result};
pub use lyapunov::{Lyapunov, LyapunovSettings, lyapunov};
pub use periodic::PeriodicOrbit;
pub use regime::{Attractor, Regime, Spread, Verdict};
pub use spectrum::{Spectrum, welch};
