//! Orbits and exponents in lanes against single orbits: the same bits, on every instruction set of this machine that has lanes.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

mod amplitude_lanes;
mod exponent_lanes;
mod noisy_lanes;
mod single;
mod tensor_lanes;
