//! Tests of recurrences that are not tried, against the reduced tensor model: its motionless ellipse has
//! `lambda_pm = gamma +- 2 a1 r2`, so cycles between ellipses attract where gamma is below 0 (physics:
//! `lambda_+ + lambda_- = 2 gamma`).

use super::look::Rest;
use super::recurrence::passes_attracting_saddle;
use motiform_models::tensor::{Tensor, TensorParameters};

const KAPPA2: f64 = -0.1;

fn passes(gamma: f64, away: f64, span: (f64, f64)) -> bool {
    let others = TensorParameters::default();
    let parameters =
        TensorParameters { gamma, kappa2: KAPPA2, kappa3: 1.0, a1: 1.0, b1: 0.5, b3: 1.0, ..others };
    let r2 = libm::sqrt(-KAPPA2 / 8.0);
    let shape = vec![away * r2, 0.0, r2, 0.0, 0.0, 0.0];
    let rests = [Rest { start: 10.0, end: 20.0, shape, whole: true }];
    passes_attracting_saddle(&Tensor::new(&parameters), &rests, span)
}

#[test]
fn a_recurrence_through_a_rest_at_an_attracting_saddle_is_not_tried() {
    assert!(passes(-0.04, 1e-4, (5.0, 12.0)));
    assert!(passes(-0.04, 1e-4, (15.0, 40.0)));
}

#[test]
fn a_recurrence_beside_the_rest_is_tried() {
    assert!(!passes(-0.04, 1e-4, (21.0, 40.0)));
    assert!(!passes(-0.04, 1e-4, (0.0, 9.0)));
}

#[test]
fn a_recurrence_through_a_saddle_that_does_not_attract_or_is_not_near_is_tried() {
    assert!(!passes(0.04, 1e-4, (5.0, 25.0)));
    assert!(!passes(-0.04, 0.05, (5.0, 25.0)));
}
