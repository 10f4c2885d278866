//! The explorer: what one page asks and is answered, over any transport, and the server of `motiform explore`.
//!
//! A session has a body, which moves when the page requests a picture (`body`), and background computations (`task`): the
//! classification of the motion and its exponents (`motion`), the map (`map`), branches of motions (`branches`), returns computed in
//! advance, and the motions of a swarm. Of each kind only the latest request is computed. `PROTOCOL.md`
//! describes the messages (`protocol`, `frames`).
//!
//! The same session runs in two ways. [`Session`] (feature `threads`) has threads of its own, behind the
//! [`server`] (feature `server`). [`Local`] has none: it does a bounded piece of work for each message, and
//! leaves the computations beside the body to other instances of this program ([`assist`]), as in the workers
//! of a browser.

mod answers;
mod body;
mod branches;
mod catalogue;
mod export;
mod frames;
mod greeting;
mod local;
mod map;
#[cfg(target_arch = "wasm32")]
mod module;
mod motion;
mod protocol;
#[cfg(feature = "server")]
pub mod server;
#[cfg(feature = "threads")]
mod session;
mod share;
mod task;
mod tracked;

pub use answers::{Answer, Answers, Gone, refusal};
pub use catalogue::{Catalogue, StudyFile, file_name};
pub use greeting::Greeting;
pub use local::{Local, assist};
pub use protocol::{LONGEST, Request, typescript};
#[cfg(feature = "threads")]
pub use session::Session;
pub use share::quoted;
pub use task::{Errand, Post};
pub use tracked::TrackedCell;
