//! The models of motiform. Every model is a shape state with a drift (see `motiform_dynamics::Model`).
//!
//! Adding a model is one folder beside [`tensor`] and [`cell`] and one entry in [`registry::MODELS`]. Models of amplitude
//! equations need no code: [`amplitudes`]. A model of one's own, in a crate that uses this one, is made known by [`register`].

pub mod amplitudes;
pub mod cell;
mod error;
mod model_name;
mod own;
pub mod parameters;
pub mod polar;
pub mod registry;
pub mod spelling;
pub mod tensor;
pub mod zoo;

pub use error::{Error, hint, nearest};
pub use model_name::ModelName;
pub use own::{About, register};
pub use parameters::{ParameterSpec, Parameters};
pub use registry::{MODELS, ModelInfo};
