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
        self.im.mul_add(self.im, self.re * self.re)
    }

    /// `z^2`.
    #[inline(always)]
    #[must_use]
    pub fn square(self) -> Self {
        let (re, im) = (self.re, self.im);
        Self::new((-im).mul_add(im, re * re), (re + re) * im)
    }

    /// `self + a b`.
    #[inline(always)]
    #[must_use]
    pub fn add_product(self, a: Self, b: Self) -> Self {
        Self::new(
            (-a.im).mul_add(b.im, a.re.mul_add(b.re, self.re)),
            a.im.mul_add(b.re, a.re.mul_add(b.im, self.im)),
        )
    }

    /// `self + real z` for a parameter.
    #[inline(always)]
    #[must_use]
    pub fn add_scaled(self, z: Self, real: T::Real) -> Self {
        Self::new(self.re.add_scaled(z.re, real), self.im.add_scaled(z.im, real))
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
        Self::new(
            (-self.im).mul_add(other.im, self.re * other.re),
            self.im.mul_add(other.re, self.re * other.im),
        )
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
