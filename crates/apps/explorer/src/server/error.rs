//! Errors of the server.

/// The server could not be started or went down.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The port is not available.
    #[error("port {port}: {reason}; give another one, or 0 to take any free one")]
    Port {
        /// The requested port.
        port: u16,
        /// The system's reason.
        reason: std::io::Error,
    },
    /// A token that is not allowed in an address, or is too easy to guess.
    #[error(
        "token {token:?}: give 16 to 128 letters and digits, or leave it out: each start then uses a new random one"
    )]
    Token {
        /// The token given.
        token: String,
    },
    /// The system provides no random numbers.
    #[error("the system provides no random numbers for the address: {0}")]
    Random(getrandom::Error),
    /// The machine failed.
    #[error("the server failed: {0}")]
    Failed(#[from] std::io::Error),
    /// The data of the program fail its own checks.
    #[error(transparent)]
    Study(#[from] motiform_study::Error),
}
