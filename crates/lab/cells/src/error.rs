//! Errors of input.

use std::path::PathBuf;

/// Input that cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The files.
    #[error(transparent)]
    Tracks(#[from] motiform_tracks::Error),
    /// The data or the settings of a fit.
    #[error(transparent)]
    Inference(motiform_inference::Error),
    /// A folder without fits to continue.
    #[error("{} contains no fits to continue: {reason}", .path.display())]
    NoFits {
        /// The folder.
        path: PathBuf,
        /// The reason.
        reason: String,
    },
    /// A folder with fits of other cells or with other settings.
    #[error("{} contains other fits than those requested ({differences})", .path.display())]
    OtherFits {
        /// The folder.
        path: PathBuf,
        /// The values that differ: in the folder, and requested.
        differences: String,
    },
    /// Studies and files that are written.
    #[error(transparent)]
    Study(#[from] motiform_study::Error),
}

/// The result of this crate.
pub type Result<T> = std::result::Result<T, Error>;

impl From<motiform_store::Error> for Error {
    fn from(error: motiform_store::Error) -> Self {
        Self::Study(error.into())
    }
}

impl From<motiform_inference::Error> for Error {
    /// A fit that was stopped is a computation that was stopped.
    fn from(error: motiform_inference::Error) -> Self {
        match error {
            motiform_inference::Error::Interrupted => Self::Study(motiform_study::Error::Interrupted),
            other => Self::Inference(other),
        }
    }
}
