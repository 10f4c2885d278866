//! Errors of input.

/// An input that cannot be used. Failures of the mathematics are an [`crate::Outcome`] instead.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "each message says what its fields are")]
pub enum Error {
    /// An array has the wrong length.
    #[error("{what} has {got} entries, expected {expected}")]
    Shape { what: &'static str, expected: usize, got: usize },
    /// A number is outside the range of the method.
    #[error("{name} = {value} is out of range: give a number {range}")]
    OutOfRange { name: &'static str, value: f64, range: &'static str },
    /// A fixed-step method cannot control its step.
    #[error("stepper {stepper} has no error estimate: give a fixed step, or choose an adaptive stepper")]
    NoErrorEstimate { stepper: &'static str },
}
