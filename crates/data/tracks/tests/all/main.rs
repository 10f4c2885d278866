//! All integration tests of this crate, in one program: what is generic is compiled once.

mod common;
mod damaged;
mod fits;
mod form;
mod formats;
mod fuzz;
mod given;
mod imagej;
mod inputs;
mod masks;
mod pulls;
mod quality;
mod round_trip;
mod scale;
mod symmetry;
mod tables;
mod tangent;
mod trackmate;
