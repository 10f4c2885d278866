//! The widest vector instructions of this machine: eight numbers at a time, chosen when the program runs.
//!
//! Two kinds of work are compiled once for each instruction set and dispatched here:
//! * a [`Kernel`] is plain loops over `f64`, left to the compiler;
//! * a [`LaneKernel`] is written over a [`Bundle`]: one orbit in each lane, as many as a register or two hold; one lane where there are no vector
//!   registers to speak of.
//!
//! [`Arithmetic::Reproducible`] never fuses a multiplication with an addition, so every machine and every width computes
//! the same bits. [`Arithmetic::Fused`] does so wherever [`crate::Scalar::mul_add`] is written: other last bits than the
//! reproducible ones, but again the same on every machine, for a fused operation is exactly rounded.

mod packed;
#[cfg(target_arch = "x86_64")]
mod x86;

pub use packed::{Packed, Pair, Registers};

use crate::scalar::{Bundle, Lanes};

/// A piece of work worth vector instructions. `run` and all that it calls must be `#[inline(always)]` functions (not
/// closures), or they are compiled for the smallest machine.
pub trait Kernel {
    /// What it computes.
    type Output;

    /// Does the work.
    fn run(self) -> Self::Output;
}

/// A piece of work over eight lanes. As with [`Kernel`], all that it calls must be `#[inline(always)]`.
pub trait LaneKernel {
    /// What it computes.
    type Output;

    /// Whether two registers side by side are faster than one: where the work fits into few registers and waits for
    /// itself.
    const PAIRED: bool = false;

    /// Does the work with bundles of type `B`.
    fn run<B: Bundle>(self) -> Self::Output;
}

/// Whether products and sums are rounded one by one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Arithmetic {
    /// Every operation is rounded: the bits of a single orbit over `f64`.
    #[default]
    Reproducible,
    /// `a b + c` is rounded once: faster, other last bits.
    Fused,
}

/// The instruction sets that lanes are compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum InstructionSet {
    /// What every processor of this architecture has: one lane.
    Portable,
    /// 256-bit registers, four lanes each.
    Avx2,
    /// 512-bit registers, eight lanes each.
    Avx512,
}

impl InstructionSet {
    /// The widest one of this machine.
    #[must_use]
    pub fn widest() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            x86::widest()
        }
        #[cfg(not(target_arch = "x86_64"))]
        {
            Self::Portable
        }
    }

    /// All that this machine has, the narrowest first.
    #[must_use]
    pub fn available() -> Vec<Self> {
        let widest = Self::widest();
        [Self::Portable, Self::Avx2, Self::Avx512].into_iter().filter(|&set| set <= widest).collect()
    }
}

impl Default for InstructionSet {
    /// The widest one of this machine.
    fn default() -> Self {
        Self::widest()
    }
}

/// Runs a kernel with the widest instructions there are.
#[inline]
pub fn run<K: Kernel>(kernel: K) -> K::Output {
    #[cfg(target_arch = "x86_64")]
    {
        x86::run(kernel)
    }
    #[cfg(not(target_arch = "x86_64"))]
    {
        kernel.run()
    }
}

/// Runs a lane kernel with the widest instructions there are.
///
/// On a machine without fused instructions [`Arithmetic::Fused`] gives the same bits as on any other, slowly.
pub fn run_lanes<K: LaneKernel>(arithmetic: Arithmetic, kernel: K) -> K::Output {
    run_lanes_on(InstructionSet::widest(), arithmetic, kernel)
}

/// As [`run_lanes`], with the instructions of `set`, or the widest ones if this machine does not have them.
pub fn run_lanes_on<K: LaneKernel>(set: InstructionSet, arithmetic: Arithmetic, kernel: K) -> K::Output {
    #[cfg(target_arch = "x86_64")]
    if set.min(InstructionSet::widest()) > InstructionSet::Portable {
        return x86::run_lanes(set, arithmetic, kernel);
    }
    let _ = set;
    match arithmetic {
        Arithmetic::Reproducible => kernel.run::<Lanes<1, false>>(),
        Arithmetic::Fused => kernel.run::<Lanes<1, true>>(),
    }
}
