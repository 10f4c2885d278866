//! Real scalars that hold one or more orbits: what step-size control needs beyond arithmetic.

use super::Scalar;
use std::ops::{BitAnd, BitAndAssign, BitOr, BitOrAssign, Not};

/// Maximum number of lanes of any bundle.
pub const MOST_LANES: usize = 16;

/// One bit per lane, lane 0 the lowest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Mask(pub u16);

impl Mask {
    /// Lane `lane` alone.
    #[inline(always)]
    pub fn only(lane: usize) -> Self {
        Self(1 << lane)
    }

    /// The first `count` lanes.
    #[inline(always)]
    pub fn first(count: usize) -> Self {
        Self(u16::MAX >> (16 - count))
    }

    /// Returns `true` if lane `lane` is set.
    #[inline(always)]
    pub fn has(self, lane: usize) -> bool {
        self.0 >> lane & 1 == 1
    }

    /// Returns `true` if any lane is set.
    #[inline(always)]
    pub fn any(self) -> bool {
        self.0 != 0
    }

    /// The lanes that are set, the lowest first.
    #[inline(always)]
    pub fn lanes(self) -> impl Iterator<Item = usize> {
        let mut rest = self.0;
        std::iter::from_fn(move || {
            let lane = (rest != 0).then_some(rest.trailing_zeros() as usize)?;
            rest &= rest - 1;
            Some(lane)
        })
    }
}

impl BitAnd for Mask {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
}

impl BitOr for Mask {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl BitAndAssign for Mask {
    #[inline(always)]
    fn bitand_assign(&mut self, other: Self) {
        self.0 &= other.0;
    }
}

impl BitOrAssign for Mask {
    #[inline(always)]
    fn bitor_assign(&mut self, other: Self) {
        self.0 |= other.0;
    }
}

impl Not for Mask {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self(!self.0)
    }
}

/// Several real numbers, one per orbit: `f64` itself (one lane), [`crate::Lanes`], [`crate::simd::Packed`].
///
/// Code written over a bundle computes in each lane the same bits as over `f64`.
pub trait Bundle: Scalar<Real = Self> {
    /// Number of lanes, at most [`MOST_LANES`].
    const LANES: usize;

    /// `value` in every lane.
    fn splat(value: f64) -> Self;

    /// The first [`Bundle::LANES`] of `lanes`.
    fn load(lanes: &[f64]) -> Self;

    /// Writes the lanes to the front of `lanes`.
    fn store(self, lanes: &mut [f64]);

    /// Absolute value.
    fn abs(self) -> Self;

    /// Lanes with `self < other`; never where one is not a number.
    fn less(self, other: Self) -> Mask;

    /// Lanes with `self <= other`; never where one is not a number.
    fn at_most(self, other: Self) -> Mask;

    /// `a` where the mask is set, else `b`.
    fn select(mask: Mask, a: Self, b: Self) -> Self;

    /// The number in one lane.
    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        let mut all = [0.0; MOST_LANES];
        self.store(&mut all);
        all[lane]
    }

    /// The same with `value` in one lane.
    #[inline(always)]
    #[must_use]
    fn with_lane(self, lane: usize, value: f64) -> Self {
        Self::select(Mask::only(lane), Self::splat(value), self)
    }

    /// The larger one; `self` where `other` is not a number.
    #[inline(always)]
    #[must_use]
    fn max(self, other: Self) -> Self {
        Self::select(self.less(other), other, self)
    }

    /// The smaller one; `self` where `other` is not a number.
    #[inline(always)]
    #[must_use]
    fn min(self, other: Self) -> Self {
        Self::select(other.less(self), other, self)
    }

    /// Lanes that hold a number, infinity not counted.
    #[inline(always)]
    fn finite(self) -> Mask {
        self.abs().at_most(Self::splat(f64::MAX))
    }

    /// `self^(numerator/256)` to about one per cent, for finite numbers above 0: the logarithm is read off the exponent
    /// bits, with the fraction as its linear interpolation. Step-size control needs no more, and it costs no root.
    #[inline(always)]
    #[must_use]
    fn rough_power(self, numerator: i64) -> Self {
        let mut all = [0.0; MOST_LANES];
        self.store(&mut all);
        for x in &mut all {
            *x = rough_power(*x, numerator);
        }
        Self::load(&all)
    }
}

/// `x^(numerator/256)` to about one per cent; see [`Bundle::rough_power`].
#[inline(always)]
#[allow(clippy::cast_possible_wrap, clippy::cast_sign_loss, reason = "bits, not numbers")]
fn rough_power(x: f64, numerator: i64) -> f64 {
    const ONE: i64 = 1.0_f64.to_bits() as i64;
    // With `bits(x) - bits(1) = 2^52 (log2 x + e)`, 0 <= e < 0.0861; the mean of e is put in its place.
    const MEAN: i64 = (0.0430 * (1_u64 << 52) as f64) as i64;
    let logarithm = (x.to_bits() as i64 - ONE + MEAN) >> 8;
    f64::from_bits((logarithm * numerator + ONE - MEAN) as u64)
}

impl Bundle for f64 {
    const LANES: usize = 1;

    #[inline(always)]
    fn splat(value: f64) -> f64 {
        value
    }

    #[inline(always)]
    fn load(lanes: &[f64]) -> f64 {
        lanes[0]
    }

    #[inline(always)]
    fn store(self, lanes: &mut [f64]) {
        lanes[0] = self;
    }

    #[inline(always)]
    fn abs(self) -> f64 {
        f64::abs(self)
    }

    #[inline(always)]
    fn less(self, other: f64) -> Mask {
        Mask(u16::from(self < other))
    }

    #[inline(always)]
    fn at_most(self, other: f64) -> Mask {
        Mask(u16::from(self <= other))
    }

    #[inline(always)]
    fn select(mask: Mask, a: f64, b: f64) -> f64 {
        if mask.has(0) { a } else { b }
    }
}
