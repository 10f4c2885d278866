//! Bodies that cannot be measured.

/// An input that cannot be used, or a file that cannot be read or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Of the study, a run or a file.
    #[error(transparent)]
    Study(#[from] motiform_study::Error),
    /// Of the samples.
    #[error(transparent)]
    Statistics(#[from] motiform_statistics::Error),
}

/// Result of a measurement.
pub type Result<T> = std::result::Result<T, Error>;
