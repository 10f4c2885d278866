//! Tests of tracked cells: synthetic bodies as outlines in files, and what is said of them.

mod bodies;
mod observed;
mod round_trip;
