//! Code compiled for the lanes of vector registers: an analysis applied to a model.
//!
//! An analysis never names a model, and a model never names an analysis; a kernel combines them, for each instruction set and
//! arithmetic. Compiling it takes minutes, so it is in a separate crate, which changes rarely.

mod classify;
mod ensemble;
mod exponents;
mod kernel;
mod noisy;

pub use classify::{Row, classify_rows};
pub use ensemble::{Start, propagate_bodies};
pub use exponents::{exponents_of_body, has_exponents};
pub use kernel::{Kernel, MOST_MODES};
pub use noisy::{NoisyStart, NoisyStates, Stretch, propagate_noisy_bodies};
