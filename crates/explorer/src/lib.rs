//! `motiform explore`: the explorer in a browser.
//!
//! A server for one user on one machine: it listens on 127.0.0.1 only, every address contains a random token, and a page
//! can only send the messages of `protocol`: no file is read or written for it. The page is built into the program.
//! `PROTOCOL.md` describes the messages between the two.
//!
//! Each page has a `session`: a body that moves when the page requests it (`body`), and workers (`worker`), which run only the
//! latest job: classification of the motion and its exponents (`motion`), the map (`map`), and branches of motions (`branches`).

mod answers;
mod body;
mod branches;
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

pub use catalogue::StudyFile;
pub use error::Error;
pub use guard::Token;
pub use protocol::typescript;
pub use server::{DEFAULT_PORT, Handle, Options, Server};
