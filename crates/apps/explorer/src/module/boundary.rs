//! The boundary to the worker's JavaScript: exported functions over linear memory, and functions that the worker provides. No bindings are
//! generated, so there is nothing to keep in step but this file and `apps/explorer/web/src/alone/engine.ts`.
//!
//! A text comes in by [`buffer`], which gives the place to write it to, and the length that the next call
//! names. Messages go out by a pointer and a length, which the worker copies before it returns.
//!
//! Why it is sound: the module has one thread. The worker's functions take pointers into memory that is
//! borrowed for the call and written by nobody meanwhile; they keep none of them, and call nothing of this
//! module.

#![allow(unsafe_code, reason = "calls to the worker, and names that it finds; see above")]
#![allow(unreachable_pub, reason = "the exports are for the worker")]

use std::cell::RefCell;

// What the worker provides.
#[link(wasm_import_module = "worker")]
unsafe extern "C" {
    /// The time in milliseconds, from any origin.
    fn now() -> f64;
    /// A message to the page: text.
    fn text(start: *const u8, length: usize);
    /// A message to the page: bytes.
    fn binary(start: *const u8, length: usize);
    /// An errand for a helper.
    fn post(start: *const u8, length: usize);
    /// An errand that goes back from a helper.
    fn back(start: *const u8, length: usize);
    /// The message of a panic, before the module ends.
    fn fault(start: *const u8, length: usize);
}

/// A channel to the worker.
#[derive(Clone, Copy)]
pub(crate) enum Channel {
    Text,
    Binary,
    Post,
    Back,
    Fault,
}

/// Gives these bytes to the worker.
pub(crate) fn send(channel: Channel, bytes: &[u8]) {
    let (start, length) = (bytes.as_ptr(), bytes.len());
    // SAFETY: the bytes live until the call returns; see the head of this file.
    unsafe {
        match channel {
            Channel::Text => text(start, length),
            Channel::Binary => binary(start, length),
            Channel::Post => post(start, length),
            Channel::Back => back(start, length),
            Channel::Fault => fault(start, length),
        }
    }
}

/// The time in milliseconds.
pub(crate) fn milliseconds() -> f64 {
    // SAFETY: it takes nothing and gives a number.
    unsafe { now() }
}

thread_local! {
    /// The text that comes in.
    static INCOMING: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// Room for a text of this length: where to write it. It is read by the next call that names a length.
// SAFETY of every name: nothing else in this module has it.
#[unsafe(no_mangle)]
pub extern "C" fn buffer(length: usize) -> *mut u8 {
    INCOMING.with_borrow_mut(|incoming| {
        incoming.clear();
        incoming.resize(length, 0);
        incoming.as_mut_ptr()
    })
}

/// The text that was written to the buffer.
fn incoming(length: usize) -> String {
    let bytes = INCOMING.take();
    String::from_utf8_lossy(&bytes[..length.min(bytes.len())]).into_owned()
}

/// Begins a session with so many helpers for maps. It greets the page.
#[unsafe(no_mangle)]
pub extern "C" fn begin(mappers: usize) {
    super::page::begin(mappers);
}

/// Answers a message of the page.
#[unsafe(no_mangle)]
pub extern "C" fn hear(length: usize) {
    super::page::hear(&incoming(length));
}

/// Takes what a helper sends back.
#[unsafe(no_mangle)]
pub extern "C" fn report(length: usize) {
    super::page::report(&incoming(length));
}

/// Does the job of an errand, in a helper.
#[unsafe(no_mangle)]
pub extern "C" fn assist(length: usize) {
    super::page::assist(&incoming(length));
}
