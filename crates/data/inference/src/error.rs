//! Input that no model can be fitted to.

/// Observations or settings that cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// No cell.
    #[error("there is no cell to fit: give at least one track")]
    NoCell,
    /// Too few frames.
    #[error("cell {cell} has {frames} frames, fewer than {least}: track longer")]
    TooShort {
        /// The cell, from 0.
        cell: usize,
        /// Its frames.
        frames: usize,
        /// The fewest that are enough.
        least: usize,
    },
    /// Times that do not increase.
    #[error(
        "cell {cell}, frame {frame}: the time {t} does not follow {before}; sort the frames and leave out repeated ones"
    )]
    Times {
        /// The cell, from 0.
        cell: usize,
        /// The frame, from 0.
        frame: usize,
        /// Its time.
        t: f64,
        /// The time of the frame before.
        before: f64,
    },
    /// A number that is none.
    #[error("cell {cell}, frame {frame}: {what} is {value}; leave such frames out")]
    NotFinite {
        /// The cell, from 0.
        cell: usize,
        /// The frame, from 0.
        frame: usize,
        /// The quantity.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// Modes that a model has and a frame does not.
    #[error(
        "cell {cell}, frame {frame}: {given} numbers with their covariance are given, and the model is \
        fitted to {numbers}: x, y and the real and imaginary parts of z2, z3, .."
    )]
    Modes {
        /// The cell, from 0.
        cell: usize,
        /// The frame, from 0.
        frame: usize,
        /// Numbers given.
        given: usize,
        /// Numbers that are fitted.
        numbers: usize,
    },
    /// A covariance that is none.
    #[error(
        "cell {cell}, frame {frame}: the covariance is not symmetric and positive definite; give every coordinate an error above 0"
    )]
    Covariance {
        /// The cell, from 0.
        cell: usize,
        /// The frame, from 0.
        frame: usize,
    },
    /// A mode beyond the third that is not seen: its equation would be one of the errors of observation.
    #[error(
        "{mode} does not exceed its errors of observation (mean square {signal:.2} times theirs, errors subtracted): fit three modes"
    )]
    NotSeen {
        /// The mode.
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
    Term {
        /// The name.
        name: String,
        /// The known ones.
        known: Vec<String>,
    },
    /// The watch stopped the search.
    #[error("stopped before the end")]
    Interrupted,
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
}

/// Result of this crate's functions.
pub type Result<T> = std::result::Result<T, Error>;
