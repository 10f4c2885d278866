//! Statistics of many bodies, simulated or read.

mod bodies;
#[path = "../../../../../data/statistics/tests/all/common.rs"]
#[allow(dead_code, reason = "processes of the tests of crate statistics")]
mod common;
mod coverage;
mod datasets;
mod invariance;
mod motions;
mod sampling;
