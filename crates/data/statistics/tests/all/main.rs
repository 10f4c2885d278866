//! All integration tests of this crate, in one program: what is generic is compiled once.

mod blocks;
mod common;
mod correlation;
mod coverage;
mod diffusion;
mod displacement;
mod distributions;
mod gaps;
mod input;
mod jackknife;
mod oscillation;
mod passage;
mod power;
mod records;
mod resolution;
#[path = "../../../../samples.rs"]
mod samples;
mod slow;
mod stationary;
