//! Input that no model can be fitted to.

/// Observations or settings that cannot be used. Cells and frames are counted from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "each message says what its fields are")]
pub enum Error {
    /// No cell.
    #[error("there is no cell to fit: give at least one track")]
    NoCell,
    /// Too few frames.
    #[error("cell {cell} has {frames} frames, fewer than {least}: track longer")]
    TooShort { cell: usize, frames: usize, least: usize },
    /// Times that do not increase.
    #[error(
        "cell {cell}, frame {frame}: the time {t} does not follow {before}; sort the frames and leave out repeated ones"
    )]
    Times { cell: usize, frame: usize, t: f64, before: f64 },
    /// A number that is none.
    #[error("cell {cell}, frame {frame}: {what} is {value}; leave such frames out")]
    NotFinite { cell: usize, frame: usize, what: &'static str, value: f64 },
    /// Modes that a model has and a frame does not.
    #[error(
        "cell {cell}, frame {frame}: {given} numbers with their covariance are given, and the model is \
        fitted to {numbers}: x, y and the real and imaginary parts of z2, z3, .."
    )]
    Modes { cell: usize, frame: usize, given: usize, numbers: usize },
    /// A covariance that is none.
    #[error(
        "cell {cell}, frame {frame}: the covariance is not symmetric and positive definite; give every coordinate an error above 0"
    )]
    Covariance { cell: usize, frame: usize },
    /// A mode beyond the third that is not seen: its equation would be one of the errors of observation.
    #[error(
        "{mode} does not exceed its errors of observation (mean square {signal:.2} times theirs, errors subtracted): fit three modes"
    )]
    NotSeen {
        mode: &'static str,
        /// Its mean square, errors subtracted, over that of the errors.
        signal: f64,
    },
    /// Frames that do not follow each other.
    #[error("no three frames follow each other within {longest}: the gaps are too long to follow the motion")]
    Gaps {
        /// Longest gap that the filter goes on through, in the time of the data.
        longest: f64,
    },
    /// No such term.
    #[error("unknown term {name:?}: choose among {}", .known.join("; "))]
    Term { name: String, known: Vec<String> },
    /// The watch stopped the search.
    #[error("stopped before the end")]
    Interrupted,
    /// A setting out of its range.
    #[error("{key} = {value}: {remedy}")]
    Setting { key: &'static str, value: f64, remedy: &'static str },
}

/// Result of this crate's functions.
pub type Result<T> = std::result::Result<T, Error>;
