//! The step within a radius, compiled here without the rest of the crate.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

#[path = "../../src/fit/trust.rs"]
mod step;

use nalgebra::{DMatrix, DVector};
use step::Model;

#[test]
fn a_step_is_newtons_within_the_radius_and_ends_at_it_beyond() {
    let curvature = DMatrix::from_row_slice(2, 2, &[4.0, 1.0, 1.0, 1e-3]);
    let definite = DMatrix::from_row_slice(2, 2, &[4.0, 1.0, 1.0, 3.0]);
    let gradient = DVector::from_row_slice(&[1.0, 2.0]);
    let model = Model::new(&definite, &gradient).unwrap();
    let newton = definite.clone().lu().solve(&gradient).unwrap();
    assert!((model.step(10.0) - &newton).norm() < 1e-14);
    assert!((model.promise().unwrap() - 0.5 * newton.dot(&gradient)).abs() < 1e-14);
    for curvature in [&curvature, &definite] {
        let model = Model::new(curvature, &gradient).unwrap();
        let step = model.step(0.1);
        assert!((step.norm() - 0.1).abs() <= 0.05 * 0.1, "{}", step.norm());
        // no other step of this length gains more
        let gain = |s: &DVector<f64>| gradient.dot(s) - 0.5 * s.dot(&(curvature * s));
        for k in 0..60 {
            let angle = 0.1 * f64::from(k);
            let other = DVector::from_row_slice(&[libm::cos(angle), libm::sin(angle)]) * step.norm();
            assert!(gain(&step) >= gain(&other) - 1e-9);
        }
    }
    assert!(Model::new(&curvature, &gradient).unwrap().promise().is_none());
    assert!(Model::new(&(curvature * f64::NAN), &gradient).is_none());
}
