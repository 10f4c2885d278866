//! All integration tests of this crate, in one program: what is generic is compiled once.

mod common;
mod correlation;
mod coverage;
mod displacement;
mod distributions;
mod input;
mod passage;
mod power;
mod quantiles;
mod records;
