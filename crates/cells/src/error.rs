//! Errors of input.

/// Input that cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The files.
    #[error(transparent)]
    Tracks(#[from] motiform_tracks::Error),
    /// The data or the settings of a fit.
    #[error(transparent)]
    Inference(#[from] motiform_inference::Error),
    /// Studies and files that are written.
    #[error(transparent)]
    Study(#[from] motiform_study::Error),
}

/// The result of this crate.
pub type Result<T> = std::result::Result<T, Error>;
