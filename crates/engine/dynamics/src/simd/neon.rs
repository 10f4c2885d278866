//! NEON, which every 64-bit Arm processor has: two lanes in a register, four in the pairs that are used.
//!
//! Why it is sound: the instructions are part of the architecture's baseline, so every processor that runs this has them; none of those
//! used here takes a pointer. Tests: `tests/all/lanes.rs`, every operation against `f64`.

#![allow(unsafe_code, reason = "vector instructions; see above")]

use super::Registers;
use std::arch::aarch64::*;

/// Two 128-bit registers.
#[derive(Clone, Copy)]
pub(super) struct Neon([float64x2_t; 2]);

/// The two bits of a comparison.
#[inline(always)]
fn bits(lanes: uint64x2_t) -> u16 {
    // SAFETY of every block: see the head of this file.
    let (one, other) = unsafe { (vgetq_lane_u64::<0>(lanes), vgetq_lane_u64::<1>(lanes)) };
    u16::from(one != 0) | u16::from(other != 0) << 1
}

/// All bits of each lane whose bit is set.
#[inline(always)]
fn lanes(mask: u16) -> uint64x2_t {
    let all = |bit: u16| if mask >> bit & 1 == 1 { u64::MAX } else { 0 };
    unsafe { vsetq_lane_u64::<1>(all(1), vdupq_n_u64(all(0))) }
}

#[inline(always)]
fn pair(one: f64, other: f64) -> float64x2_t {
    unsafe { vsetq_lane_f64::<1>(other, vdupq_n_f64(one)) }
}

impl Neon {
    #[inline(always)]
    fn zip(self, other: Self, operation: impl Fn(float64x2_t, float64x2_t) -> float64x2_t) -> Self {
        Self([operation(self.0[0], other.0[0]), operation(self.0[1], other.0[1])])
    }

    #[inline(always)]
    fn compare(self, other: Self, operation: impl Fn(float64x2_t, float64x2_t) -> uint64x2_t) -> u16 {
        bits(operation(self.0[0], other.0[0])) | bits(operation(self.0[1], other.0[1])) << 2
    }
}

impl Registers for Neon {
    const LANES: usize = 4;

    #[inline(always)]
    fn load(lanes: &[f64]) -> Self {
        let lanes = &lanes[..4];
        Self([pair(lanes[0], lanes[1]), pair(lanes[2], lanes[3])])
    }

    #[inline(always)]
    fn store(self, lanes: &mut [f64]) {
        for (to, from) in lanes[..4].chunks_exact_mut(2).zip(self.0) {
            (to[0], to[1]) = unsafe { (vgetq_lane_f64::<0>(from), vgetq_lane_f64::<1>(from)) };
        }
    }

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self([unsafe { vdupq_n_f64(value) }; 2])
    }

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| unsafe { vaddq_f64(a, b) })
    }

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| unsafe { vsubq_f64(a, b) })
    }

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| unsafe { vmulq_f64(a, b) })
    }

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.zip(other, |a, b| unsafe { vdivq_f64(a, b) })
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.map(|a| unsafe { vsqrtq_f64(a) }))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.map(|a| unsafe { vabsq_f64(a) }))
    }

    // NEON's own maximum gives no number where one is none; what is wanted is `a` then.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.zip(other, |a, b| unsafe { vbslq_f64(vcltq_f64(a, b), b, a) })
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.zip(other, |a, b| unsafe { vbslq_f64(vcltq_f64(b, a), b, a) })
    }

    #[inline(always)]
    fn less(self, other: Self) -> u16 {
        self.compare(other, |a, b| unsafe { vcltq_f64(a, b) })
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> u16 {
        self.compare(other, |a, b| unsafe { vcleq_f64(a, b) })
    }

    #[inline(always)]
    fn select(mask: u16, a: Self, b: Self) -> Self {
        let half = |part: usize| unsafe { vbslq_f64(lanes(mask >> (2 * part)), a.0[part], b.0[part]) };
        Self([half(0), half(1)])
    }
}
