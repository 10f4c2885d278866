//! Complex numbers over any scalar: the Fourier amplitudes z_n of the models.

use super::Scalar;
use std::ops::{Add, AddAssign, Mul, Neg};

/// `re + i im` over a [`Scalar`]. Only what polynomial mode equations need.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Complex<T> {
    /// Real part.
    pub re: T,
    /// Imaginary part.
    pub im: T,
}

impl<T: Scalar> Complex<T> {
    /// `re + i im`.
    #[inline(always)]
    pub fn new(re: T, im: T) -> Self {
        Self { re, im }
    }

    /// The complex conjugate.
    #[inline(always)]
    #[must_use]
    pub fn conj(self) -> Self {
        Self::new(self.re, -self.im)
    }

    /// `|z|^2`.
    #[inline(always)]
    pub fn norm_sqr(self) -> T {
        self.re * self.re + self.im * self.im
    }

    /// `real * z` for a parameter.
    #[inline(always)]
    #[must_use]
    pub fn scale(self, real: T::Real) -> Self {
        Self::new(self.re.scale(real), self.im.scale(real))
    }
}

impl<T: Scalar> Add for Complex<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::new(self.re + other.re, self.im + other.im)
    }
}

impl<T: Scalar> Neg for Complex<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.re, -self.im)
    }
}

impl<T: Scalar> AddAssign for Complex<T> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<T: Scalar> Mul for Complex<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self::new(self.re * other.re - self.im * other.im, self.re * other.im + self.im * other.re)
    }
}

/// A real scalar of the state's own kind times a complex number.
impl<T: Scalar> Mul<T> for Complex<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, real: T) -> Self {
        Self::new(self.re * real, self.im * real)
    }
}
