//! Van der Pol's oscillator.

use motiform_dynamics::{Scalar, VectorField};

/// Van der Pol's oscillator: x'' = mu (1 - x^2) x' - x; state (x, x').
///
/// For every mu > 0 one limit cycle attracts all but x = 0. At mu = 1 its period is 6.66328685932313... and its amplitude
/// 2.00861986087484...; one exponent is 0, the other the mean of mu (1 - x^2) over the cycle.
///
/// Source: van der Pol (1926), Phil. Mag. 2, 978; period: Andersen and Geer (1982), SIAM J. Appl. Math. 42,
/// 678; amplitude: `reference/zoo.toml`.
///
/// # Checked by  tests/all/zoo.rs: period by sections, amplitude
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VanDerPol {
    /// Strength of gain and loss.
    pub mu: f64,
}

crate::plain!(VanDerPol, 2);

impl<T: Scalar> VectorField<T> for VanDerPol {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, v) = (u[0], u[1]);
        du[0] = v;
        du[1] = (x.constant(1.0) - x * x) * v * self.mu - x;
    }
}
