//! All integration tests of this crate, in one program: what is generic is compiled once.

mod bodies;
mod datasets;
