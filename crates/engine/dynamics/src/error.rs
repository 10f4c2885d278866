//! Errors of input.

/// An input that cannot be used. Failures of the mathematics are an [`crate::Outcome`] instead.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// An array has the wrong length.
    #[error("{what} has {got} entries, expected {expected}")]
    Shape {
        /// The name of the array that was passed.
        what: &'static str,
        /// The required length.
        expected: usize,
        /// The actual length.
        got: usize,
    },
    /// A number is outside the range of the method.
    #[error("{name} = {value} is out of range: give a number {range}")]
    OutOfRange {
        /// Name of the number.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The range as text, e.g. `above 0`.
        range: &'static str,
    },
    /// A fixed-step method cannot control its step.
    #[error("stepper {stepper} has no error estimate: give a fixed step, or choose an adaptive stepper")]
    NoErrorEstimate {
        /// Name of the method.
        stepper: &'static str,
    },
}
