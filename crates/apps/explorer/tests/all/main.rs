//! All integration tests of this crate, in one program: what is generic is compiled once.

mod branches;
mod common;
mod fuzz;
mod hand;
mod maps;
mod protocol;
mod server;
mod session;
mod stop;
