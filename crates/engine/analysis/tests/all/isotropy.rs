//! The symmetry of single shapes: known by construction, and kept by the flow.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::{Random, cell, full};
use motiform_analysis::Isotropy;
use motiform_dynamics::steppers::DOP853;
use motiform_dynamics::{Equivariant, Integration, Orbit, Request, StepControl, drive::drive};

const TOLERANCE: f64 = 1e-12;

#[test]
fn shapes_of_known_symmetry_have_it_in_every_direction() {
    let body = full(0.5, 0.1);
    // (v1, v2, S11, S12, U111, U222): order of rotations, mirror axis
    let cases = [
        ([0.0; 6], 1, true),                           // the circle
        ([0.0, 0.0, 0.3, 0.1, 0.0, 0.0], 2, true),     // an ellipse
        ([0.0, 0.0, 0.0, 0.0, 0.2, 0.1], 3, true),     // three-fold
        ([0.4, 0.0, 0.3, 0.0, -0.2, 0.0], 1, true),    // mirror symmetric
        ([0.4, 0.1, 0.3, -0.2, -0.2, 0.05], 1, false), // general
        ([0.0, 0.0, 0.3, 0.1, 0.2, -0.1], 1, false),   // at rest, but without symmetry
    ];
    for (shape, folds, mirror) in cases {
        for angle in [0.0, 0.4, -2.3] {
            let mut turned = shape.to_vec();
            body.rotate(angle, &mut turned);
            let found = Isotropy::of(&body, &turned, TOLERANCE);
            assert_eq!(
                (found.folds, found.mirror.is_some()),
                (folds, mirror),
                "{shape:?} at {angle}: {found:?}"
            );
            assert_eq!(found.circle, shape == [0.0; 6]);
            assert_eq!(found.is_trivial(), folds == 1 && !mirror);
            if let Some(axis) = found.mirror {
                let mut image = turned.clone();
                body.mirror(&mut image);
                body.rotate(axis, &mut image);
                assert!(image.iter().zip(&turned).all(|(a, b)| (a - b).abs() < 1e-12));
            }
        }
    }
}

#[test]
fn the_flow_keeps_the_symmetry_of_a_start() {
    let body = full(0.5, 0.1);
    let mut start = vec![0.4, 0.0, 0.3, 0.0, -0.2, 0.0];
    body.rotate(0.7, &mut start);
    let control = StepControl::Adaptive { rtol: 1e-10, atol: 1e-13 };
    let mut orbit = Orbit::new(&body, &DOP853, control, 0.0, &start).unwrap();
    drive(&mut orbit, &Request::until(5.0, 6), &mut ()).unwrap();
    // round-off of 5 time units, growth rate below 2
    assert!(Isotropy::of(&body, orbit.state(), 1e-9).mirror.is_some());
}

#[test]
fn modes_of_the_cell_have_the_rotations_of_their_number() {
    let body = cell(13.0, 8);
    for mode in 1..=8_usize {
        let mut shape = vec![0.0; 16];
        shape[2 * (mode - 1)] = 0.02;
        shape[2 * (mode - 1) + 1] = 0.01;
        let found = Isotropy::of(&body, &shape, TOLERANCE);
        assert_eq!((found.folds, found.mirror.is_some()), (mode, true));
    }
    let general = Random(4).state(16, 0.01);
    assert!(Isotropy::of(&body, &general, TOLERANCE).is_trivial());
}
