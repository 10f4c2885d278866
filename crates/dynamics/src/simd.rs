//! The widest vector instructions of this machine, for a kernel's plain loops. The only file that knows of them.
//!
//! A kernel is compiled once for each instruction set and the right one is chosen when it runs. Nothing is fused or
//! reordered, so every machine computes the same bits.

use fearless_simd::{Level, dispatch};

/// A piece of work worth vector instructions. `run` and all that it calls must be `#[inline(always)]` functions (not
/// closures), or they are compiled for the smallest machine.
pub trait Kernel {
    /// What it computes.
    type Output;

    /// Does the work.
    fn run(self) -> Self::Output;
}

/// Runs a kernel with the widest instructions there are.
#[inline]
pub fn run<K: Kernel>(kernel: K) -> K::Output {
    dispatch!(Level::new(), _simd => kernel.run())
}
