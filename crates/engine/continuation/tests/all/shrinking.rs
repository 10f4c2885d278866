//! Orbits that shrink to an equilibrium with a mirror axis.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::near;
use motiform_analysis::periodic::PeriodicGuess;
use motiform_analysis::{PeriodicOrbit, Result};
use motiform_continuation::{Branch, End, Settings};
use motiform_dynamics::{Equivariant, Scalar, Semilinear, Shape, Symmetry, System, VectorField};

/// `z' = (p (1 - p) + i) z - |z|^2 z` and `w' = 1 - w`, with `z -> -z` as the mirror: the shape (0, 1) is its own image, and swings
/// about it for p between 0 and 1; half a period later the shape is its image.
struct Swings(f64);
impl System for Swings {
    fn dim(&self) -> usize {
        3
    }
}
impl<T: Scalar> VectorField<T> for Swings {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, y) = (u[0], u[1]);
        let growth = x.constant(self.0 * (1.0 - self.0)) - x * x - y * y;
        du[0] = growth * x - y;
        du[1] = growth * y + x;
        du[2] = x.constant(1.0) - u[2];
    }
}
impl<T: Scalar> Semilinear<T> for Swings {
    fn linear(&self, lambda: &mut [T::Real]) {
        for rate in lambda {
            *rate = Scalar::zero(*rate);
        }
    }
    fn nonlinear(&self, t: T::Real, u: &[T], du: &mut [T]) {
        VectorField::<T>::eval(self, t, u, du);
    }
}
impl<T: Scalar> Shape<T> for Swings {
    fn velocity(&self, shape: &[T]) -> [T; 2] {
        [Scalar::zero(shape[0]); 2]
    }
}
impl Equivariant for Swings {
    fn symmetry(&self) -> Symmetry {
        Symmetry { mirror: true, ..Symmetry::default() }
    }
    fn mirror(&self, shape: &mut [f64]) {
        shape[..2].iter_mut().for_each(|x| *x = -*x);
    }
}

/// The axis belongs to the shape that is left, not to the orbit: it used to be taken for a symmetry that the orbit gains, and orbits of
/// no size were followed from there.
#[test]
fn an_orbit_that_shrinks_to_a_shape_with_an_axis_gains_none() {
    let family = |p: f64| -> Result<Box<dyn Equivariant>> { Ok(Box::new(Swings(p))) };
    for mirrored in [true, false] {
        let time = if mirrored { std::f64::consts::PI } else { std::f64::consts::TAU };
        let guess = PeriodicGuess { shape: &[0.4, 0.0, 1.0], time, angle: 0.0, mirrored };
        let settings = Settings::over(-0.5, 1.5);
        let start = PeriodicOrbit::find(&Swings(0.3), &guess, &settings.flow, &()).unwrap();
        for (settings, expected) in [(settings.reversed(), 0.0), (settings, 1.0)] {
            let mut branch = Branch::of_orbits(&family, 0.3, &start, &settings, &()).unwrap();
            branch.by_ref().for_each(|point| assert!(point.special.is_none(), "{point:?}"));
            let Some(End::Shrinks { parameter, time: last }) = branch.end() else {
                unreachable!("{:?}", branch.end())
            };
            near(*parameter, expected, 1e-6);
            near(*last, time, 1e-6);
        }
    }
}
