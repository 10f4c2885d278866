//! All integration tests of this crate, in one program: what is generic is compiled once.

mod accuracy;
mod amplitude_lanes;
mod amplitudes;
mod cell;
mod cell_accuracy;
mod cell_feedback;
mod cell_motion;
mod cell_velocity;
mod noise;
mod reduced;
mod registry;
mod tensor;
mod texts;
mod zoo;
