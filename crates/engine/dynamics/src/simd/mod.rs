//! The widest vector instructions of this machine: eight numbers at a time, chosen when the program runs.
//!
//! Two kinds of work are compiled once for each instruction set and dispatched here:
//! * a [`Kernel`] is plain loops over `f64`, left to the compiler;
//! * a [`LaneKernel`] is written over a [`Bundle`]: one orbit in each lane; one lane if there are no suitable vector
//!   registers.
//!
//! A multiplication is never fused with an addition, so every machine and every width computes the same bits.

#[cfg(target_arch = "aarch64")]
mod neon;
mod packed;
mod portable;
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
mod wasm;
#[cfg(target_arch = "x86_64")]
mod x86;

pub use packed::{Packed, Registers};
pub use portable::Lanes;

use crate::scalar::Bundle;

/// Work that benefits from vector instructions. `run` and all that it calls must be `#[inline(always)]` functions (not
/// closures), otherwise they are compiled for the baseline instruction set.
pub trait Kernel {
    /// The result of the kernel.
    type Output;

    /// Does the work.
    fn run(self) -> Self::Output;
}

/// A piece of work over eight lanes. As with [`Kernel`], all that it calls must be `#[inline(always)]`.
pub trait LaneKernel {
    /// The result of the kernel.
    type Output;

    /// `false` where registers of 512 bits would save little: then there is one kernel to compile for x86-64 instead of two, for those of
    /// 256 bits. The bits of results are the same.
    const WIDE: bool = true;

    /// Does the work with bundles of type `B`.
    fn run<B: Bundle>(self) -> Self::Output;
}

/// The instruction sets that lanes are compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum InstructionSet {
    /// The baseline of this architecture: one lane.
    Portable,
    /// Pairs of 128-bit registers of WebAssembly, four lanes each.
    Simd128,
    /// Pairs of 128-bit registers of 64-bit Arm processors, four lanes each.
    Neon,
    /// 256-bit registers, four lanes each.
    Avx2,
    /// 512-bit registers, eight lanes each.
    Avx512,
}

impl InstructionSet {
    /// The widest one of this machine.
    pub fn widest() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            x86::widest()
        }
        #[cfg(target_arch = "aarch64")]
        {
            Self::Neon
        }
        #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
        {
            Self::Simd128
        }
        #[cfg(not(any(
            target_arch = "x86_64",
            target_arch = "aarch64",
            all(target_arch = "wasm32", target_feature = "simd128")
        )))]
        {
            Self::Portable
        }
    }

    /// All those of this machine, the narrowest first.
    pub fn available() -> Vec<Self> {
        let widest = Self::widest();
        let elsewhere = |set: &Self| match set {
            Self::Simd128 => !cfg!(target_arch = "wasm32"),
            Self::Neon => !cfg!(target_arch = "aarch64"),
            _ => false,
        };
        let all = [Self::Portable, Self::Simd128, Self::Neon, Self::Avx2, Self::Avx512];
        all.into_iter().filter(|set| *set <= widest && !elsewhere(set)).collect()
    }
}

impl Default for InstructionSet {
    /// The widest one of this machine.
    fn default() -> Self {
        Self::widest()
    }
}

/// Runs a kernel with the widest available instructions.
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

/// Runs a lane kernel with the widest available instructions.
pub fn run_lanes<K: LaneKernel>(kernel: K) -> K::Output {
    run_lanes_on(InstructionSet::widest(), kernel)
}

/// As [`run_lanes`] if there are vector registers; otherwise `None`, without any work: single orbits give the same
/// bits, and no kernel needs to be compiled for one lane.
pub fn run_wide<K: LaneKernel>(kernel: K) -> Option<K::Output> {
    run_wide_on(InstructionSet::widest(), kernel)
}

/// As [`run_wide`], with the instructions of `set`, or the widest ones if this machine does not have them.
pub fn run_wide_on<K: LaneKernel>(set: InstructionSet, kernel: K) -> Option<K::Output> {
    #[cfg(target_arch = "x86_64")]
    if set.min(InstructionSet::widest()) > InstructionSet::Portable {
        return Some(x86::run_lanes(set, kernel));
    }
    let _ = set;
    #[cfg(target_arch = "aarch64")]
    {
        Some(kernel.run::<Packed<neon::Neon>>())
    }
    #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
    {
        Some(kernel.run::<Packed<wasm::Simd128>>())
    }
    #[cfg(not(any(target_arch = "aarch64", all(target_arch = "wasm32", target_feature = "simd128"))))]
    {
        let _ = kernel;
        None
    }
}

/// Returns `true` if this machine has vector registers that lanes are compiled for.
pub fn has_lanes() -> bool {
    InstructionSet::widest() > InstructionSet::Portable
}

/// As [`run_lanes`], with the instructions of `set`, or the widest ones if this machine does not have them.
pub fn run_lanes_on<K: LaneKernel>(set: InstructionSet, kernel: K) -> K::Output {
    #[cfg(target_arch = "x86_64")]
    if set.min(InstructionSet::widest()) > InstructionSet::Portable {
        return x86::run_lanes(set, kernel);
    }
    #[cfg(target_arch = "aarch64")]
    if set > InstructionSet::Portable {
        return kernel.run::<Packed<neon::Neon>>();
    }
    #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
    if set > InstructionSet::Portable {
        return kernel.run::<Packed<wasm::Simd128>>();
    }
    let _ = set;
    kernel.run::<Lanes<1>>()
}
