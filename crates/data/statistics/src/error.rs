//! Samples that no statistics can be made of.

/// Samples or settings that cannot be used. Bodies and samples are counted from 0.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "each message says what its fields are")]
pub enum Error {
    /// No body.
    #[error("there is no body to measure: give at least one track")]
    NoBody,
    /// The interval of the samples.
    #[error("dt = {dt}: the time between samples must be finite and above 0")]
    Interval { dt: f64 },
    /// Series of different lengths.
    #[error(
        "body {body}: {what} has {got} samples where its position has {expected}; give equally long series"
    )]
    Lengths { body: usize, what: String, got: usize, expected: usize },
    /// Other modes than those of the first body.
    #[error("body {body} has {got} modes where {expected} are named; give every body the same modes")]
    Modes { body: usize, got: usize, expected: usize },
    /// Too few samples.
    #[error("body {body} has {samples} samples, fewer than {least}: record longer, or more often")]
    TooShort { body: usize, samples: usize, least: usize },
    /// A sample that is not a number.
    #[error("body {body}: sample {sample} of {what} is {value}; leave such bodies out")]
    NotFinite { body: usize, what: String, sample: usize, value: f64 },
    /// A setting out of its range.
    #[error("{key} = {value}: {remedy}")]
    Setting { key: &'static str, value: f64, remedy: &'static str },
    /// No such quantity.
    #[error("unknown quantity {name:?}: choose one of {}", .known.join(", "))]
    Quantity { name: String, known: Vec<String> },
    /// A spectrum cannot be made.
    #[error(transparent)]
    Analysis(#[from] motiform_analysis::Error),
}

/// Result of a statistic.
pub type Result<T> = std::result::Result<T, Error>;
