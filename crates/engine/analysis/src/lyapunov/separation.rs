//! Do neighbouring orbits separate exponentially? The one rule that calls an exponent positive.

use super::Lyapunov;
use crate::Estimate;

/// Growth by less than this (natural logarithm) over all runs may be a power of time.
pub(crate) const GROWN: f64 = 10.0;

/// And so may growth by less than this in each run. Every run begins with a new tangent vector and is averaged from a fifth of its span on:
/// from there to its end time grows by a factor of 6, and a vector along neutral or slowly decaying directions as its first or second
/// power.
pub(crate) const SECULAR: f64 = 2.0 * 1.791_759_469_228_055;

/// Growth by less than this over so many runs may be a power of time.
pub fn power_of_time(runs: usize) -> f64 {
    GROWN.max(SECULAR * runs as f64)
}

/// A positive exponent is above this many of its 95 % errors.
const ERRORS: f64 = 3.0;

/// Returns `true` if an exponent, averaged over `time` in so many runs, is `asked` times as large as a
/// positive one must be: three times its 95 % error, and growth beyond any power of time.
pub fn separates(exponent: Estimate, time: f64, runs: usize, asked: f64) -> bool {
    let Estimate { value, error } = exponent;
    value > asked * ERRORS * error && value * time >= asked * power_of_time(runs)
}

impl Lyapunov {
    /// Returns `true` if its largest exponent is positive beyond its error, and beyond any growth like a
    /// power of time ([`separates`]): chaos, or an unstable motion that the run stays on.
    pub fn separates(&self) -> bool {
        self.exponents.first().is_some_and(|&first| separates(first, self.time, 1, 1.0))
    }
}
