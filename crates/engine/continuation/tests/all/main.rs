//! All integration tests of this crate, in one program: what is generic is compiled once.

mod canards;
mod classics;
mod close;
mod codimension_2;
#[path = "../../../analysis/tests/all/common/mod.rs"]
mod common;
mod connections;
mod curves;
mod ends;
mod equilibria;
mod families;
mod flat;
mod meeting;
