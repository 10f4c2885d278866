//! One equation, three scalars: lanes equal `f64` to the bit, duals equal an independent implementation.

use crate::common;

use common::{Arenstorf, Lorentzian, Oscillator};
use motiform_dynamics::conformance::{derivative_defect, lane_mismatches, purity_defect};
use motiform_dynamics::steppers::runge_kutta::march;
use motiform_dynamics::steppers::{RK4, STEPPERS};
use motiform_dynamics::{Bundle as _, Dual, Lanes, Scalar as _, VectorField};
use num_dual::{Dual2_64, Dual64, DualNum as _};
use proptest::prelude::*;

proptest! {
    /// Every operation of our duals agrees with the crate num-dual.
    #[test]
    fn duals_agree_with_num_dual(x in 0.1..3.0_f64, y in -2.0..2.0_f64) {
        let ours = |x: Dual<f64, 1>, y: Dual<f64, 1>| {
            ((x * y - x * 3.0) / (y * y + y.constant(1.0)) + (-y) * x).scale(0.75) + x / (x * x + y * y)
        };
        let theirs = |x: Dual64, y: Dual64| {
            ((x * y - x * 3.0) / (y * y + 1.0) + (-y) * x) * 0.75 + x / (x * x + y * y)
        };
        let expected_x = theirs(Dual64::from_re(x).derivative(), Dual64::from_re(y));
        let got_x = ours(Dual::variable(x, 0), Dual::constant_of(y));
        prop_assert!((got_x.value - expected_x.re).abs() <= 1e-14 * expected_x.re.abs().max(1.0));
        prop_assert!((got_x.derivative[0] - expected_x.eps).abs() <= 1e-12 * expected_x.eps.abs().max(1.0));
        let expected_y = theirs(Dual64::from_re(x), Dual64::from_re(y).derivative());
        let got_y = ours(Dual::constant_of(x), Dual::variable(y, 0));
        prop_assert!((got_y.derivative[0] - expected_y.eps).abs() <= 1e-12 * expected_y.eps.abs().max(1.0));
    }

    /// Functions and their first and second derivatives, also over duals of duals.
    #[test]
    fn functions_agree_with_num_dual(x in 0.1..3.0_f64) {
        let nested = Dual::<Dual<f64, 1>, 1>::variable(Dual::variable(x, 0), 0);
        let theirs = Dual2_64::from_re(x).derivative();
        for (ours, theirs) in [
            (nested.exp(), theirs.exp()),
            (nested.ln(), theirs.ln()),
            (nested.sqrt(), theirs.sqrt()),
            (nested.sin_cos().0, theirs.sin()),
            (nested.sin_cos().1, theirs.cos()),
        ] {
            let ours = [ours.value.value, ours.derivative[0].value, ours.derivative[0].derivative[0]];
            for (ours, theirs) in ours.into_iter().zip([theirs.re, theirs.v1, theirs.v2]) {
                prop_assert!((ours - theirs).abs() <= 1e-13 * theirs.abs().max(1.0), "{ours} {theirs}");
            }
        }
    }

    #[test]
    fn fields_conform(states in prop::array::uniform4(prop::collection::vec(0.5..2.0_f64, 4))) {
        prop_assert_eq!(purity_defect(&Arenstorf, &states[0]), 0.0);
        prop_assert_eq!(lane_mismatches(&Arenstorf, &Arenstorf, &states), 0);
        prop_assert!(derivative_defect(&Arenstorf, &states[0], &states[1]) < 1e-6);
    }
}

/// Whole orbits over lanes of any width equal the single orbits to the bit, for every stepper.
#[test]
fn marching_in_lanes_is_bitwise_the_single_orbit() {
    fn check<const N: usize>() {
        for tableau in STEPPERS {
            let mut bundle: Vec<Lanes<N>> =
                vec![Lanes::from(std::array::from_fn(|lane| 1.0 + 0.1 * lane as f64))];
            march(tableau, &Lorentzian, Lanes::splat(0.0), Lanes::splat(0.01), 100, &mut bundle);
            for lane in 0..N {
                let mut single = vec![1.0 + 0.1 * lane as f64];
                march(tableau, &Lorentzian, 0.0, 0.01, 100, &mut single);
                assert_eq!(
                    single[0].to_bits(),
                    bundle[0].lane(lane).to_bits(),
                    "{} lane {lane}",
                    tableau.name
                );
            }
        }
    }
    check::<1>();
    check::<4>();
    check::<8>();
    check::<16>();
}

/// The tangent flow of the oscillator is the rotation itself: duals through a whole integration.
#[test]
fn duals_through_a_stepper_give_the_tangent_flow() {
    let mut state = vec![Dual::<f64, 2>::variable(1.0, 0), Dual::variable(0.0, 1)];
    march(&RK4, &Oscillator, 0.0, 1e-3, 1000, &mut state);
    let (sin, cos) = 1.0_f64.sin_cos();
    let expected = [[cos, sin], [-sin, cos]];
    for (row, expected) in state.iter().zip(expected) {
        for (got, exact) in row.derivative.iter().zip(expected) {
            assert!((got - exact).abs() < 1e-12);
        }
    }
}

#[test]
fn a_field_is_callable_through_a_reference() {
    let mut du = [0.0; 2];
    VectorField::<f64>::eval(&&Oscillator, 0.0, &[1.0, 2.0], &mut du);
    assert_eq!(du, [2.0, -1.0]);
}
