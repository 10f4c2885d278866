//! All integration tests of this crate, in one program.

mod common;
mod drives;
mod fuzz;
mod local;
