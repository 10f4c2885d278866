//! `motiform explore`: the explorer in a browser.
//!
//! A server for one user on one machine: it listens on 127.0.0.1 only, every address contains a random token, and a page
//! can only send the messages of the protocol: no file is read or written for it. The page is built into the program.
//! `PROTOCOL.md` describes the messages between the two; `motiform-session` answers them, with threads for each page.

mod accept;
mod connection;
mod error;
mod guard;
mod handover;
mod http;
mod outbox;
mod page;
mod pages;
mod rate;
mod routes;
mod server;
mod timed;

pub use accept::Patience;
pub use error::Error;
pub use guard::Token;
pub use handover::Handover;
pub use motiform_session::{StudyFile, TrackedCell, typescript};
pub use server::{DEFAULT_PORT, Handle, Options, Server};
