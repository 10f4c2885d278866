//! A measured number with its interval, or the reason why there is none.

use serde::Serialize;

/// A value with its 95 % confidence interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Measured {
    /// The value.
    pub value: f64,
    /// Ends of the interval; `None` where the units ([`crate::Errors`]) that contribute are too few.
    #[serde(flatten, serialize_with = "ends")]
    pub interval: Option<[f64; 2]>,
}

/// `lower` and `upper`, or nothing.
fn ends<S: serde::Serializer>(interval: &Option<[f64; 2]>, serializer: S) -> Result<S::Ok, S::Error> {
    use serde::ser::SerializeMap;
    let mut map = serializer.serialize_map(None)?;
    if let Some([lower, upper]) = interval {
        map.serialize_entry("lower", lower)?;
        map.serialize_entry("upper", upper)?;
    }
    map.end()
}

impl Measured {
    /// The value and the ends as functions of them, for one that increases.
    #[must_use]
    pub fn map(self, rising: impl Fn(f64) -> f64) -> Self {
        Self { value: rising(self.value), interval: self.interval.map(|ends| ends.map(rising)) }
    }

    /// Lower end; NaN without an interval (an empty field in tables).
    #[must_use]
    pub fn lower(&self) -> f64 {
        self.interval.map_or(f64::NAN, |ends| ends[0])
    }

    /// Upper end; NaN without an interval.
    #[must_use]
    pub fn upper(&self) -> f64 {
        self.interval.map_or(f64::NAN, |ends| ends[1])
    }

    /// Half the width of the interval; 0 without one.
    #[must_use]
    pub fn half_width(&self) -> f64 {
        self.interval.map_or(0.0, |[lower, upper]| 0.5 * (upper - lower))
    }
}

/// A measured value, or why there is none.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Answer {
    /// The value.
    Known(Measured),
    /// The samples do not show it.
    Unknown {
        /// The reason, in a sentence.
        reason: String,
    },
}

impl Answer {
    /// No value, for this reason.
    #[must_use]
    pub fn unknown(reason: impl Into<String>) -> Self {
        Self::Unknown { reason: reason.into() }
    }

    /// The value, if there is one.
    #[must_use]
    pub fn known(&self) -> Option<Measured> {
        match self {
            Self::Known(measured) => Some(*measured),
            Self::Unknown { .. } => None,
        }
    }

    /// The same with an interval that reaches at least so far to both sides of the value, if it has one.
    pub(crate) fn at_least(self, half_width: f64) -> Self {
        let Self::Known(Measured { value, interval }) = self else { return self };
        let interval =
            interval.map(|[low, high]| [low.min(value - half_width), high.max(value + half_width)]);
        Self::Known(Measured { value, interval })
    }

    /// The same without a value, where there is a reason.
    pub(crate) fn unless(self, reason: Option<String>) -> Self {
        match reason {
            Some(reason) if self.known().is_some() => Self::Unknown { reason },
            _ => self,
        }
    }

    /// The answer; where it is unknown because the record is too short, this reason replaces the advice to record longer.
    pub(crate) fn unreachable_since(self, why: &str) -> Self {
        match self {
            Self::Unknown { reason } if reason.starts_with("not reached") => Self::unknown(why),
            other => other,
        }
    }

    /// The reason why there is no value, if there is none.
    #[must_use]
    pub fn reason(&self) -> Option<&str> {
        match self {
            Self::Known(_) => None,
            Self::Unknown { reason } => Some(reason),
        }
    }
}

/// A number with four digits at most, for sentences.
#[must_use]
pub fn four_digits(x: f64) -> String {
    let rounded: f64 = format!("{x:.3e}").parse().unwrap_or(x);
    if rounded == 0.0 || (1e-4..1e6).contains(&rounded.abs()) {
        rounded.to_string()
    } else {
        format!("{rounded:e}")
    }
}

/// Significant digits of an error.
const ERROR_DIGITS: i32 = 2;

/// `0.123 ± 0.012`: the error to two digits, the value to the same place.
#[must_use]
pub fn with_error(value: f64, error: f64) -> String {
    let [value, error] = value_and_error(value, error);
    format!("{value} ± {error}")
}

/// The value of [`with_error`] alone.
#[must_use]
pub fn to_error(value: f64, error: f64) -> String {
    let [value, _] = value_and_error(value, error);
    value
}

fn value_and_error(value: f64, error: f64) -> [String; 2] {
    if !(error > 0.0 && error.is_finite()) || value.abs() > 1e6 * error {
        return [value, error].map(four_digits);
    }
    let exponent = error.abs().log10().floor() as i32;
    let places = (ERROR_DIGITS - 1 - exponent).max(0) as usize;
    if exponent < -6 || value.abs().max(error) >= 1e6 {
        return [format!("{value:.3e}"), format!("{error:.1e}")];
    }
    let text = format!("{value:.places$}");
    // -0.00 is no number of a table
    let zero = text.strip_prefix('-').filter(|rest| rest.chars().all(|c| matches!(c, '0' | '.')));
    [zero.map_or(text.clone(), str::to_owned), format!("{error:.places$}")]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_have_the_digits_of_their_errors() {
        assert_eq!(with_error(0.123_456, 0.0123), "0.123 ± 0.012");
        assert_eq!(with_error(-123.456, 20.0), "-123 ± 20");
        assert_eq!(with_error(-1e-4, 0.036), "0.000 ± 0.036");
        assert_eq!(with_error(-0.6e-3, 0.036), "-0.001 ± 0.036");
        assert_eq!(with_error(1.0, 0.0), "1 ± 0");
        assert_eq!(with_error(2e-9, 1e-9), "2.000e-9 ± 1.0e-9");
    }
}
