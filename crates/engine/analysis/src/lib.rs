//! Analysis: what a motion is, decided by mathematics. Knows no model by name, and no file.
//!
//! Two kinds of question. Those asked of a **body** ([`motiform_dynamics::Equivariant`]): [`symmetry`], [`equilibrium`],
//! [`periodic`], [`mod@lyapunov`], and [`regime`], which asks them all and names the motion. And those asked of **samples**:
//! spectra, means with errors, legs, rests, returns, escapes.

mod checks;
pub mod equilibrium;
mod error;
mod escape;
mod estimate;
mod gauge;
mod graded;
mod implicit;
mod isotropy;
mod lagged;
mod leading;
mod legs;
mod lifetime;
pub mod linear;
pub mod lyapunov;
mod multiple_shooting;
mod multipliers;
mod newton_picard;
pub mod periodic;
mod product;
pub mod regime;
mod rests;
mod returns;
mod same_set;
mod series_mean;
mod share;
pub mod singular;
mod spectrum;
mod steady;
pub mod symmetry;
mod transforms;
mod zero_one;

pub use equilibrium::RelativeEquilibrium;
pub use error::{Error, Result};
pub use escape::{EscapeRate, Stay, SurvivalStep, escape_limits, escape_rate, survival};
pub use estimate::Estimate;
pub use implicit::{Flowed, implicit_flow};
pub use isotropy::{Isotropy, mean_over_rotations};
pub use lagged::lagged_sums;
pub use legs::{CornerKind, Ends, Leg, Legs, PathSample, legs};
pub use lifetime::{
    Critical, ExponentialLife, Goodness, LifeCount, LifeLaws, MeanLife, Memory, PowerLawLife,
    compare_life_laws, mean_life, memory,
};
pub use lyapunov::{Lyapunov, LyapunovSettings, SoFar, lyapunov, lyapunov_followed};
pub(crate) use motiform_dynamics::sample::{ascending, sort_by_number};
pub use periodic::PeriodicOrbit;
pub use product::logarithms_of_product;
pub use regime::{Attractor, Course, Form, Regime, Settings, Spread, Verdict, classify};
pub use rests::{Rest, Rests, rests};
pub use returns::{Dimension, correlation_dimension, return_pairs};
pub use same_set::same_set;
pub use series_mean::{series_mean, short_series_mean};
pub use share::Share;
pub use spectrum::{Spectrum, welch};
pub use steady::SteadyMotion;
pub use zero_one::{ZeroOne, zero_one};
