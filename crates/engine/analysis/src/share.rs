//! The share of trials with some outcome, with its interval.

use serde::Serialize;

/// 97.5 % quantile of the normal distribution.
const QUANTILE: f64 = 1.959_963_984_540_054;

/// A share of independent trials with its 95 % confidence interval.
///
/// (p + z^2/2n -+ z sqrt(p (1 - p)/n + z^2/4n^2)) / (1 + z^2/n),   p = count / of, n = of, z = 1.96
///
/// The shares that a score test does not refuse: within 0..1, and not empty where none or all trials have the outcome.
///
/// Source: Wilson (1927), J. Am. Stat. Assoc. 22, 209.
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
    #[must_use]
    pub fn new(count: usize, of: usize) -> Option<Self> {
        if of == 0 || count > of {
            return None;
        }
        let (n, value) = (of as f64, count as f64 / of as f64);
        let square = QUANTILE * QUANTILE / n;
        let middle = (value + 0.5 * square) / (1.0 + square);
        let half = (value * (1.0 - value) * square + 0.25 * square * square).sqrt() / (1.0 + square);
        let lower = if count == 0 { 0.0 } else { middle - half };
        let upper = if count == of { 1.0 } else { middle + half };
        Some(Self { count, of, value, lower, upper })
    }
}
