//! The test that two sets of points are one: sets of known orbits, stationary and not.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_analysis::{Error, same_set};
use std::f64::consts::TAU;

const RESOLUTION: f64 = 1e-9;

/// The early and the late half of points made from their number.
fn halves(count: u32, point: impl Fn(f64) -> Vec<f64>) -> bool {
    let points: Vec<Vec<f64>> = (0..count).map(|j| point(f64::from(j))).collect();
    let (early, late) = points.split_at(points.len() / 2);
    same_set(early, late, RESOLUTION).unwrap()
}

/// Angle of the golden rotation.
fn turn(j: f64) -> f64 {
    TAU * 0.5 * (5.0_f64.sqrt() - 1.0) * j
}

/// The sign of the j-th return of an orbit that alternates.
fn side(j: f64) -> f64 {
    if j % 2.0 == 0.0 { 1.0 } else { -1.0 }
}

#[test]
fn a_rotation_fills_the_same_curve_again() {
    for count in [200, 500, 1000] {
        assert!(halves(count, |j| vec![turn(j).cos(), turn(j).sin()]), "{count}");
        assert!(
            halves(count, |j| vec![turn(j).cos() + 0.3 * (3.0 * turn(j)).sin(), turn(j).sin()]),
            "{count}"
        );
    }
}

#[test]
fn a_periodic_orbit_is_one_set() {
    assert!(halves(400, |j| vec![(j % 7.0).sin(), 1.0])); // seven points, exactly
    assert!(halves(400, |_| vec![1.0, 2.0]));
}

#[test]
fn a_chaotic_orbit_is_one_set() {
    let mut x = 0.3_f64;
    let points: Vec<Vec<f64>> = (0..1000)
        .map(|_| {
            let before = x;
            x = 3.9 * x * (1.0 - x);
            vec![before, x]
        })
        .collect();
    assert!(same_set(&points[..500], &points[500..], RESOLUTION).unwrap());
}

/// Critical slowing down: the distance to a periodic orbit decays as a power of time, whatever its period.
#[test]
fn a_set_that_shrinks_is_not_the_same() {
    for start in [1000.0, 10_000.0] {
        // alternating, towards one point, and towards two that are apart
        assert!(!halves(1000, |j| vec![side(j) / (start + j).sqrt(), side(j + 1.0) / (start + j).sqrt()]));
        assert!(!halves(1000, |j| vec![side(j) * (1.0 + 1.0 / (start + j).sqrt()), side(j)]));
    }
    // a spiral that loses 20 % of its radius
    let radius = |j: f64| (-0.2 * j / 1000.0).exp();
    assert!(!halves(1000, |j| vec![radius(j) * turn(j).cos(), radius(j) * turn(j).sin()]));
}

#[test]
fn a_set_that_drifts_is_not_the_same() {
    assert!(!halves(1000, |j| vec![turn(j).cos() + 2e-4 * j, turn(j).sin()]));
}

#[test]
fn too_few_points_and_points_that_are_none_are_refused() {
    let few = vec![vec![0.0]; 99];
    assert!(matches!(same_set(&few, &few, RESOLUTION), Err(Error::TooFew { .. })));
    let mut broken = vec![vec![0.0, 1.0]; 100];
    let whole = broken.clone();
    broken[40][1] = f64::NAN;
    assert!(matches!(same_set(&whole, &broken, RESOLUTION), Err(Error::NotFinite { index: 140, .. })));
    broken[40] = vec![1.0];
    assert!(matches!(same_set(&broken, &whole, RESOLUTION), Err(Error::Shape { .. })));
}
