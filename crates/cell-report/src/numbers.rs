//! Numbers as they stand in tables.

use motiform_inference::Estimate;
use motiform_statistics::{Answer, Measured, four_digits};

/// Significant digits of an error.
const ERROR_DIGITS: i32 = 2;

/// A number to four digits.
pub(crate) fn plain(x: f64) -> String {
    four_digits(x)
}

/// `0.123 ± 0.012`: the error to two digits, the value to the same place.
pub(crate) fn with_error(value: f64, error: f64) -> String {
    if !(error > 0.0 && error.is_finite()) || value.abs() > 1e6 * error {
        return format!("{} ± {}", plain(value), plain(error));
    }
    let exponent = error.abs().log10().floor() as i32;
    let places = (ERROR_DIGITS - 1 - exponent).max(0) as usize;
    if exponent < -6 || value.abs().max(error) >= 1e6 {
        return format!("{value:.3e} ± {error:.1e}");
    }
    format!("{value:.places$} ± {error:.places$}")
}

pub(crate) fn estimate(estimate: &Estimate) -> String {
    with_error(estimate.value, estimate.error)
}

/// A value with the ends of its interval.
pub(crate) fn measured(found: &Measured) -> String {
    match found.interval {
        Some([low, high]) => format!("{} ({} to {})", plain(found.value), plain(low), plain(high)),
        None => plain(found.value),
    }
}

/// A value, or why there is none.
pub(crate) fn answer(found: &Answer, unit: &str) -> String {
    match found {
        Answer::Known(found) => format!("{} {unit}", measured(found)),
        Answer::Unknown { reason } => reason.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_have_the_digits_of_their_errors() {
        assert_eq!(with_error(0.123_456, 0.0123), "0.123 ± 0.012");
        assert_eq!(with_error(-123.456, 20.0), "-123 ± 20");
        assert_eq!(with_error(1.0, 0.0), "1 ± 0");
        assert_eq!(with_error(2e-9, 1e-9), "2.000e-9 ± 1.0e-9");
    }
}
