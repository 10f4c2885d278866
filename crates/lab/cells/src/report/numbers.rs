//! Numbers as they stand in tables.

use motiform_inference::Estimate;
pub(crate) use motiform_statistics::with_error;
use motiform_statistics::{Answer, Measured, four_digits, to_error};

/// A number to four digits.
pub(crate) fn plain(x: f64) -> String {
    four_digits(x)
}

pub(crate) fn estimate(estimate: &Estimate) -> String {
    with_error(estimate.value, estimate.error)
}

/// A value with the ends of its interval.
pub(crate) fn measured(found: &Measured) -> String {
    match found.interval {
        Some(ends) => {
            let [low, high] = interval(ends);
            format!("{} ({low} to {high})", to_error(found.value, half_width(ends)))
        }
        None => plain(found.value),
    }
}

/// The ends of an interval, to two digits of half its width.
pub(crate) fn interval(ends: [f64; 2]) -> [String; 2] {
    ends.map(|end| to_error(end, half_width(ends)))
}

fn half_width([low, high]: [f64; 2]) -> f64 {
    0.5 * (high - low)
}

/// A value, or why there is none.
pub(crate) fn answer(found: &Answer, unit: &str) -> String {
    match found {
        Answer::Known(found) => format!("{} {unit}", measured(found)),
        Answer::Unknown { reason } => reason.clone(),
    }
}
