//! `N` numbers that move together.

use super::{Bundle, Mask, Scalar};
use std::ops::{Add, AddAssign, Div, Index, Mul, Neg, Sub, SubAssign};

/// `N` independent `f64`, one orbit in each lane.
///
/// Every operation is the plain IEEE operation lane by lane, so lane `i` holds exactly the bits that the same computation
/// gives over `f64`, for any `N`.
///
/// This is the portable bundle, and the oracle of the others. Where speed matters [`crate::simd`] puts eight lanes into
/// vector registers.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct Lanes<const N: usize>(pub [f64; N]);

impl<const N: usize> Lanes<N> {
    /// Lane by lane `operation(self, other)`.
    #[inline(always)]
    fn zip(self, other: Self, operation: impl Fn(f64, f64) -> f64) -> Self {
        let mut out = self.0;
        for lane in 0..N {
            out[lane] = operation(out[lane], other.0[lane]);
        }
        Self(out)
    }
}

impl<const N: usize> Index<usize> for Lanes<N> {
    type Output = f64;

    fn index(&self, lane: usize) -> &f64 {
        &self.0[lane]
    }
}

impl<const N: usize> Scalar for Lanes<N> {
    type Real = Self;
    const IN_KERNEL: bool = true;

    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        Self::splat(value)
    }

    #[inline(always)]
    fn lift(self, real: Self) -> Self {
        real
    }

    #[inline(always)]
    fn add_scaled(self, x: Self, real: Self) -> Self {
        real.mul_add(x, self)
    }

    #[inline(always)]
    fn scale(self, real: Self) -> Self {
        real * self
    }

    #[inline(always)]
    fn real(self) -> Self {
        self
    }

    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let (mut sin, mut cos) = (self, self);
        for lane in 0..N {
            (sin.0[lane], cos.0[lane]) = libm::sincos(self.0[lane]);
        }
        (sin, cos)
    }
}

impl<const N: usize> Bundle for Lanes<N> {
    const LANES: usize = N;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self([value; N])
    }

    #[inline(always)]
    fn load(lanes: &[f64]) -> Self {
        let mut all = [0.0; N];
        all.copy_from_slice(&lanes[..N]);
        Self(all)
    }

    #[inline(always)]
    fn store(self, lanes: &mut [f64]) {
        lanes[..N].copy_from_slice(&self.0);
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.map(f64::sqrt))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.map(f64::abs))
    }

    #[inline(always)]
    fn less(self, other: Self) -> Mask {
        let mut mask = Mask::default();
        for lane in 0..N {
            mask.0 |= u16::from(self.0[lane] < other.0[lane]) << lane;
        }
        mask
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> Mask {
        let mut mask = Mask::default();
        for lane in 0..N {
            mask.0 |= u16::from(self.0[lane] <= other.0[lane]) << lane;
        }
        mask
    }

    #[inline(always)]
    fn select(mask: Mask, a: Self, b: Self) -> Self {
        let mut out = b;
        for lane in 0..N {
            if mask.has(lane) {
                out.0[lane] = a.0[lane];
            }
        }
        out
    }
}

impl<const N: usize> Add for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}

impl<const N: usize> Sub for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}

impl<const N: usize> Mul for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
}

impl<const N: usize> Div for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.zip(other, |a, b| a / b)
    }
}

impl<const N: usize> Mul<f64> for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        self.zip(Self::splat(factor), |a, b| a * b)
    }
}

impl<const N: usize> Neg for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0.map(|a| -a))
    }
}

impl<const N: usize> AddAssign for Lanes<N> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const N: usize> SubAssign for Lanes<N> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}
