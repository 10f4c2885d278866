//! The explorer's session as a WebAssembly module: what a page without a server computes with.
//!
//! One module, two roles. In the worker of the body it holds a session: `begin`, `hear` a message of the page, `report` what a helper
//! found. In the worker of a helper it does the jobs that the session posts: `assist`. The texts and binary
//! messages are exactly those of the WebSocket (`crates/apps/explorer/PROTOCOL.md`). Built by `cargo xtask web`;
//! elsewhere this crate is empty.

#[cfg(target_arch = "wasm32")]
mod boundary;
#[cfg(target_arch = "wasm32")]
mod page;
