//! Code compiled for the lanes of vector registers: an analysis applied to a model.
//!
//! An analysis never names a model, and a model never names an analysis; a kernel combines them, for each instruction set and
//! arithmetic. Compiling it takes minutes, so it is in a separate crate, which changes rarely.

mod ensemble;
mod exponents;
mod tensor;

pub use ensemble::{STATE, TensorStart, has_ensemble, propagate_tensors};
pub use exponents::{exponents_of_tensor, has_exponents};
pub use tensor::{TensorRow, classify_tensors, covering};
