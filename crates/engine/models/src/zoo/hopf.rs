//! The normal form of a Hopf bifurcation.

use motiform_dynamics::{Scalar, VectorField};

/// The normal form of a supercritical Hopf bifurcation: z' = (mu + i omega) z - |z|^2 z; state (Re z, Im z).
///
/// mu > 0: the circle |z| = sqrt(mu) attracts, with period 2 pi/omega and exponents 0, -2 mu. mu < 0: z = 0 attracts,
/// exponents mu, mu. From |z| = r0 the radius is r^2 = mu/(1 - (1 - mu/r0^2) e^(-2 mu t)).
///
/// Source: Guckenheimer and Holmes (1983), Nonlinear Oscillations, sec. 3.4.
///
/// # Checked by  tests/all/zoo.rs: radius on the way to the circle (exact), period by sections
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hopf {
    /// Growth rate at 0.
    pub mu: f64,
    /// Angular velocity, everywhere.
    pub omega: f64,
}

crate::plain!(Hopf, 2);

impl<T: Scalar> VectorField<T> for Hopf {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, y) = (u[0], u[1]);
        let growth = x.constant(self.mu) - (x * x + y * y);
        du[0] = growth * x - y * self.omega;
        du[1] = growth * y + x * self.omega;
    }
}
