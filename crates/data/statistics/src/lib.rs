//! Statistics that are commonly measured on tracks of moving bodies: mean-square displacement with
//! persistence time and diffusion coefficient, autocorrelations, distributions of speed and turning angle,
//! first-passage and residence times, power spectra.
//!
//! Pure functions of evenly spaced samples: knows no model and no file. Definitions and formulas: docs/statistics.md. Errors are those
//! over bodies, or over blocks of the tracks where there are few bodies ([`Tracks`]). What cannot be computed
//! is an [`Answer`] with the reason.

mod answer;
mod blocks;
mod carried;
mod consistency;
mod correlate;
mod correlation;
mod damped;
mod diffusion;
mod displacement;
mod distribution;
mod error;
mod estimate;
mod exponent;
mod gapped;
mod jackknife;
mod lag_window;
mod oscillation;
mod passage;
mod persistence;
mod plateau;
mod power;
mod quantity;
mod residence;
mod resolution;
mod slow;
mod stationary;
mod statistics;
mod survival;
mod tracks;
mod turning;
mod unlike;
mod windows;

pub use answer::{Answer, Measured};
pub use consistency::Seen;
pub use correlate::lagged_sums;
pub use correlation::{Autocorrelation, autocorrelation};
pub use diffusion::{Diffusion, diffusion};
pub use displacement::{DisplacementPoint, MeanSquare, PathPiece, mean_square, mean_square_of_paths};
pub use distribution::{Bin, Histogram, histogram};
pub use error::{Error, Result};
pub use exponent::local_exponent;
pub use gapped::GappedVectors;
pub use jackknife::jackknife;
pub use motiform_dynamics::digits::{four_digits, interval, to_error, with_error, with_interval};

/// A number with four digits and its unit; in model units without one.
pub(crate) fn in_unit(x: f64, unit: &str) -> String {
    format!("{} {unit}", four_digits(x)).trim_end().to_owned()
}
pub use oscillation::Oscillation;
pub use passage::{Passage, first_passages, radii};
pub use persistence::{Walk, furth, persistent_walk};
pub use power::{PowerSpectrum, power_spectrum};
pub use quantity::{Quantity, Series};
pub use residence::{Residence, Side, residence};
pub use statistics::{Settings, Statistics, statistics, statistics_watched};
pub use survival::{Duration, MeanTime, mean_time};
pub use tracks::{Errors, Track, Tracks};
pub use turning::{Turning, turning_angles};
