//! The chaotic saddle.

use super::estimate;
use crate::saddle::Saddle;
use motiform_dynamics::digits::{four_digits, given};
use std::fmt::{Display, Formatter, Result};

impl Display for Saddle {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        if let Some(exponent) = self.exponent {
            let of = if self.is_one() { "of the chaotic saddle" } else { "of the chaos        " };
            writeln!(f, "lambda_1 {of}   {}", estimate(&exponent, 0, 5))?;
        }
        if !self.missing.is_empty() {
            writeln!(f, "{}", self.missing)?;
        }
        match self.rate {
            Some(rate) => writeln!(
                f,
                "escape rate                      {} (mean lifetime {})",
                estimate(&rate, 0, 5),
                four_digits(1.0 / rate.value)
            )?,
            None if self.exponent.is_some() => {
                writeln!(f, "escape rate                      none: fewer than ten escapes")?;
            }
            None => {}
        }
        write!(f, "{} of {} runs escaped within {} model time", self.escaped, self.runs, given(self.t_end))?;
        let others = [
            (self.captured, "came to rest at a stable steady motion"),
            (self.regular, "moved regularly at the end and do not count"),
        ];
        others.iter().filter(|other| other.0 > 0).try_for_each(|(count, what)| write!(f, ", {count} {what}"))
    }
}
