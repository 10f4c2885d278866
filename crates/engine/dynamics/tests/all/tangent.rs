//! The tangent flow beside its orbit.

#![allow(clippy::expect_used, reason = "a test may fail")]

use motiform_dynamics::steppers::KROGSTAD4;
use motiform_dynamics::{
    ExponentialOrbit, Integration, Scalar, Semilinear, StepControl, System, Tangent, VectorField,
};

/// `x' = x - x^3`, with `x` as its own rotation's size: vectors grow while it leaves 0.
struct Leaving;

impl System for Leaving {
    fn dim(&self) -> usize {
        1
    }
}

impl<T: Scalar> VectorField<T> for Leaving {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        du[0] = u[0] - u[0] * u[0] * u[0];
    }
}

impl<T: Scalar> Semilinear<T> for Leaving {
    fn linear(&self, lambda: &mut [T::Real]) {
        lambda[0] = lambda[0].constant(1.0);
    }

    fn nonlinear(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        du[0] = -(u[0] * u[0] * u[0]);
    }
}

fn run(field: &impl Semilinear<f64>, start: &[f64]) -> (Vec<f64>, u64) {
    let control = StepControl::Adaptive { rtol: 1e-8, atol: 1e-10 };
    let mut orbit = ExponentialOrbit::new(field, &KROGSTAD4, control, 0.0, start).expect("a fair start");
    while orbit.t() < 8.0 {
        orbit.advance(8.0).expect("a smooth field");
    }
    (orbit.state().to_vec(), orbit.counters().steps)
}

/// Vectors that follow change no step of the orbit, and are the derivative `(1 + (x0^-2 - 1) e^-2t)^-3/2 x0^-3 e^-2t` all the same.
#[test]
fn vectors_that_follow_leave_the_orbit_its_steps() {
    let x0 = 1e-2;
    let alone = run(&Leaving, &[x0]);
    let followed = run(&Tangent::following(&Leaving, 1), &[x0, 1.0]);
    let guided = run(&Tangent::new(&Leaving, 1), &[x0, 1.0]);
    assert_eq!((alone.0[0], alone.1), (followed.0[0], followed.1));
    assert_ne!(alone.1, guided.1);
    let fade = libm::exp(-16.0);
    let exact = fade * libm::pow(x0, -3.0) * libm::pow(1.0 + (libm::pow(x0, -2.0) - 1.0) * fade, -1.5);
    assert!((followed.0[1] / exact - 1.0).abs() < 1e-5, "{} {exact}", followed.0[1]);
}
