//! The scalars of models: one equation, three scalars.
//!
//! A vector field is written once for any [`Scalar`]. Evaluated over
//! * `f64` it moves one orbit,
//! * a [`Bundle`] it moves several orbits at once (each lane with its own parameters and its own time),
//! * [`Dual`] it carries exact derivatives (Jacobians, tangent flows) along.
//!
//! Without fused multiply-add every lane computes the same bits as `f64` does: tested in `tests/all/scalars.rs`.

mod bundle;
mod complex;
mod dual;
mod row;

pub use bundle::{Bundle, MOST_LANES, Mask};
pub use complex::Complex;
pub use dual::Dual;
pub use row::{BLOCK as ROW_BLOCK, DualRow, Row};

use crate::simd::Kernel;
use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// A number that a vector field can be evaluated over.
///
/// A constant is made *from an existing value* ([`Scalar::constant`]), so that a lane type may
/// carry information of that value (the CPU features it was made for).
pub trait Scalar:
    Copy
    + Debug
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + Mul<f64, Output = Self>
{
    /// The number without its derivative part: the type of parameters, times and step sizes.
    type Real: Scalar<Real = Self::Real>;

    /// `N` of them in a row, for sums along it.
    type Row<const N: usize>: Row<Self>;

    /// `true` if values of this type occur only in kernels that were compiled for the widest instructions
    /// already.
    const IN_KERNEL: bool = false;

    /// The constant `value`, of the same kind as `self` (same lanes; derivative zero).
    fn constant(self, value: f64) -> Self;

    /// `real * self`, for a parameter, a time or a step size.
    fn scale(self, real: Self::Real) -> Self;

    /// The number without its derivative part.
    fn real(self) -> Self::Real;

    /// `real` as a constant: derivative zero.
    fn lift(self, real: Self::Real) -> Self;

    /// `self * factor + addend`, rounded twice: never a fused operation, so that every machine computes the same bits.
    #[inline(always)]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        self * factor + addend
    }

    /// `self + real * x`.
    fn add_scaled(self, x: Self, real: Self::Real) -> Self;

    /// Sine and cosine (`self` in rad), by `libm` lane by lane: the same bits on every machine.
    fn sin_cos(self) -> (Self, Self);

    /// The exponential, by `libm` lane by lane.
    fn exp(self) -> Self;

    /// The natural logarithm, by `libm` lane by lane: not a number below 0.
    fn ln(self) -> Self;

    /// The square root, rounded correctly: not a number below 0. Its derivative is not finite at 0.
    fn sqrt(self) -> Self;

    /// Zero, of the same kind as `self`.
    #[inline(always)]
    fn zero(self) -> Self {
        self.constant(0.0)
    }

    /// Runs a kernel over this type as a function of its own: a long one is compiled once for its many callers, with the instructions
    /// that they have.
    #[inline(never)]
    fn apart<K: Kernel>(kernel: K) -> K::Output {
        kernel.run()
    }
}

impl Scalar for f64 {
    type Real = f64;
    type Row<const N: usize> = [Self; N];

    #[inline(always)]
    fn constant(self, value: f64) -> f64 {
        value
    }

    #[inline(always)]
    fn scale(self, real: f64) -> f64 {
        real * self
    }

    #[inline(always)]
    fn real(self) -> f64 {
        self
    }

    #[inline(always)]
    fn lift(self, real: f64) -> f64 {
        real
    }

    #[inline(always)]
    fn add_scaled(self, x: f64, real: f64) -> f64 {
        real * x + self
    }

    #[inline]
    fn sin_cos(self) -> (f64, f64) {
        libm::sincos(self)
    }

    #[inline]
    fn exp(self) -> f64 {
        libm::exp(self)
    }

    #[inline]
    fn ln(self) -> f64 {
        libm::log(self)
    }

    #[inline(always)]
    fn sqrt(self) -> f64 {
        f64::sqrt(self)
    }
}
