//! All integration tests of this crate, in one program: what is generic is compiled once.

mod common;
mod correlation;
mod coverage;
mod diffusion;
mod displacement;
mod distributions;
mod gaps;
mod input;
mod oscillation;
mod passage;
mod power;
mod quantiles;
mod records;
