//! What can be wrong with the samples of an analysis.

/// Why samples cannot be analysed. Every message names the input and the remedy.
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
    #[error("the spectrum overflows, the largest sample is {largest:e}; cut the run where it escapes")]
    Overflow {
        /// Largest magnitude of a sample.
        largest: f64,
    },
    /// The Fourier transform refused its buffers.
    #[error("the Fourier transform failed: {source}; report this as a bug of motiform")]
    Transform {
        /// What the transform said.
        #[from]
        source: realfft::FftError,
    },
}

/// Result of an analysis.
pub type Result<T> = std::result::Result<T, Error>;
