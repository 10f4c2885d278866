//! Two limit cycles side by side.

use super::Hopf;
use motiform_dynamics::{Scalar, VectorField};

/// Two independent limit cycles ([`Hopf`], mu = 1): z_j' = (1 + i omega_j) z_j - |z_j|^2 z_j, j = 1, 2.
///
/// The torus |z_1| = |z_2| = 1 attracts; exponents 0, 0, -2, -2. With an irrational ratio of the frequencies (the default
/// is the golden ratio, the hardest to mistake for a fraction) every orbit fills it: returns to arg z_1 = 0 lie on a closed
/// curve and turn by 2 pi omega_2/omega_1 each.
///
/// Source: elementary; the frequencies after Berge, Pomeau and Vidal (1984), Order within Chaos, ch. VII.
///
/// # Checked by  tests/all/zoo.rs: radii, rotation number of the return map
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Torus {
    /// Angular velocities.
    pub omega: [f64; 2],
}

impl Default for Torus {
    fn default() -> Self {
        Self { omega: [1.0, 0.5 * (1.0 + 5.0_f64.sqrt())] }
    }
}

crate::plain!(Torus, 4);

impl<T: Scalar> VectorField<T> for Torus {
    fn eval(&self, t: T::Real, u: &[T], du: &mut [T]) {
        for (j, omega) in self.omega.into_iter().enumerate() {
            let pair = 2 * j..2 * j + 2;
            Hopf { mu: 1.0, omega }.eval(t, &u[pair.clone()], &mut du[pair]);
        }
    }
}
