//! The numerics of motiform: scalars, vector fields, steppers, events, outcomes.
//!
//! This crate does not depend on any model, file or command line. The layers inside, from the bottom:
//! * [`scalar`]: one equation, three scalars (`f64`, lanes, duals);
//! * [`vector_field`], [`model`]: fields and bodies;
//! * [`steppers`]: explicit and exponential Runge-Kutta methods as data, and the step that runs each kind;
//! * [`Orbit`], [`ExponentialOrbit`]: one initial-value problem, step by step, with error control, dense output and
//!   exact re-steps; [`Integration`] is what they have in common;
//! * [`noise`], [`NoisyOrbit`]: an integration with explicit noise is an integration;
//! * [`ensemble`]: many orbits in the lanes of vector registers ([`simd`]);
//! * [`drive`]: the loop with samples, [`section`]s, a budget and an escape bound, ending in an [`Outcome`].

pub mod conformance;
mod control;
pub mod digits;
pub mod distributions;
pub mod drive;
pub mod eigenvalues;
pub mod ensemble;
pub mod equivariant;
mod error;
pub mod escape;
pub mod exponential_orbit;
pub mod integration;
mod interpolant;
pub mod model;
mod named;
pub use named::in_words;
pub mod noise;
mod noise_steps;
mod noisy_orbit;
pub mod orbit;
mod outcome;
pub mod sample;
pub mod scalar;
pub mod section;
pub mod simd;
mod step_sizes;
pub mod steppers;
mod stepping;
pub mod tangent;
mod trajectory;
pub mod vector_field;
mod watch;

pub use control::{StepControl, Tolerance};
pub use drive::{Request, Sink};
pub use equivariant::{Equivariant, Symmetry};
pub use error::Error;
pub use exponential_orbit::ExponentialOrbit;
pub use integration::Integration;
pub use model::{InPlane, Model, Outline, Shape};
pub use noise::{Diffusion, ModelNoise, Noise, Normal};
pub use noise_steps::NoiseSteps;
pub use noisy_orbit::NoisyOrbit;
pub use orbit::Orbit;
pub use outcome::{Obstacle, Outcome};
pub use scalar::{Bundle, Complex, Dual, Mask, ROW_BLOCK, Row, Scalar};
pub use section::{Direction, Section};
pub use simd::Lanes;
pub use tangent::Tangent;
pub use trajectory::{CrossingPoint, Trajectory};
pub use vector_field::{Semilinear, System, VectorField};
pub use watch::{Part, StopOnly, Watch};
