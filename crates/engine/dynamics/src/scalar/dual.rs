//! Numbers with their derivatives.

#![allow(
    clippy::suspicious_arithmetic_impl,
    reason = "the product and quotient rules mix all four operations"
)]

use super::{DualRow, Scalar};
use crate::simd::Kernel;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// A value and its derivatives along `K` directions: `value + sum_k derivative[k] eps_k`, `eps_j eps_k = 0`.
///
/// Forward-mode automatic differentiation: a vector field evaluated over `Dual<f64, K>` gives `f(u)` and `K` columns
/// of `Df(u) W` exactly (to round-off), with no hand-written Jacobian. The scalar inside may be a lane bundle.
///
/// Source: Wengert (1964), Commun. ACM 7, 463. Checked by `tests/all/scalars.rs` against the crate num-dual.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<T, const K: usize> {
    /// The value.
    pub value: T,
    /// The derivatives along the `K` directions.
    pub derivative: [T; K],
}

impl<T: Scalar, const K: usize> Dual<T, K> {
    /// A constant: `value` with all derivatives zero.
    #[inline(always)]
    pub fn constant_of(value: T) -> Self {
        Self { value, derivative: [value.zero(); K] }
    }

    /// The variable number `direction`: derivative one along it, zero along the others.
    pub fn variable(value: T, direction: usize) -> Self {
        let mut out = Self::constant_of(value);
        out.derivative[direction] = value.constant(1.0);
        out
    }

    /// Applies `map` to every derivative and replaces the value.
    #[inline(always)]
    fn map(self, value: T, map: impl Fn(T) -> T) -> Self {
        let mut derivative = self.derivative;
        for d in &mut derivative {
            *d = map(*d);
        }
        Self { value, derivative }
    }

    /// Combines the derivatives of two numbers.
    #[inline(always)]
    fn zip(self, other: Self, value: T, combine: impl Fn(T, T) -> T) -> Self {
        let mut derivative = self.derivative;
        for k in 0..K {
            derivative[k] = combine(derivative[k], other.derivative[k]);
        }
        Self { value, derivative }
    }
}

impl<T: Scalar, const K: usize> Scalar for Dual<T, K> {
    type Real = T::Real;
    type Row<const N: usize> = DualRow<T, K, N>;
    const IN_KERNEL: bool = T::IN_KERNEL;

    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        Self::constant_of(self.value.constant(value))
    }

    #[inline(always)]
    fn scale(self, real: T::Real) -> Self {
        self.map(self.value.scale(real), |d| d.scale(real))
    }

    #[inline(always)]
    fn real(self) -> T::Real {
        self.value.real()
    }

    #[inline(always)]
    fn lift(self, real: T::Real) -> Self {
        Self::constant_of(self.value.lift(real))
    }

    /// `(a b + c)' = a' b + (a b' + c')`.
    #[inline(always)]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        let (a, b) = (self.value, factor.value);
        let mut derivative = addend.derivative;
        for k in 0..K {
            derivative[k] = self.derivative[k].mul_add(b, a.mul_add(factor.derivative[k], derivative[k]));
        }
        Self { value: a.mul_add(b, addend.value), derivative }
    }

    #[inline(always)]
    fn add_scaled(self, x: Self, real: T::Real) -> Self {
        let mut derivative = self.derivative;
        for k in 0..K {
            derivative[k] = derivative[k].add_scaled(x.derivative[k], real);
        }
        Self { value: self.value.add_scaled(x.value, real), derivative }
    }

    #[inline(always)]
    fn apart<W: Kernel>(kernel: W) -> W::Output {
        T::apart(kernel)
    }

    /// `(sin x)' = cos x x'`, `(cos x)' = -sin x x'`.
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_cos();
        (self.map(sin, |d| cos * d), self.map(cos, |d| -(sin * d)))
    }

    /// `(exp x)' = exp x x'`.
    #[inline]
    fn exp(self) -> Self {
        let exp = self.value.exp();
        self.map(exp, |d| exp * d)
    }

    /// `(ln x)' = x' / x`.
    #[inline]
    fn ln(self) -> Self {
        self.map(self.value.ln(), |d| d / self.value)
    }

    /// `(sqrt x)' = x' / (2 sqrt x)`.
    #[inline]
    fn sqrt(self) -> Self {
        let sqrt = self.value.sqrt();
        self.map(sqrt, |d| d / (sqrt * 2.0))
    }
}

impl<T: Scalar, const K: usize> Add for Dual<T, K> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, self.value + other.value, |a, b| a + b)
    }
}

impl<T: Scalar, const K: usize> Sub for Dual<T, K> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, self.value - other.value, |a, b| a - b)
    }
}

impl<T: Scalar, const K: usize> Mul for Dual<T, K> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self.value, other.value);
        self.zip(other, a * b, |da, db| da.mul_add(b, a * db))
    }
}

impl<T: Scalar, const K: usize> Div for Dual<T, K> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let quotient = self.value / other.value;
        self.zip(other, quotient, |da, db| (da - quotient * db) / other.value)
    }
}

impl<T: Scalar, const K: usize> Mul<f64> for Dual<T, K> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        self.map(self.value * factor, |d| d * factor)
    }
}

impl<T: Scalar, const K: usize> Neg for Dual<T, K> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.map(-self.value, |d| -d)
    }
}

impl<T: Scalar, const K: usize> AddAssign for Dual<T, K> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<T: Scalar, const K: usize> SubAssign for Dual<T, K> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}
