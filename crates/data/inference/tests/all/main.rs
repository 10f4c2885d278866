//! All integration tests of this crate, in one program: what is generic is compiled once.

mod average;
mod change;
mod common;
mod converge;
mod definition;
mod draws;
mod filter;
mod fit;
mod four_modes;
mod handed;
mod identifiability;
mod ladder;
mod library;
mod null;
mod order_five;
mod place;
mod pooled;
#[path = "../../../../samples.rs"]
mod samples;
mod stage;
mod stretch;
mod subsets;
mod together;
mod together_walk;
mod trust;
mod two_modes;
mod values;
mod walk;
mod warnings;
mod weak;
