//! All integration tests of this crate, in one program: what is generic is compiled once.

mod mutants;
mod paper;
mod reproduction_equations;
mod reproduction_fig123;
mod reproduction_fig45;
mod reproduction_fig6;
