//! All integration tests of this crate, in one program: what is generic is compiled once.

mod back_and_forth;
mod bodies;
mod classification_of_the_cell;
mod common;
mod conservative;
mod deflation;
mod equilibrium;
mod escape;
mod heteroclinic;
mod implicit;
mod isotropy;
mod lanes;
mod lasting;
mod leaving_a_rest;
mod legs;
mod lifetime;
mod long_runs;
mod lyapunov;
mod periodic;
mod regimes;
mod rest_law;
mod rests;
mod returns;
mod same_set;
#[path = "../../../../samples.rs"]
mod samples;
mod series_mean;
mod share;
mod steady;
mod symmetric_motions;
mod symmetry;
mod texts;
mod thresholds;
mod welch;
mod zero_one;
mod zoo;
