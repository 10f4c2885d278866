//! A number with its error.

use serde::{Deserialize, Serialize};

/// A number with its 95 % confidence interval `value - error ..= value + error`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// The best guess.
    pub value: f64,
    /// Half width of the interval, at least 0. Infinite where the data say nothing about it (too short a series, say): such an
    /// estimate excludes no value. Absent in files then.
    #[serde(default = "unknown", skip_serializing_if = "is_unknown")]
    pub error: f64,
}

impl Estimate {
    /// Returns `true` if `x` lies in the interval.
    pub fn covers(&self, x: f64) -> bool {
        (self.value - x).abs() <= self.error
    }

    /// Returns `true` if there is an error.
    pub fn has_error(&self) -> bool {
        self.error.is_finite()
    }
}

fn unknown() -> f64 {
    f64::INFINITY
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde hands over a reference")]
fn is_unknown(error: &f64) -> bool {
    !error.is_finite()
}
