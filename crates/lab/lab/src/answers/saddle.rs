//! The chaotic saddle.

use crate::saddle::Saddle;
use std::fmt::{Display, Formatter, Result};

impl Display for Saddle {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self.exponent {
            Some(exponent) => {
                writeln!(
                    f,
                    "lambda_1 of the chaotic saddle   {:.5} +- {:.1e}",
                    exponent.value, exponent.error
                )?;
            }
            None => writeln!(f, "no exponent: {}", self.missing)?,
        }
        match self.rate {
            Some(rate) => writeln!(
                f,
                "escape rate                      {:.3e} +- {:.1e} (mean lifetime {:.0})",
                rate.value,
                rate.error,
                1.0 / rate.value
            )?,
            None => writeln!(f, "escape rate                      none: fewer than ten escapes")?,
        }
        write!(f, "{} of {} runs escaped within {:.0} model time", self.escaped, self.runs, self.t_end)
    }
}
