//! What is compiled for the lanes of vector registers: an analysis times a model.
//!
//! An analysis never names a model, and a model no analysis; a kernel is their product, for each instruction set and
//! arithmetic. Compiling it takes minutes, so it has a crate of its own, which changes rarely.

mod ensemble;
mod exponents;
mod tensor;

pub use ensemble::{STATE, TensorStart, has_ensemble, propagate_tensors};
pub use exponents::{exponents_of_tensor, has_exponents};
pub use tensor::{TensorRow, classify_tensors, covering};
