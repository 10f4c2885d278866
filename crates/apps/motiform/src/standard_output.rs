//! The state of standard output when the program started, which may have been closed (`motiform ... >&-`): the only file of this crate
//! with `unsafe`.
//!
//! The standard library opens `/dev/null` in the place of a standard descriptor that is closed, before `main`: every result would be lost
//! in silence, with exit code 0. In `main` that cannot be told from `> /dev/null` or Python's `subprocess.DEVNULL`, which are asked
//! for. The loader calls the functions of a section of the program before that, and one of them looks. It has no arguments, allocates
//! nothing, and uses nothing of the standard library that has to be set up. Tests: tests/all/closed_output.rs.

#![allow(
    unsafe_code,
    reason = "a function in a section of the loader, and a descriptor by its number; see above"
)]

use rustix::fd::BorrowedFd;
use rustix::io::{Errno, fcntl_getfd};
use std::sync::atomic::{AtomicBool, Ordering};

static CLOSED: AtomicBool = AtomicBool::new(false);

#[used]
#[cfg_attr(not(target_vendor = "apple"), unsafe(link_section = ".init_array"))]
#[cfg_attr(target_vendor = "apple", unsafe(link_section = "__DATA,__mod_init_func"))]
static LOOK: extern "C" fn() = look;

extern "C" fn look() {
    // SAFETY: the descriptor is only asked about, by a call that is defined for closed ones, too.
    let stdout = unsafe { BorrowedFd::borrow_raw(1) };
    CLOSED.store(fcntl_getfd(stdout) == Err(Errno::BADF), Ordering::Relaxed);
}

/// `true` if standard output was closed when the program started.
pub(crate) fn was_closed() -> bool {
    CLOSED.load(Ordering::Relaxed)
}
