//! All integration tests of this crate, in one program: what is generic is compiled once.

mod bad_input;
mod bits;
mod bounds;
mod cell;
mod common;
mod continuation;
mod contract;
mod curves;
mod drawing;
mod equations;
mod explore;
mod faults;
mod fits;
mod fuzz;
mod interruption;
mod kills;
mod layers;
mod lifetimes;
mod motions;
mod observe;
mod outcomes;
mod ownership;
mod scan;
mod startup;
mod statistics;
mod steady;
