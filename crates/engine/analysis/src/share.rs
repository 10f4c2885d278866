//! The share of trials with some outcome, with its interval.

use motiform_dynamics::distributions::wilson;
use serde::Serialize;

/// A share of independent trials with its 95 % confidence interval.
///
/// Wilson's interval, [`wilson`]: within 0..1, and not empty where none or all trials have the outcome.
///
/// # Checked by  tests/all/share.rs: published intervals, symmetry
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Share {
    /// Trials with the outcome.
    pub count: usize,
    /// Trials in all.
    pub of: usize,
    /// `count / of`.
    pub value: f64,
    /// Lower end of the interval.
    pub lower: f64,
    /// Upper end of the interval.
    pub upper: f64,
}

impl Share {
    /// The share of `count` in `of` trials; `None` without trials, or for more than all of them.
    pub fn new(count: usize, of: usize) -> Option<Self> {
        if of == 0 || count > of {
            return None;
        }
        let value = count as f64 / of as f64;
        let [lower, upper] = wilson(value, of as f64);
        Some(Self { count, of, value, lower, upper })
    }
}
