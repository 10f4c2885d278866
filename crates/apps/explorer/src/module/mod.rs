//! The explorer's session as a WebAssembly module: what a page without a server computes with.
//!
//! One module, two roles. In the worker of the body it holds a session: `begin`, `hear` a message of the page, `report` what a helper
//! found. In the worker of a helper it does the jobs that the session posts: `assist`. The texts and binary
//! messages are exactly those of the WebSocket (`PROTOCOL.md`). Built by `cargo xtask web`, as a `cdylib` of this crate
//! without its features.

mod boundary;
mod page;
