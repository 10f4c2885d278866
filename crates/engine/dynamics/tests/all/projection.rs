//! Fields that correct the end of every step.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use motiform_dynamics::orbit::StepFailure;
use motiform_dynamics::steppers::{EXPONENTIAL_STEPPERS, STEPPERS};
use motiform_dynamics::{
    ExponentialOrbit, InPlane, Integration, Obstacle, Orbit, Scalar, Semilinear, Shape, StepControl, System,
    VectorField,
};

/// `u' = -2 u`, half of it stiff; after every step u is multiplied by `factor`, while `u > smallest`. The body moves at
/// the velocity `(u, 0)`.
struct Cut {
    factor: Option<f64>,
    smallest: f64,
}

impl System for Cut {
    fn dim(&self) -> usize {
        1
    }

    fn project(&self, u: &[f64], projected: &mut [f64]) -> Result<bool, Obstacle> {
        let Some(factor) = self.factor else { return Ok(false) };
        if u[0] <= self.smallest {
            return Err(Obstacle::Closure { residual: u[0] });
        }
        projected[0] = factor * u[0];
        Ok(true)
    }
}

impl<T: Scalar> VectorField<T> for Cut {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        du[0] = u[0] * -2.0;
    }
}

impl<T: Scalar> Semilinear<T> for Cut {
    fn linear(&self, lambda: &mut [T::Real]) {
        lambda[0] = lambda[0].constant(-1.0);
    }

    fn nonlinear(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        du[0] = -u[0];
    }
}

impl<T: Scalar> Shape<T> for Cut {
    fn velocity(&self, u: &[T]) -> [T; 2] {
        [u[0], u[0].zero()]
    }
}

const START: [f64; 3] = [1.0, 0.0, 0.0];

/// Every stepper, on a body in the plane: explicit ones, exponential ones, and these with the position as a stage.
fn each(cut: &Cut, control: StepControl, mut check: impl FnMut(&str, u32, &mut dyn Integration)) {
    let body = InPlane(cut);
    for tableau in STEPPERS {
        if let Ok(mut orbit) = Orbit::new(&body, tableau, control, 0.0, &START) {
            check(tableau.name, tableau.order, &mut orbit);
        }
    }
    for tableau in EXPONENTIAL_STEPPERS {
        if let Ok(mut orbit) = ExponentialOrbit::in_plane(cut, tableau, control, 0.0, &START) {
            check(tableau.name, tableau.order, &mut orbit);
        }
        if let Ok(mut orbit) = ExponentialOrbit::new(&body, tableau, control, 0.0, &START) {
            check(tableau.name, tableau.order, &mut orbit);
        }
    }
}

/// Five steps of h = 0.02: a local error of about `(2 h)^(order + 1)`, which the position shares.
#[test]
fn the_orbit_goes_on_from_the_corrected_state() {
    let cut = Cut { factor: Some(0.5), smallest: 0.0 };
    let h = 0.02;
    each(&cut, StepControl::Fixed { step: h }, |name, order, orbit| {
        let tolerance = (2.0 * h).powi(order.min(4).cast_signed() + 1) + 1e-14;
        let (mut start, mut place, mut inside) = (1.0, 0.0, [0.0; 3]);
        for step in 1..=5 {
            orbit.advance(1.0).unwrap();
            let landed = start * (-2.0 * h).exp();
            let [u, x] = [orbit.state()[0], orbit.state()[1]];
            assert!((u - 0.5 * landed).abs() < tolerance, "{name} {step}: {u}");
            assert!(
                (orbit.slope()[0] + 2.0 * u).abs() < 1e-15,
                "{name}: the slope is that after the correction"
            );
            place += 0.5 * (start - landed); // int u dt over the step
            assert!((x - place).abs() < 5.0 * tolerance, "{name} {step}: {x} {place}");
            // inside the step: the flow, up to the jump at its end
            for part in [0.5, 0.999_999] {
                let t = orbit.t_old() + part * h;
                let flow = start * (-2.0 * part * h).exp();
                orbit.dense().at(t, &mut inside);
                // dense output of order 2 at least
                assert!((inside[0] - flow).abs() < tolerance.max((2.0 * h).powi(4)), "{name} {step} {part}");
                orbit.step_to(t, &mut inside);
                assert!((inside[0] - flow).abs() < tolerance, "{name} {step} {part}");
            }
            let t = orbit.t();
            orbit.dense().at(t, &mut inside);
            assert_eq!(inside, orbit.state(), "{name}");
            (start, place) = (u, x);
        }
        // the end of a step that is moved back lies inside it
        let middle = orbit.t() - 0.5 * h;
        let before = 2.0 * start * h.exp();
        orbit.end_step_at(middle);
        assert!((orbit.state()[0] - before).abs() < 2.0 * tolerance, "{name}");
        assert!((orbit.slope()[0] + 2.0 * orbit.state()[0]).abs() < 1e-15, "{name}");
        let start = orbit.state()[0];
        orbit.advance(middle + h).unwrap();
        assert!((orbit.state()[0] - 0.5 * start * (-2.0 * h).exp()).abs() < tolerance, "{name}");
    });
}

/// A correction by nothing: the same bits as no correction, so it leaves error control and stages alone.
#[test]
fn error_control_is_that_of_the_flow() {
    let control = StepControl::Adaptive { rtol: 1e-6, atol: 1e-9 };
    let end = |factor| {
        let mut ends = vec![];
        each(&Cut { factor, smallest: 0.0 }, control, |name, _, orbit| {
            while orbit.t() < 3.0 {
                orbit.advance(3.0).unwrap();
            }
            let bits: Vec<u64> = orbit.state().iter().map(|x| x.to_bits()).collect();
            ends.push((name.to_owned(), orbit.counters(), bits));
        });
        ends
    };
    assert_eq!(end(None), end(Some(1.0)));
}

#[test]
fn a_correction_that_fails_fails_the_step() {
    let cut = Cut { factor: Some(0.5), smallest: 0.3 };
    for control in [StepControl::Fixed { step: 0.1 }, StepControl::Adaptive { rtol: 1e-3, atol: 1e-3 }] {
        each(&cut, control, |name, _, orbit| {
            let failure = loop {
                let before = (orbit.t(), orbit.state().to_vec());
                if let Err(failure) = orbit.advance(10.0) {
                    assert_eq!(
                        (orbit.t(), orbit.state().to_vec()),
                        before,
                        "{name}: the orbit stays where it was"
                    );
                    break failure;
                }
            };
            assert!(
                matches!(failure, StepFailure::Obstacle(Obstacle::Closure { residual }) if residual <= 0.3),
                "{name}: {failure:?}"
            );
        });
    }
}
