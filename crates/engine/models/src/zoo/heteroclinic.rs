//! An attracting heteroclinic cycle.

use motiform_dynamics::{Scalar, VectorField};

/// An attracting heteroclinic cycle between three equilibria:
/// x_i' = x_i (1 - x_i^2 - b x_(i+1)^2 - c x_(i+2)^2), indices mod 3.
///
/// Equilibria +-e_i have the eigenvalues -2 (along e_i), 1 - c (along e_(i+1)) and 1 - b (along e_(i+2)). For b < 1 < c
/// orbits go from e_i to e_(i+2) along x_(i+2) and on; the cycle attracts iff b + c > 2. Without noise each
/// rest is then (c - 1)/(1 - b) times as long as the one before (1.2 by default), until round-off ends the growth. With
/// noise of amplitude eta the mean rest is -ln(eta)/(1 - b) + const. All the planes x_i = 0 are invariant.
///
/// Source: Guckenheimer and Holmes (1988), Math. Proc. Camb. Phil. Soc. 103, 189; with noise: Stone and Holmes (1990),
/// SIAM J. Appl. Math. 50, 726.
///
/// # Checked by  tests/all/zoo.rs: equilibria, eigenvalues, order of visits, ratio of rests
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heteroclinic {
    /// Below 1: lets the next one grow.
    pub b: f64,
    /// Above 1: lets the last one decay.
    pub c: f64,
}

impl Default for Heteroclinic {
    fn default() -> Self {
        Self { b: 0.55, c: 1.54 }
    }
}

crate::plain!(Heteroclinic, 3);

impl<T: Scalar> VectorField<T> for Heteroclinic {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        for i in 0..3 {
            let (x, y, z) = (u[i], u[(i + 1) % 3], u[(i + 2) % 3]);
            du[i] = x * (x.constant(1.0) - x * x - y * y * self.b - z * z * self.c);
        }
    }
}
