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
mod equal;
mod equilibria;
mod families;
mod flat;
mod lost_curves;
mod meeting;
mod normal_forms;
mod offsets;
mod orbits;
mod path;
mod random_texts;
mod ranges;
#[path = "../../../../samples.rs"]
mod samples;
mod shrinking;
mod symmetric_hopf;
mod symmetric_rest;
