//! Numbers as they stand in tables.

use motiform_inference::Estimate;
pub(crate) use motiform_statistics::with_error;
use motiform_statistics::{Answer, Measured, four_digits};

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
