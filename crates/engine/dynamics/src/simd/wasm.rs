//! The vector instructions of WebAssembly: two lanes in a register, four in the pairs that are used.
//!
//! A module either has these instructions everywhere or cannot be loaded, so there is nothing to detect: they are used where the module is
//! built with them (`-C target-feature=+simd128`), and its functions for them are safe. Tests:
//! `apps/explorer/web/tests/module.test.mjs`, whole maps against those of this machine, to the bit.

use super::Registers;
use std::arch::wasm32::*;

/// Two 128-bit registers.
#[derive(Clone, Copy)]
pub(super) struct Simd128([v128; 2]);

/// The two bits of a comparison.
#[inline(always)]
fn bits(lanes: v128) -> u16 {
    u16::from(i64x2_bitmask(lanes))
}

/// All bits of each lane whose bit is set.
#[inline(always)]
fn lanes(mask: u16) -> v128 {
    let all = |bit: u16| -i64::from(mask >> bit & 1);
    i64x2(all(0), all(1))
}

impl Simd128 {
    #[inline(always)]
    fn zip(self, other: Self, operation: impl Fn(v128, v128) -> v128) -> Self {
        Self([operation(self.0[0], other.0[0]), operation(self.0[1], other.0[1])])
    }

    #[inline(always)]
    fn compare(self, other: Self, operation: impl Fn(v128, v128) -> v128) -> u16 {
        bits(operation(self.0[0], other.0[0])) | bits(operation(self.0[1], other.0[1])) << 2
    }
}

impl Registers for Simd128 {
    const LANES: usize = 4;

    #[inline(always)]
    fn load(lanes: &[f64]) -> Self {
        let lanes = &lanes[..4];
        Self([f64x2(lanes[0], lanes[1]), f64x2(lanes[2], lanes[3])])
    }

    #[inline(always)]
    fn store(self, lanes: &mut [f64]) {
        for (to, from) in lanes[..4].chunks_exact_mut(2).zip(self.0) {
            (to[0], to[1]) = (f64x2_extract_lane::<0>(from), f64x2_extract_lane::<1>(from));
        }
    }

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self([f64x2_splat(value); 2])
    }

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| f64x2_add(a, b))
    }

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| f64x2_sub(a, b))
    }

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| f64x2_mul(a, b))
    }

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.zip(other, |a, b| f64x2_div(a, b))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.map(|a| f64x2_sqrt(a)))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.map(|a| f64x2_abs(a)))
    }

    // `b` where `a < b`, else `a`: what `pmax` does, where `max` gives no number if one is none.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.zip(other, |a, b| f64x2_pmax(a, b))
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.zip(other, |a, b| f64x2_pmin(a, b))
    }

    #[inline(always)]
    fn less(self, other: Self) -> u16 {
        self.compare(other, |a, b| f64x2_lt(a, b))
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> u16 {
        self.compare(other, |a, b| f64x2_le(a, b))
    }

    #[inline(always)]
    fn select(mask: u16, a: Self, b: Self) -> Self {
        let half = |part: usize| v128_bitselect(a.0[part], b.0[part], lanes(mask >> (2 * part)));
        Self([half(0), half(1)])
    }
}
