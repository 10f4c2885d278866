//! Runs that leave every bound say so, with the time of the singularity; no run hangs or returns a NaN.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::common;

use common::{Cubic, Growth, Oscillator, Quadratic};
use motiform_dynamics::steppers::{DOP853, EULER, RK4, STEPPERS, Tableau};
use motiform_dynamics::{Integration, Orbit, Outcome, Request, StepControl, VectorField, drive::drive};

fn run<F: VectorField<f64>>(
    field: &F,
    tableau: &'static Tableau,
    control: StepControl,
    u0: &[f64],
    change: impl FnOnce(&mut Request<'_>),
) -> (Outcome, Vec<f64>) {
    let mut orbit = Orbit::new(field, tableau, control, 0.0, u0).unwrap();
    let mut request = Request::until(50.0, u0.len());
    change(&mut request);
    let outcome = drive(&mut orbit, &request, &mut ()).unwrap();
    (outcome, orbit.state().to_vec())
}

const TIGHT: StepControl = StepControl::Adaptive { rtol: 1e-12, atol: 1e-12 };

#[test]
fn time_of_the_singularity_is_exact_to_the_tolerance() {
    for bound in [1e4, 1e6, 1e8] {
        let (outcome, _) = run(&Quadratic, &DOP853, TIGHT, &[0.7], |request| request.escape_norm = bound);
        let Outcome::Escaped { t, singular, t_last, .. } = outcome else { panic!("{outcome}") };
        assert!(singular && (t - 1.0 / 0.7).abs() < 1e-10, "{outcome}, bound {bound}");
        assert!(t_last < t, "the last state lies before the singularity");

        let (outcome, _) = run(&Cubic, &DOP853, TIGHT, &[0.7], |request| request.escape_norm = bound);
        assert!((outcome.t() - 0.5 / 0.49).abs() < 1e-10, "{outcome}, bound {bound}");
    }
}

#[test]
fn a_coarse_method_still_reports_a_blow_up_near_the_true_time() {
    // RK4 with step 1e-3 runs past the singularity by some steps; the growth law before it points to t*.
    let (outcome, state) = run(&Quadratic, &RK4, StepControl::Fixed { step: 1e-3 }, &[1.0], |_| {});
    assert!(matches!(outcome, Outcome::Escaped { .. }) && (outcome.t() - 1.0).abs() < 5e-3, "{outcome}");
    assert!(state[0].is_finite());
}

#[test]
fn exponential_growth_escapes_without_a_singularity() {
    let (outcome, _) = run(&Growth, &DOP853, TIGHT, &[1.0], |request| request.escape_norm = 1e6);
    assert!(matches!(outcome, Outcome::Escaped { singular: false, .. }), "{outcome}");
}

#[test]
fn overflow_in_one_fixed_step_is_an_escape_and_leaves_no_nan() {
    let (outcome, state) = run(&Cubic, &EULER, StepControl::Fixed { step: 10.0 }, &[1e60], |request| {
        request.escape_norm = 1e200;
    });
    assert!(matches!(outcome, Outcome::Escaped { .. }), "{outcome}");
    assert!(state[0].is_finite());
}

#[test]
fn the_step_budget_bounds_every_run() {
    for tableau in STEPPERS {
        let control = if tableau.is_adaptive() { TIGHT } else { StepControl::Fixed { step: 1e-3 } };
        let (outcome, _) = run(&Oscillator, tableau, control, &[1.0, 0.0], |request| request.max_steps = 7);
        assert!(matches!(outcome, Outcome::StepBudget { steps: 7, .. }), "{}: {outcome}", tableau.name);
    }
}
