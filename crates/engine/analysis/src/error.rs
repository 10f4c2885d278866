//! The faults of the samples of an analysis.

/// The reasons why samples cannot be analysed. Every message names the input and the remedy.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A sample is NaN or infinite.
    #[error(
        "sample number {index} is {value}; cut the samples before it, or where the quantity is undefined"
    )]
    NotFinite {
        /// Position in the list, from 0.
        index: usize,
        /// The offending value.
        value: f64,
    },
    /// The sampling interval is no positive number.
    #[error("the sampling interval dt is {dt}; give the positive model time between two samples")]
    Interval {
        /// The interval given.
        dt: f64,
    },
    /// A segment too short for its window.
    #[error("a segment of {segment} samples is too short for a window; choose at least {least}")]
    Segment {
        /// The length given.
        segment: usize,
        /// The least length.
        least: usize,
    },
    /// Fewer samples than a segment has.
    #[error(
        "{samples} samples do not fill a segment of {segment}; sample a longer run, or shorten the segment"
    )]
    TooShort {
        /// Number of samples.
        samples: usize,
        /// Length of a segment.
        segment: usize,
    },
    /// The squares of the samples overflow.
    #[error("the squares of the samples overflow, the largest is {largest:e}; cut the run where it escapes")]
    Overflow {
        /// Largest magnitude of a sample.
        largest: f64,
    },
    /// Fewer samples than the method can do with.
    #[error("{what} needs at least {least}, there are {got}; sample a longer run")]
    TooFew {
        /// The quantity that is asked for, and the samples that it counts.
        what: &'static str,
        /// The least number.
        least: usize,
        /// Number there are.
        got: usize,
    },
    /// All samples are the same number.
    #[error("all samples are {value}; the question is void for a constant, choose another quantity")]
    Constant {
        /// That number.
        value: f64,
    },
    /// An argument lies outside what the method can use.
    #[error("{name} = {value} is out of range: give a number {range}")]
    OutOfRange {
        /// Name of the argument.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The range in words.
        range: &'static str,
    },
    /// Two lists that belong together have different lengths, or points have different dimensions.
    #[error("{what} has {got} entries, expected {expected}")]
    Shape {
        /// The list.
        what: &'static str,
        /// The length it needs.
        expected: usize,
        /// The length it has.
        got: usize,
    },
    /// Times that do not grow.
    #[error("time number {index} is {t}, not after the one before it; give samples in the order of time")]
    Order {
        /// Position in the list, from 0.
        index: usize,
        /// That time.
        t: f64,
    },
    /// Nothing moves.
    #[error("the speed is 0 at every sample; a body at rest has no heading and no legs")]
    AtRest,
    /// A leg without a direction.
    #[error("the leg from t = {t_start} to {t_end} ends where it began and has no direction; use the swing")]
    ClosedLeg {
        /// Its start.
        t_start: f64,
        /// Its end.
        t_end: f64,
    },
    /// Too few points for a range of scales.
    #[error(
        "{points} points leave scales from {smallest:e} to {largest:e} only; give more points of the section"
    )]
    Scales {
        /// Number of points.
        points: usize,
        /// Smallest distance with enough pairs below it.
        smallest: f64,
        /// Largest distance that is small against the whole.
        largest: f64,
    },
    /// A family has no body for a value of its parameter.
    #[error("there is no body for the parameter value {value}: {why}; choose a range without it")]
    NoBody {
        /// The value.
        value: f64,
        /// The reason.
        why: String,
    },
    /// A branch cannot start outside its range.
    #[error("the start {start} lies outside the range {low} to {high}; give a range that holds it")]
    OutsideRange {
        /// Parameter of the start.
        start: f64,
        /// Beginning of the range.
        low: f64,
        /// End of the range.
        high: f64,
    },
    /// The start of a branch is no solution of its equations.
    #[error(
        "there is no {what} near the start at the parameter {parameter}: {why}; give a motion of this kind, closer to it"
    )]
    NotOnABranch {
        /// The expected motion or point.
        what: &'static str,
        /// Parameter of the start.
        parameter: f64,
        /// The reason.
        why: String,
    },
    /// The numerics refused an input.
    #[error(transparent)]
    Dynamics(#[from] motiform_dynamics::Error),
    /// The Fourier transform refused its buffers.
    #[error("the Fourier transform failed: {source}; report this as a bug of motiform")]
    Transform {
        /// The error of the transform.
        #[from]
        source: realfft::FftError,
    },
}

/// Result of an analysis.
pub type Result<T> = std::result::Result<T, Error>;
