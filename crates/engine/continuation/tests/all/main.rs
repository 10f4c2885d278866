//! All integration tests of this crate, in one program: what is generic is compiled once.

mod classics;
mod close;
mod codimension_2;
#[path = "../../../analysis/tests/all/common/mod.rs"]
mod common;
mod connections;
mod curves;
mod ends;
mod equilibria;
mod flat;
mod meeting;
