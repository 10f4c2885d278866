//! The active cell model: symmetries, scalars, closure, boundary, bad input.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use motiform_dynamics::conformance::{
    derivative_defect, lane_mismatches, mirror_defect, purity_defect, rotation_defect, semilinear_defect,
    spin_defect,
};
use motiform_dynamics::model::{velocity, velocity_and_acceleration};
use motiform_dynamics::{Bundle as _, Dual, Lanes, Model, Outline, Shape, System, VectorField};
use motiform_models::cell::outline::first_crossing;
use motiform_models::cell::{Cell, CellField, CellParameters};
use motiform_models::{Error, ModelInfo};
use proptest::prelude::*;
use std::f64::consts::TAU;

const MODES: usize = 16;

/// Shapes as they occur: mode n of phi falls like `1.5^-n`.
fn shape() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(-0.6..0.6_f64, 2 * MODES).prop_map(|mut u| {
        for (mode, n) in u.chunks_mut(2).zip(1..) {
            for x in mode {
                *x *= 1.5_f64.powi(-n);
            }
        }
        u
    })
}

/// All terms at random sizes.
fn parameters() -> impl Strategy<Value = CellParameters> {
    (7.0..30.0_f64, prop::array::uniform4(-1.0..1.0_f64)).prop_map(|(length, [g1, g4, g5, alpha2])| {
        CellParameters { length, g1, g4, g5, alpha2, modes: 16.0, ..Default::default() }
    })
}

/// (C) by brute force: derivatives as sums of waves, products point by point on a grid fine enough to be exact.
fn oracle(p: &CellParameters, u: &[f64], points: usize) -> Vec<f64> {
    let k = TAU / p.length;
    let derivative = |order: i32, j: usize| -> f64 {
        let mut sum = 0.0;
        for (i, mode) in u.chunks_exact(2).enumerate() {
            let wave = k * (i as f64 + 1.0);
            let angle = TAU * ((i + 1) * j) as f64 / points as f64 + f64::from(order) * TAU / 4.0;
            sum += 2.0 * wave.powi(order) * (mode[0] * angle.cos() - mode[1] * angle.sin());
        }
        sum
    };
    let rate: Vec<f64> = (0..points)
        .map(|j| {
            let d = |order| derivative(order, j);
            p.g1 * d(2) + p.g2 * d(4) + p.g3 * d(6) + p.g4 * d(1) * d(2) + p.g5 * d(2) * d(3)
        })
        .collect();
    let mean: f64 = rate.iter().sum::<f64>() / points as f64;
    let scale = rate.iter().fold(1.0, |m: f64, x| m.max(x.abs()));
    assert!(mean.abs() < 1e-13 * scale, "the mean of phi is constant: {mean:e}");
    (0..u.len())
        .map(|entry| {
            let n = (entry / 2 + 1) as f64;
            let wave = |j: usize| {
                let angle = TAU * n * j as f64 / points as f64;
                if entry % 2 == 0 { angle.cos() } else { -angle.sin() }
            };
            rate.iter().enumerate().map(|(j, x)| x * wave(j)).sum::<f64>() / points as f64
        })
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// The convolution equals products on a grid, for all terms of (C); nothing is aliased.
    #[test]
    fn field_equals_the_equation(p in parameters(), u in shape()) {
        let cell = Cell::new(&p).unwrap();
        let mut rate = vec![0.0; u.len()];
        VectorField::<f64>::eval(&cell, 0.0, &u, &mut rate);
        let expected = oracle(&p, &u, 3 * MODES + 1);
        let scale = expected.iter().fold(1.0, |m: f64, x| m.max(x.abs()));
        for (a, b) in rate.iter().zip(&expected) {
            prop_assert!((a - b).abs() < 1e-12 * scale, "{a} {b}");
        }
    }

    /// Shapes near the circle, so that the closure has one solution; velocities are of size 1e-4 here.
    #[test]
    fn flow_and_velocity_turn_and_mirror(length in 7.0..30.0_f64, u in shape(), angle in -7.0..7.0_f64) {
        let cell = Cell::new(&CellParameters { length, modes: 16.0, alpha3: 1.0, ..Default::default() }).unwrap();
        prop_assume!(cell.boundary(&u, 8).is_ok());
        prop_assert!(rotation_defect(&cell, &u, angle) < 1e-9);
        prop_assert!(mirror_defect(&cell, &u) < 1e-9);
        prop_assert!(spin_defect(&cell, &u) < 1e-7); // differences of mode 16
    }

    #[test]
    fn cell_conforms(p in parameters(), u in shape(), w in shape()) {
        let cell = Cell::new(&p).unwrap();
        let lanes = CellField::bundle(&[cell.field().clone(), cell.field().clone()]);
        prop_assert_eq!(purity_defect(&cell, &u), 0.0);
        prop_assert_eq!(lane_mismatches(cell.field(), &lanes, &[u.clone(), w.clone()]), 0);
        prop_assert!(derivative_defect(&cell, &u, &w) < 1e-8);
        prop_assert!(semilinear_defect(&cell, &u) < 1e-13);
        let (mut named, mut back) = (u.clone(), u.clone());
        cell.decode(&u, &mut named);
        cell.encode(&named, &mut back);
        prop_assert_eq!(back, u);
    }

    /// Lanes with their own lengths equal the single fields to the bit.
    #[test]
    fn lanes_have_their_own_parameters(ps in prop::array::uniform4(parameters()), us in prop::array::uniform4(shape())) {
        let fields = ps.map(|p| Cell::new(&p).unwrap().field().clone());
        let u: Vec<Lanes<4>> = (0..2 * MODES).map(|i| Lanes::from(std::array::from_fn(|lane| us[lane][i]))).collect();
        let mut du = u.clone();
        CellField::bundle(&fields).eval(Lanes::splat(0.0), &u, &mut du);
        for lane in 0..4 {
            let mut single = vec![0.0; 2 * MODES];
            fields[lane].eval(0.0, &us[lane], &mut single);
            for i in 0..2 * MODES {
                prop_assert_eq!(single[i].to_bits(), du[i].lane(lane).to_bits());
            }
        }
    }

    /// The derivative of the velocity through the closure: duals against central differences.
    #[test]
    fn velocity_is_differentiated_through_the_closure(length in 7.0..30.0_f64, u in shape(), w in shape()) {
        let p = CellParameters { length, modes: 16.0, alpha3_per_length: 0.0, alpha3: 1.0, ..Default::default() };
        let cell = Cell::new(&p).unwrap();
        let small: Vec<f64> = u.iter().map(|x| 0.5 * x).collect();
        let lifted: Vec<Dual<f64, 1>> =
            small.iter().zip(&w).map(|(&value, &slope)| Dual { value, derivative: [slope] }).collect();
        let v: [Dual<f64, 1>; 2] = cell.velocity(&lifted);
        let plain = velocity(&cell, &small);
        let at = |h: f64| {
            let moved: Vec<f64> = small.iter().zip(&w).map(|(x, dx)| x + h * dx).collect();
            velocity(&cell, &moved)
        };
        let (ahead, behind) = (at(1e-5), at(-1e-5));
        for axis in 0..2 {
            prop_assert_eq!(plain[axis].to_bits(), v[axis].value.to_bits());
            let difference = (ahead[axis] - behind[axis]) / 2e-5;
            let scale = 1.0 + v[0].derivative[0].abs() + v[1].derivative[0].abs();
            prop_assert!((difference - v[axis].derivative[0]).abs() < 1e-5 * scale, "{difference} {:?}", v[axis]);
        }
    }

    /// A normal-angle offset turns the velocity and leaves the shape's evolution alone.
    #[test]
    fn the_mean_of_phi_turns_the_body(u in shape(), mean in -5.0..5.0_f64) {
        let p = CellParameters { length: 12.6, modes: 16.0, alpha3: 1.0, ..Default::default() };
        let (straight, turned) = (Cell::new(&p).unwrap(), Cell::new(&p).unwrap().with_mean(mean));
        let ([x, y], [tx, ty]) = (velocity(&straight, &u), velocity(&turned, &u));
        let (sin, cos) = (TAU / 12.6 * mean).sin_cos();
        prop_assert!((tx - (cos * x - sin * y)).abs() < 1e-11 && (ty - (sin * x + cos * y)).abs() < 1e-11);
    }

    /// The drawn curve closes, has length L, runs anticlockwise, is centred, and turns with the shape.
    #[test]
    fn boundary_is_the_curve_of_its_normals(length in 7.0..30.0_f64, u in shape()) {
        let cell = Cell::new(&CellParameters { length, modes: 16.0, ..Default::default() }).unwrap();
        let small: Vec<f64> = u.iter().map(|x| 0.5 * x).collect();
        let boundary = cell.boundary(&small, 600).unwrap();
        prop_assert!(boundary.closure_residual < 1e-12);
        prop_assert!((boundary.length / length - 1.0).abs() < 1e-9, "{}", boundary.length);
        let next = |i: usize| boundary.points[(i + 1) % 600];
        let (mut area, mut perimeter, mut moment) = (0.0, 0.0, [0.0; 2]);
        for (i, p) in boundary.points.iter().enumerate() {
            let q = next(i);
            let cross = p[0] * q[1] - p[1] * q[0];
            area += 0.5 * cross;
            perimeter += (p[0] - q[0]).hypot(p[1] - q[1]);
            moment = [moment[0] + cross * (p[0] + q[0]), moment[1] + cross * (p[1] + q[1])];
        }
        // a polygon of 600 points: relative error (curvature L / 600)^2 / 24
        prop_assert!(boundary.area > 0.0 && (area / boundary.area - 1.0).abs() < 1e-2, "{area} {}", boundary.area);
        prop_assert!((perimeter / length - 1.0).abs() < 1e-2);
        prop_assert!(moment.iter().all(|m| m.abs() < 1e-2 * length.powi(3)));
    }
}

#[test]
fn circle_stays_and_is_drawn_as_a_circle() {
    let cell = Cell::new(&CellParameters { length: 7.0, ..Default::default() }).unwrap();
    let rest = vec![0.0; cell.dim()];
    let (v, a) = velocity_and_acceleration(&cell, &rest);
    assert!(v.iter().chain(&a).all(|x| x.abs() < 1e-16));
    let boundary = cell.boundary(&rest, 64).unwrap();
    assert!((boundary.area - 49.0 / (2.0 * TAU)).abs() < 1e-12 && (boundary.length - 7.0).abs() < 1e-12);
    assert_eq!((boundary.steps, boundary.crossing), (0, None));
    assert!(cell.deformation(&rest) < 1e-12);
}

/// The velocity by hand, to leading order, with the bare normal.
#[test]
fn velocity_by_hand() {
    // phi = c cos(2 k s) alone with the bare normal: phi_ss^2 has modes 0 and 4, n has odd modes only: v = 0.
    // phi = c1 cos(k s) small: v = k^2 alpha3 <phi_ss^2 n> = k^6 alpha3 c1^2 <cos^2 e^{iks}> = 0 at second order,
    // and <cos^2(ks) i k c1 cos(ks) e^{iks}> = i k c1 3/8 at third.
    let c1 = 1e-3;
    let p = CellParameters {
        length: 7.0,
        closure_modes: 0.0,
        alpha3: 1.0,
        alpha3_per_length: 0.0,
        ..Default::default()
    };
    let cell = Cell::new(&p).unwrap();
    let mut shape = vec![0.0; cell.dim()];
    shape[0] = 0.5 * c1;
    let v = velocity(&cell, &shape);
    let k = TAU / 7.0;
    let expected = k.powi(7) * c1.powi(3) * 3.0 / 8.0;
    assert!(v[0].abs() < 1e-5 * expected && (v[1] / expected - 1.0).abs() < 1e-5, "{v:?} {expected:e}");
}

#[test]
fn bad_input_says_what_is_needed() {
    let refuse = |p: CellParameters| Cell::new(&p).unwrap_err();
    let error = refuse(CellParameters { length: 30.0, modes: 8.0, ..Default::default() });
    assert_eq!(error, Error::TooFewModes { modes: 8, length: 30.0, needed: 15 });
    assert_eq!(error.to_string(), "modes = 8 do not resolve a boundary of length 30: give at least 15");
    for length in [0.0, -1.0, f64::NAN] {
        assert!(matches!(refuse(CellParameters { length, ..Default::default() }), Error::OutOfRange { .. }));
    }
    assert!(matches!(refuse(CellParameters { modes: 12.5, ..Default::default() }), Error::NotWhole { .. }));
    let info = ModelInfo::find("cell").unwrap();
    let mut values: Vec<f64> = info.parameters().iter().map(|spec| spec.default).collect();
    values[0] = 150.0;
    assert!(matches!(info.build(&values), Err(Error::TooFewModes { needed: 72, .. })));
    assert_eq!(info.coordinate(&values, "s2").unwrap(), 3);
}

/// A shape that cannot be closed says so everywhere: no velocity without a reason, no outline.
#[test]
fn a_shape_that_cannot_be_closed_is_a_value() {
    let cell = Cell::new(&CellParameters { length: 7.0, closure_modes: 1.0, ..Default::default() }).unwrap();
    // the error function may change mode 1 only; a huge mode 3 turns the normals too far for that
    let found = (1..200).find_map(|i| {
        let mut shape = vec![0.0; cell.dim()];
        (shape[2], shape[4], shape[7]) = (0.1 * f64::from(i), 0.07 * f64::from(i), 0.05 * f64::from(i));
        cell.obstacle(&shape).map(|_| shape)
    });
    let shape = found.expect("mode 1 cannot close every shape");
    assert!(velocity(&cell, &shape).iter().all(|v| v.is_nan()));
    assert!(matches!(cell.outline(&shape, 1.0, 64), Outline::NotClosed { residual } if residual.is_finite()));
}

#[test]
fn crossings_are_found() {
    let eight: Vec<[f64; 2]> =
        (0..101).map(|i| TAU * (f64::from(i) + 0.3) / 101.0).map(|t| [t.sin(), (2.0 * t).sin()]).collect();
    let [x, y] = first_crossing(&eight).unwrap();
    assert!(x.abs() < 0.02 && y.abs() < 0.02);
    let circle: Vec<[f64; 2]> =
        (0..100).map(|i| TAU * f64::from(i) / 100.0).map(|t| [t.cos(), t.sin()]).collect();
    assert_eq!(first_crossing(&circle), None);
}
