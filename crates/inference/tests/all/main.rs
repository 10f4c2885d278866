//! All integration tests of this crate, in one program: what is generic is compiled once.

mod common;
mod definition;
mod filter;
mod fit;
mod handed;
mod identifiability;
mod library;
mod place;
mod subsets;
mod warnings;
mod weak;
