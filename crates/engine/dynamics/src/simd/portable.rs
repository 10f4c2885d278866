//! Lanes in plain arrays: available on every machine, and the oracle of the others.

use super::{Packed, Registers};

/// `N` independent `f64`, one orbit in each lane: in each the bits that the same computation gives over `f64`, for any `N`.
///
/// For speed the lanes are in vector registers ([`super::run_lanes`]).
pub type Lanes<const N: usize> = Packed<[f64; N]>;

/// Lane by lane `operation(a, b)`.
#[inline(always)]
fn zip<const N: usize>(mut a: [f64; N], b: [f64; N], operation: impl Fn(f64, f64) -> f64) -> [f64; N] {
    for lane in 0..N {
        a[lane] = operation(a[lane], b[lane]);
    }
    a
}

/// The lanes in which `holds(a, b)`.
#[inline(always)]
fn mask<const N: usize>(a: [f64; N], b: [f64; N], holds: impl Fn(f64, f64) -> bool) -> u16 {
    let mut mask = 0;
    for lane in 0..N {
        mask |= u16::from(holds(a[lane], b[lane])) << lane;
    }
    mask
}

impl<const N: usize> Registers for [f64; N] {
    const LANES: usize = N;

    #[inline(always)]
    fn load(lanes: &[f64]) -> Self {
        let mut all = [0.0; N];
        all.copy_from_slice(&lanes[..N]);
        all
    }

    #[inline(always)]
    fn store(self, lanes: &mut [f64]) {
        lanes[..N].copy_from_slice(&self);
    }

    #[inline(always)]
    fn splat(value: f64) -> Self {
        [value; N]
    }

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        zip(self, other, |a, b| a + b)
    }

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        zip(self, other, |a, b| a - b)
    }

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        zip(self, other, |a, b| a * b)
    }

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        zip(self, other, |a, b| a / b)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.map(f64::abs)
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        zip(self, other, |a, b| if a < b { b } else { a })
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        zip(self, other, |a, b| if b < a { b } else { a })
    }

    #[inline(always)]
    fn less(self, other: Self) -> u16 {
        mask(self, other, |a, b| a < b)
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> u16 {
        mask(self, other, |a, b| a <= b)
    }

    #[inline(always)]
    fn select(mask: u16, a: Self, b: Self) -> Self {
        std::array::from_fn(|lane| if mask >> lane & 1 == 1 { a[lane] } else { b[lane] })
    }
}
