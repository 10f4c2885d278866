//! Tests of tracked cells: synthetic bodies as outlines in files, and what is said of them.

mod bifurcations;
mod bodies;
mod cameras;
mod common_walk;
mod doubts;
mod every_format;
mod field;
mod format_writers;
mod matrix;
mod numbers;
mod numbers_together;
mod observed;
mod pages;
mod population;
mod prediction;
mod rates;
mod recordings;
mod relatives;
mod round_trip;
mod sample;
#[path = "../../../../samples.rs"]
mod samples;
