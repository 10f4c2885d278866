//! The faults of the samples of an analysis.

/// The reasons why samples cannot be analysed. Every message names the input and the remedy. Samples are counted from 0.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "each message says what its fields are")]
pub enum Error {
    /// A sample is NaN or infinite.
    #[error(
        "sample number {index} is {value}; cut the samples before it, or where the quantity is undefined"
    )]
    NotFinite { index: usize, value: f64 },
    /// The sampling interval is no positive number.
    #[error("the sampling interval dt is {dt}; give the positive model time between two samples")]
    Interval { dt: f64 },
    /// A segment too short for its window.
    #[error("a segment of {segment} samples is too short for a window; choose at least {least}")]
    Segment { segment: usize, least: usize },
    /// Fewer samples than a segment has.
    #[error(
        "{samples} samples do not fill a segment of {segment}; sample a longer run, or shorten the segment"
    )]
    TooShort { samples: usize, segment: usize },
    /// The squares of the samples overflow.
    #[error("the squares of the samples overflow, the largest is {largest:e}; cut the run where it escapes")]
    Overflow { largest: f64 },
    /// Fewer samples than the method can do with.
    #[error("{what} needs at least {least}, there are {got}; sample a longer run")]
    TooFew {
        /// The quantity that is asked for, and the samples that it counts.
        what: &'static str,
        least: usize,
        got: usize,
    },
    /// All samples are the same number.
    #[error("all samples are {value}; the question is void for a constant, choose another quantity")]
    Constant { value: f64 },
    /// An argument lies outside what the method can use.
    #[error("{name} = {value} is out of range: give a number {range}")]
    OutOfRange { name: &'static str, value: f64, range: &'static str },
    /// Two lists that belong together have different lengths, or points have different dimensions.
    #[error("{what} has {got} entries, expected {expected}")]
    Shape { what: &'static str, expected: usize, got: usize },
    /// Times that do not grow.
    #[error("time number {index} is {t}, not after the one before it; give samples in the order of time")]
    Order { index: usize, t: f64 },
    /// Nothing moves.
    #[error("the speed is 0 at every sample; a body at rest has no heading and no legs")]
    AtRest,
    /// A leg without a direction.
    #[error("the leg from t = {t_start} to {t_end} ends where it began and has no direction; use the swing")]
    ClosedLeg { t_start: f64, t_end: f64 },
    /// Too few points for a range of scales.
    #[error(
        "{points} points leave scales from {smallest:e} to {largest:e} only; give more points of the section"
    )]
    Scales {
        points: usize,
        /// Smallest distance with enough pairs below it.
        smallest: f64,
        /// Largest distance that is small against the whole.
        largest: f64,
    },
    /// A family has no body for a value of its parameter.
    #[error("there is no body for the parameter value {value}: {why}; choose a range without it")]
    NoBody { value: f64, why: String },
    /// A branch cannot start outside its range.
    #[error("the start {start} lies outside the range {low} to {high}; give a range that holds it")]
    OutsideRange { start: f64, low: f64, high: f64 },
    /// The start of a branch is no solution of its equations.
    #[error(
        "there is no {what} near the start at the parameter {parameter}: {why}; give a motion of this kind, closer to it"
    )]
    NotOnABranch { what: &'static str, parameter: f64, why: String },
    /// The numerics refused an input.
    #[error(transparent)]
    Dynamics(#[from] motiform_dynamics::Error),
    /// The Fourier transform refused its buffers.
    #[error("the Fourier transform failed: {source}; report this as a bug of motiform")]
    Transform {
        #[from]
        source: realfft::FftError,
    },
}

/// Result of an analysis.
pub type Result<T> = std::result::Result<T, Error>;
