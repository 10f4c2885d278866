//! Rossler's band.

use motiform_dynamics::{Scalar, VectorField};

/// Rossler's band: x' = -y - z, y' = x + a y, z' = b + z (x - c).
///
/// At a = b = 0.2, c = 5.7 (the default) it is chaotic: exponents 0.0714, 0, -5.3943. Fixed points: x = -a y, z = -y,
/// y = (-c +- sqrt(c^2 - 4 a b))/(2 a).
///
/// Source: Rossler (1976), Phys. Lett. A 57, 397; exponents: Sprott (2003), Chaos and Time-Series Analysis, app. A.
///
/// # Checked by  tests/all/zoo.rs: fixed points
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rossler {
    /// Growth rate of the spiral.
    pub a: f64,
    /// Source of z.
    pub b: f64,
    /// The value of x above which z grows.
    pub c: f64,
}

impl Default for Rossler {
    fn default() -> Self {
        Self { a: 0.2, b: 0.2, c: 5.7 }
    }
}

crate::plain!(Rossler, 3);

impl<T: Scalar> VectorField<T> for Rossler {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, y, z) = (u[0], u[1], u[2]);
        du[0] = -y - z;
        du[1] = x + y * self.a;
        du[2] = x.constant(self.b) + z * (x - x.constant(self.c));
    }
}
