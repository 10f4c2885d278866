//! Back and forth on a line: the period does not change with a mode that acts on nothing.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::{ORDINARY, Random, near};
use motiform_analysis::Regime;
use motiform_analysis::periodic::Flow;
use motiform_analysis::regime::{Form, settle};
use motiform_dynamics::{Equivariant, Scalar, Semilinear, Shape, Symmetry, System, VectorField};

/// Van der Pol's oscillator in the plane, `x'' = (1 - |x|^2) x' - x` for a vector x, which is the velocity of
/// the body. With an index there is also a mode of this index, `w' = w (1 - |w|^2)`: it has no influence on
/// the other variables, and its phase is neutral. State x, x', w.
///
/// On a line it is van der Pol's oscillator. Deviations across the line decay: `y'' = (1 - x^2) y' - y` has
/// the solution x, which is the rotation, and by Liouville's formula the multiplier
/// `exp(integral of 1 - x^2)`, below 1.
struct Line {
    index: Option<u8>,
}

impl System for Line {
    fn dim(&self) -> usize {
        if self.index.is_some() { 6 } else { 4 }
    }
}

impl<T: Scalar> VectorField<T> for Line {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let gain = |z: &[T]| z[0].constant(1.0) - z[0] * z[0] - z[1] * z[1];
        for k in 0..2 {
            du[k] = u[2 + k];
            du[2 + k] = gain(&u[..2]) * u[2 + k] - u[k];
        }
        for k in 4..u.len() {
            du[k] = gain(&u[4..]) * u[k];
        }
    }
}

impl<T: Scalar> Semilinear<T> for Line {
    fn linear(&self, lambda: &mut [T::Real]) {
        for rate in lambda {
            *rate = Scalar::zero(*rate);
        }
    }

    fn nonlinear(&self, t: T::Real, u: &[T], du: &mut [T]) {
        VectorField::<T>::eval(self, t, u, du);
    }
}

impl<T: Scalar> Shape<T> for Line {
    fn velocity(&self, shape: &[T]) -> [T; 2] {
        [shape[0], shape[1]]
    }
}

impl Line {
    /// The angular index of each pair of coordinates.
    fn indices(&self) -> impl Iterator<Item = f64> {
        [1.0, 1.0].into_iter().chain(self.index.map(f64::from))
    }
}

impl Equivariant for Line {
    fn symmetry(&self) -> Symmetry {
        Symmetry::FULL
    }

    fn rotate(&self, angle: f64, shape: &mut [f64]) {
        for (z, index) in shape.chunks_exact_mut(2).zip(self.indices()) {
            let (sin, cos) = (index * angle).sin_cos();
            (z[0], z[1]) = (cos * z[0] - sin * z[1], cos * z[1] + sin * z[0]);
        }
    }

    fn spin(&self, shape: &[f64], out: &mut [f64]) {
        for ((z, out), index) in shape.chunks_exact(2).zip(out.chunks_exact_mut(2)).zip(self.indices()) {
            (out[0], out[1]) = (-index * z[1], index * z[0]);
        }
    }

    fn mirror(&self, shape: &mut [f64]) {
        shape.iter_mut().skip(1).step_by(2).for_each(|y| *y = -*y);
    }

    fn highest_mode(&self) -> usize {
        usize::from(self.index.unwrap_or(1))
    }
}

/// The shape is back after half of van der Pol's period, turned by half a turn. A mode of odd index is not:
/// it is where it was. One of even index is back as well, but has no mirror axis in common with the others.
#[test]
fn forth_and_back_is_one_period() {
    let reference: toml::Table = include_str!("../../../../../reference/zoo.toml").parse().unwrap();
    let period = reference["van_der_pol"]["period"].as_float().unwrap();
    let flow = Flow { method: ORDINARY.method, control: ORDINARY.control, max_steps: ORDINARY.max_steps };
    for index in [None, Some(2), Some(3), Some(19)] {
        let body = Line { index };
        let start = Random(7).state(body.dim(), 0.8);
        let (verdict, shape) = settle(&body, &start, &ORDINARY, &()).unwrap().unwrap();
        assert_eq!(verdict.regime, Regime::PulsatingStraight, "{index:?}: {}", verdict.why);
        near(verdict.period.unwrap(), period, 1e-6);
        assert!(verdict.net_rotation.unwrap().abs() < 1e-6, "{index:?}: {:?}", verdict.net_rotation);
        assert!(verdict.drift.unwrap() < 1e-6, "{index:?}: {:?}", verdict.drift);
        assert_eq!(verdict.form, Some(Form::BackAndForth));
        // Newton's method finds the orbit again from the verdict
        let orbit = verdict.orbit(&body, &shape, &flow, &()).unwrap();
        let returns = if index.is_none_or(|index| index % 2 == 0) { 2.0 } else { 1.0 };
        near(returns * orbit.time, period, 1e-6);
    }
}
