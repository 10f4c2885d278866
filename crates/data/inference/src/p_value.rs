//! p-values in words.

use std::fmt::{Display, Formatter, Result};

/// A p-value as it is printed: `p = 0.34`, from .01 on with two decimals, below with two digits, and `p below 1e-300` where it is 0 in
/// double precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PValue(pub f64);

impl Display for PValue {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self.0 {
            0.0 => f.write_str("p below 1e-300"),
            p if p < 0.01 => write!(f, "p = {p:.1e}"),
            p => write!(f, "p = {p:.2}"),
        }
    }
}
