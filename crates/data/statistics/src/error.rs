//! Samples that no statistics can be made of.

/// Samples or settings that cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// No body.
    #[error("there is no body to measure: give at least one track")]
    NoBody,
    /// The interval of the samples.
    #[error("dt = {dt}: the time between samples must be finite and above 0")]
    Interval {
        /// It.
        dt: f64,
    },
    /// Series of different lengths.
    #[error(
        "body {body}: {what} has {got} samples where its position has {expected}; give equally long series"
    )]
    Lengths {
        /// The body, from 0.
        body: usize,
        /// The name of the series.
        what: String,
        /// Its length.
        got: usize,
        /// The length of the positions.
        expected: usize,
    },
    /// Other modes than those of the first body.
    #[error("body {body} has {got} modes where {expected} are named; give every body the same modes")]
    Modes {
        /// The body, from 0.
        body: usize,
        /// Its number of modes.
        got: usize,
        /// Number of modes that have names.
        expected: usize,
    },
    /// Too few samples.
    #[error("body {body} has {samples} samples, fewer than {least}: record longer, or more often")]
    TooShort {
        /// The body, from 0.
        body: usize,
        /// Its samples.
        samples: usize,
        /// The fewest that are enough.
        least: usize,
    },
    /// A sample that is not a number.
    #[error("body {body}: sample {sample} of {what} is {value}; leave such bodies out")]
    NotFinite {
        /// The body, from 0.
        body: usize,
        /// The name of the series.
        what: String,
        /// Number of the sample.
        sample: usize,
        /// Its value.
        value: f64,
    },
    /// A setting out of its range.
    #[error("{key} = {value}: {remedy}")]
    Setting {
        /// The key.
        key: &'static str,
        /// Its value.
        value: f64,
        /// The remedy.
        remedy: &'static str,
    },
    /// No such quantity.
    #[error("unknown quantity {name:?}: choose one of {}", .known.join(", "))]
    Quantity {
        /// The name.
        name: String,
        /// The known ones.
        known: Vec<String>,
    },
    /// A spectrum cannot be made.
    #[error(transparent)]
    Analysis(#[from] motiform_analysis::Error),
}

/// Result of a statistic.
pub type Result<T> = std::result::Result<T, Error>;
