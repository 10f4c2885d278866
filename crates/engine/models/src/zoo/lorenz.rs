//! Lorenz's model of convection.

use motiform_dynamics::{Scalar, VectorField};

/// Lorenz's model of convection: x' = sigma (y - x), y' = x (rho - z) - y, z' = x y - beta z.
///
/// At sigma = 10, rho = 28, beta = 8/3 (the default) it is chaotic: exponents 0.9056, 0, -14.5723, whose sum is the
/// divergence -(sigma + 1 + beta) everywhere. Fixed points: 0, and (+-c, +-c, rho - 1) with c^2 = beta (rho - 1). Symmetric
/// under (x, y) -> (-x, -y).
///
/// Source: Lorenz (1963), J. Atmos. Sci. 20, 130; exponents: Sprott (2003), Chaos and Time-Series Analysis, app. A.
///
/// # Checked by  tests/all/zoo.rs: fixed points, divergence, symmetry
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lorenz {
    /// Prandtl number.
    pub sigma: f64,
    /// Rayleigh number over its critical value.
    pub rho: f64,
    /// Geometric factor.
    pub beta: f64,
}

impl Default for Lorenz {
    fn default() -> Self {
        Self { sigma: 10.0, rho: 28.0, beta: 8.0 / 3.0 }
    }
}

crate::plain!(Lorenz, 3);

impl<T: Scalar> VectorField<T> for Lorenz {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, y, z) = (u[0], u[1], u[2]);
        du[0] = (y - x) * self.sigma;
        du[1] = x * (x.constant(self.rho) - z) - y;
        du[2] = x * y - z * self.beta;
    }
}
