//! All integration tests of this crate, in one program: what is generic is compiled once.

mod amplitude_lanes;
mod amplitudes;
mod analytic_diagram;
mod basins;
mod common;
mod drawing;
mod ensemble;
mod equilibria;
mod files;
mod fuzz;
mod given;
mod hdf5;
mod lasting;
mod lifetimes;
mod live;
mod many;
mod naming;
mod noise;
mod noisy_lanes;
mod perturbation;
mod plan;
mod presets;
mod questions;
mod random;
mod recorder;
mod saddle;
#[path = "../../../../samples.rs"]
mod samples;
mod scan;
mod scan_lanes;
mod settings;
mod starts;
mod statistics;
mod study_toml;
mod tolerances;
