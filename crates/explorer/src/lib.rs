//! `motiform explore`: parameter space in a browser.
//!
//! A server for one person on one machine: it listens on 127.0.0.1 alone, every address carries a random token, and a page
//! reaches nothing but what `protocol` says: no file is read or written for it. The page is built into the program.
//! What is said between the two stands in `PROTOCOL.md`.
//!
//! Each page has a `session`: a body that moves when the page asks (`body`), and two workers (`worker`), for which only the
//! latest job counts: naming the motion and its exponents (`motion`), and the map (`map`).

mod answers;
mod body;
mod catalogue;
mod connection;
mod error;
mod export;
mod frames;
mod guard;
mod map;
mod motion;
mod page;
mod protocol;
mod rate;
mod server;
mod session;
mod share;
mod worker;

pub use error::Error;
pub use guard::Token;
pub use protocol::typescript;
pub use server::{DEFAULT_PORT, Handle, Options, Server};
