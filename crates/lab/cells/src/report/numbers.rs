//! Numbers as they stand in tables.

use motiform_inference::Estimate;
use motiform_statistics::{Answer, Measured, four_digits, with_interval};
pub(crate) use motiform_statistics::{interval, with_error};

/// A number to four digits.
pub(crate) fn plain(x: f64) -> String {
    four_digits(x)
}

pub(crate) fn estimate(estimate: &Estimate) -> String {
    with_error(estimate.value, estimate.error)
}

/// A value with the ends of its interval.
pub(crate) fn measured(found: &Measured) -> String {
    found.interval.map_or_else(|| plain(found.value), |ends| with_interval(found.value, ends))
}

/// A value, or why there is none.
pub(crate) fn answer(found: &Answer, unit: &str) -> String {
    match found {
        Answer::Known(found) => format!("{} {unit}", measured(found)),
        Answer::Unknown { reason } => reason.clone(),
    }
}
