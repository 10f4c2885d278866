//! The rotations divided out: alignment is exact and a metric; the moving frame loses nothing.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::{Random, cell, full, reduced};
use motiform_analysis::symmetry::{MovingFrame, align};
use motiform_dynamics::steppers::DOP853;
use motiform_dynamics::{Equivariant, InPlane, Integration, Orbit, Request, StepControl, drive::drive};
use motiform_models::tensor::Tensor;
use proptest::prelude::*;

fn norm(u: &[f64]) -> f64 {
    u.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn image<B: Equivariant>(body: &B, shape: &[f64], angle: f64, mirrored: bool) -> Vec<f64> {
    let mut out = shape.to_vec();
    if mirrored {
        body.mirror(&mut out);
    }
    body.rotate(angle, &mut out);
    out
}

/// Asserts that the remaining distance is the rounding of the rotations (up to 21 modes), far below 1e-12.
fn exact<B: Equivariant>(body: &B, shape: &[f64], angle: f64) {
    for mirrored in [false, true] {
        let reference = image(body, shape, angle, mirrored);
        let found = align(body, &reference, shape, mirrored);
        assert!(found.distance <= 1e-12 * norm(shape), "{found:?} for {shape:?}");
        let turned = image(body, shape, found.angle, mirrored);
        let off = norm(&turned.iter().zip(&reference).map(|(a, b)| a - b).collect::<Vec<_>>());
        assert!(off <= 1e-12 * norm(shape), "{off}");
    }
}

#[test]
fn pure_modes_circles_and_bodies_at_rest_align_exactly() {
    let (tensor, cell) = (reduced(-0.1, -0.04), cell(13.0, 21));
    for mode in 0..3 {
        let mut shape = vec![0.0; 6];
        shape[2 * mode] = 0.3;
        exact(&tensor, &shape, 1.234);
    }
    for mode in 0..21 {
        let mut shape = vec![0.0; 42];
        shape[2 * mode + 1] = 0.3;
        exact(&cell, &shape, -2.5);
    }
    exact(&tensor, &[0.0, 0.0, 0.2, -0.1, 0.05, 0.3], 0.7); // at rest
    exact(&tensor, &[0.0; 6], 0.7); // a circle
    let nothing = align(&tensor, &[0.0; 6], &[0.3, 0.0, 0.4, 0.0, 0.0, 0.0], false);
    assert!((nothing.distance - 0.5).abs() < 1e-15);
}

/// Nearly three-fold: three maxima that only z1 tells apart, on a grid that three does not divide.
#[test]
fn nearly_symmetric_shapes_align_exactly() {
    let tensor = reduced(-0.1, -0.04);
    for step in 0..60 {
        let angle = 0.11 * f64::from(step);
        for small in [1e-1, 1e-2, 1e-4] {
            exact(&tensor, &[small, 0.0, 0.0, 0.0, 1.0, 0.2], angle);
            exact(&tensor, &[0.0, small, 1.0, 0.3, 0.0, 0.0], angle);
        }
    }
}

fn state(dim: usize) -> impl Strategy<Value = Vec<f64>> {
    // modes of very different size, some of them absent
    let entry = (-1.0..1.0, prop_oneof![Just(1.0), Just(1e-2), Just(1e-5), Just(0.0)]);
    prop::collection::vec(entry.prop_map(|(x, size): (f64, f64)| x * size), dim)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn images_of_a_shape_align_exactly(shape in state(6), long in state(42), angle in -9.0..9.0_f64) {
        exact(&reduced(-0.1, -0.04), &shape, angle);
        exact(&cell(21.6, 21), &long, angle);
    }

    #[test]
    fn the_distance_is_a_metric(u in state(6), v in state(6), w in state(6), angle in -4.0..4.0_f64) {
        let body = reduced(-0.1, -0.04);
        let distance = |a: &[f64], b: &[f64]| align(&body, a, b, false).distance;
        let (uv, vw, uw) = (distance(&u, &v), distance(&v, &w), distance(&u, &w));
        prop_assert!((uv - distance(&v, &u)).abs() < 1e-9);
        prop_assert!(uw <= uv + vw + 1e-9);
        prop_assert!(uv >= (norm(&u) - norm(&v)).abs() - 1e-12, "sizes differ by no more than the distance");
        // it belongs to the group orbits, not to the shapes
        prop_assert!((uv - distance(&image(&body, &u, angle, false), &v)).abs() < 1e-9);
        prop_assert!((uv - distance(&image(&body, &u, 0.0, true), &image(&body, &v, 0.0, true))).abs() < 1e-9);
    }
}

/// A small step across the group orbit is not lost: its distance is its length up to curvature.
#[test]
fn shapes_off_the_group_orbit_are_apart() {
    let body = cell(13.0, 8);
    let mut random = Random(3);
    for _ in 0..200 {
        let shape = random.state(16, 1.0);
        let mut spin = vec![0.0; 16];
        body.spin(&shape, &mut spin);
        let mut step = random.state(16, 1e-5);
        let along = step.iter().zip(&spin).map(|(a, b)| a * b).sum::<f64>() / norm(&spin).powi(2);
        step.iter_mut().zip(&spin).for_each(|(x, g)| *x -= along * g);
        let other: Vec<f64> = shape.iter().zip(&step).map(|(a, b)| a + b).collect();
        let found = align(&body, &shape, &other, false).distance;
        assert!((found / norm(&step) - 1.0).abs() < 1e-3, "{found} {}", norm(&step));
    }
}

const CONTROL: StepControl = StepControl::Adaptive { rtol: 1e-13, atol: 1e-15 };

/// The largest difference between the orbit in the plane and the one put together from the moving frame.
fn lost(model: &Tensor, start: [f64; 6], time: f64) -> f64 {
    let plane = InPlane(model.clone());
    let frame = MovingFrame(model);
    let mut whole = Orbit::new(&plane, &DOP853, CONTROL, 0.0, &[&start[..], &[0.0; 2]].concat()).unwrap();
    let mut parts = Orbit::new(&frame, &DOP853, CONTROL, 0.0, &[&start[..], &[0.0; 3]].concat()).unwrap();
    let mut worst: f64 = 0.0;
    for piece in 1..=20 {
        let t = time * f64::from(piece) / 20.0;
        assert!(drive(&mut whole, &Request::until(t, 6), &mut ()).unwrap().is_complete());
        assert!(drive(&mut parts, &Request::until(t, 6), &mut ()).unwrap().is_complete());
        let (w, place) = parts.state().split_at(6);
        let mut rebuilt = image(model, w, place[0], false); // the heading is that of the shape
        rebuilt.extend(&place[1..]);
        let off: Vec<f64> = rebuilt.iter().zip(whole.state()).map(|(a, b)| a - b).collect();
        worst = worst.max(norm(&off));
    }
    worst
}

/// 1e-8: rounding and tolerance (1e-13 per step, some 1e3 steps), times the growth of the motion itself (e^3 for chaos,
/// 1e4 for a rest of the heteroclinic cycle).
#[test]
fn the_moving_frame_and_its_drift_give_the_motion_back() {
    let start = [0.3, 0.05, 0.1, -0.03, 0.02, 0.04];
    let cases = [
        ("straight", full(1.2, 1.0), 100.0),
        ("circular", full(0.3, 1.0), 100.0),
        ("zigzag", full(0.9, 0.1), 150.0),
        ("chaotic", full(0.5, 0.1), 30.0),
        ("quasi-periodic", reduced(-0.22, 0.05), 200.0),
    ];
    for (name, model, time) in cases {
        let off = lost(&model, start, time);
        println!("{name}: {off:.1e}");
        assert!(off < 1e-8, "{name}: {off}");
    }
    // through v = 0: the body rests, and its heading means nothing
    let off = lost(&reduced(-0.1, -0.04), [0.3, -0.001, 0.05, 0.0, 0.0, 0.0], 250.0);
    println!("rectangular: {off:.1e}");
    assert!(off < 1e-8, "{off}");
    // v = 0 exactly, and a circle exactly
    assert!(lost(&reduced(-0.1, -0.04), [0.0, 0.0, 0.05, 0.02, 0.0, 0.0], 100.0) < 1e-12);
    assert!(lost(&reduced(-0.1, -0.04), [0.0; 6], 100.0) < 1e-12);
}
