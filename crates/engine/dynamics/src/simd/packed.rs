//! Numbers in vector registers, as a scalar.

use super::Kernel;
use crate::scalar::{Bundle, MOST_LANES, Mask, Scalar};
use std::fmt;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// Vector registers and the instructions on them: lane by lane, each rounded as IEEE says.
///
/// Values exist only inside a kernel that runs on a machine which has the instructions.
pub trait Registers: Copy + Send + Sync + 'static {
    /// Number of lanes, at most [`MOST_LANES`].
    const LANES: usize;
    /// Loads the first [`Registers::LANES`] numbers.
    fn load(lanes: &[f64]) -> Self;
    /// Stores them to the front of `lanes`.
    fn store(self, lanes: &mut [f64]);
    /// `value` in every lane.
    fn splat(value: f64) -> Self;
    /// `a + b`.
    fn add(self, other: Self) -> Self;
    /// `a - b`.
    fn sub(self, other: Self) -> Self;
    /// `a b`.
    fn mul(self, other: Self) -> Self;
    /// `a / b`.
    fn div(self, other: Self) -> Self;
    /// Square root.
    fn sqrt(self) -> Self;
    /// Absolute value.
    fn abs(self) -> Self;
    /// `b` where `a < b`, else `a`.
    fn max(self, other: Self) -> Self;
    /// `b` where `b < a`, else `a`.
    fn min(self, other: Self) -> Self;
    /// Lanes with `a < b`; never where one is not a number.
    fn less(self, other: Self) -> u16;
    /// Lanes with `a <= b`; never where one is not a number.
    fn at_most(self, other: Self) -> u16;
    /// `a` where the mask has a bit, else `b`.
    fn select(mask: u16, a: Self, b: Self) -> Self;
    /// See [`Scalar::apart`].
    #[inline(never)]
    fn apart<K: Kernel>(kernel: K) -> K::Output {
        kernel.run()
    }
}

/// Orbits side by side in vector registers.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub struct Packed<R>(R);

impl<R: Registers> Packed<R> {
    /// A function of one number, lane by lane.
    #[inline(always)]
    fn each(self, function: impl Fn(f64) -> f64) -> Self {
        let mut lanes = [0.0; MOST_LANES];
        self.0.store(&mut lanes);
        for x in &mut lanes[..R::LANES] {
            *x = function(*x);
        }
        Self(R::load(&lanes))
    }
}

impl<R: Registers> fmt::Debug for Packed<R> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut lanes = [0.0; MOST_LANES];
        self.0.store(&mut lanes);
        lanes[..R::LANES].fmt(f)
    }
}

impl<R: Registers> Scalar for Packed<R> {
    type Real = Self;
    type Row<const N: usize> = [Self; N];
    const IN_KERNEL: bool = true;

    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        Self(R::splat(value))
    }

    #[inline(always)]
    fn lift(self, real: Self) -> Self {
        real
    }

    #[inline(always)]
    fn scale(self, real: Self) -> Self {
        real * self
    }

    #[inline(always)]
    fn add_scaled(self, x: Self, real: Self) -> Self {
        real.mul_add(x, self)
    }

    #[inline(always)]
    fn real(self) -> Self {
        self
    }

    #[inline(always)]
    fn apart<K: Kernel>(kernel: K) -> K::Output {
        R::apart(kernel)
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let mut sin = [0.0; MOST_LANES];
        self.0.store(&mut sin);
        let mut cos = sin;
        for lane in 0..R::LANES {
            (sin[lane], cos[lane]) = libm::sincos(sin[lane]);
        }
        (Self(R::load(&sin)), Self(R::load(&cos)))
    }

    #[inline(always)]
    fn exp(self) -> Self {
        self.each(libm::exp)
    }

    #[inline(always)]
    fn ln(self) -> Self {
        self.each(libm::log)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
}

impl<R: Registers> Bundle for Packed<R> {
    const LANES: usize = R::LANES;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self(R::splat(value))
    }

    #[inline(always)]
    fn load(lanes: &[f64]) -> Self {
        Self(R::load(lanes))
    }

    #[inline(always)]
    fn store(self, lanes: &mut [f64]) {
        self.0.store(lanes);
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs())
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(self.0.max(other.0))
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(self.0.min(other.0))
    }

    #[inline(always)]
    fn less(self, other: Self) -> Mask {
        Mask(self.0.less(other.0))
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> Mask {
        Mask(self.0.at_most(other.0))
    }

    #[inline(always)]
    fn select(mask: Mask, a: Self, b: Self) -> Self {
        Self(R::select(mask.0, a.0, b.0))
    }
}

impl<R: Registers> From<R> for Packed<R> {
    #[inline(always)]
    fn from(registers: R) -> Self {
        Self(registers)
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident),*) => {$(
        impl<R: Registers> $operator for Packed<R> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0))
            }
        }
    )*};
}
operators!(Add add, Sub sub, Mul mul, Div div);

impl<R: Registers> Mul<f64> for Packed<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        Self(self.0.mul(R::splat(factor)))
    }
}

impl<R: Registers> Neg for Packed<R> {
    type Output = Self;
    /// `-0 - a`, which is `-a` for every number.
    #[inline(always)]
    fn neg(self) -> Self {
        Self(R::splat(-0.0).sub(self.0))
    }
}

impl<R: Registers> AddAssign for Packed<R> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<R: Registers> SubAssign for Packed<R> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}
