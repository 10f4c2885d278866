//! All integration tests of this crate, in one program: what is generic is compiled once.

mod blow_up;
mod common;
mod diffusion;
mod exponential;
mod lanes;
mod noise;
mod orders;
mod phi_functions;
mod projection;
mod restart;
mod scalars;
mod sections;
mod tangent;
