//! The velocity of the stage beside a cell that turns.

use crate::common::diagonal;
use motiform_dynamics::Normal;
use motiform_inference::{Observation, Track, stage_velocity};

/// Circles of speed 1 and turning rate 0.2, the axis along the motion, on a stage that drifts; errors of places and shape.
fn circles(drift: [f64; 2], error: f64, frames: u32) -> Track {
    let mut random = Normal::new(4, 0);
    let frame = |k: u32| {
        let t = 0.5 * f64::from(k);
        let (sin, cos) = libm::sincos(0.2 * t);
        let mut y = vec![5.0 * sin + drift[0] * t, -5.0 * cos + drift[1] * t];
        let (double_sin, double_cos) = libm::sincos(0.4 * t);
        y.extend([0.3 * double_cos, -0.3 * double_sin, 0.0, 0.0]);
        y.iter_mut().for_each(|x| *x += error * random.next());
        Observation { t, y, covariance: diagonal(&[error.max(1e-6); 6]) }
    };
    Track((0..frames).map(frame).collect())
}

#[test]
fn a_drift_beside_a_circle_is_found() {
    // chords of a circle have the direction of its middle: exact without errors, over any part of the record
    for frames in [100, 237, 400] {
        let [x, y] = stage_velocity(&circles([0.02, -0.05], 0.0, frames)).expect("it turns");
        assert!((x - 0.02).abs() < 1e-9 && (y + 0.05).abs() < 1e-9, "{frames}: {x} {y}");
    }
    let [x, y] = stage_velocity(&circles([0.02, -0.05], 0.01, 400)).expect("it turns");
    // errors of both ends alone: sqrt(2) 0.01 in 200, and those of the axis
    assert!((x - 0.02).abs() < 2e-3 && (y + 0.05).abs() < 2e-3, "{x} {y}");
    let still = circles([0.02, -0.05], 0.0, 400).without_velocity([0.02, -0.05]);
    let [x, y] = stage_velocity(&still).expect("it turns");
    assert!(x.abs() < 1e-9 && y.abs() < 1e-9);
}

#[test]
fn a_cell_that_keeps_its_direction_does_not_tell() {
    let straight = circles([0.0, 0.0], 0.0, 400).0.into_iter().map(|mut frame| {
        frame.y[..4].copy_from_slice(&[frame.t, 0.0, 0.3, 0.0]);
        frame
    });
    assert_eq!(stage_velocity(&Track(straight.collect())), None);
    assert_eq!(stage_velocity(&circles([0.0, 0.0], 0.0, 40)), None);
}
