//! Relative equilibria against formulas (physics of the 1:2 mode interaction) and against an independent linearisation.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::{Random, cell, near, reduced, settings};
use motiform_analysis::RelativeEquilibrium;
use motiform_analysis::symmetry::reduced_speed;
use motiform_dynamics::steppers::Method;
use motiform_dynamics::{Equivariant, Request, StepControl, VectorField, drive::drive};
use nalgebra::DMatrix;
use std::f64::consts::TAU;

/// B = b1/4 of the reduced model; a1 = b3 = 1.
const B: f64 = 0.125;

/// Eigenvalues are good to the rounding of a 6 x 6 matrix with entries of order 1.
const EXACT: f64 = 1e-11;

fn found(body: &impl Equivariant, guess: &[f64]) -> RelativeEquilibrium {
    let found = RelativeEquilibrium::find(body, guess).unwrap();
    let mut rate = vec![0.0; guess.len()];
    VectorField::<f64>::eval(body, 0.0, &found.shape, &mut rate);
    assert!(reduced_speed(body, &found.shape, &rate) < 1e-12 * found.scale, "{found:?}");
    found
}

fn real_parts(found: &RelativeEquilibrium) -> Vec<f64> {
    found.eigenvalues.iter().map(|value| value.0).collect()
}

fn all_near(seen: &[f64], want: &[f64], tolerance: f64) {
    let mut want = want.to_vec();
    want.sort_by(|a, b| b.total_cmp(a));
    assert_eq!(seen.len(), want.len(), "{seen:?} {want:?}");
    for (s, w) in seen.iter().zip(&want) {
        near(*s, *w, tolerance);
    }
}

/// A start near `shape`, anywhere on its group orbit.
fn beside(body: &impl Equivariant, shape: &[f64], size: f64, random: &mut Random) -> Vec<f64> {
    let mut start = shape.to_vec();
    body.rotate(TAU * random.next(), &mut start);
    start.iter_mut().for_each(|x| *x += size * random.next());
    start
}

#[test]
fn the_circle_has_its_rates_twice_and_no_neutral_direction() {
    let (gamma, kappa2) = (-0.04, 0.07);
    let body = reduced(kappa2, gamma);
    for guess in [[0.0; 6], [1e-3, 2e-3, -1e-3, 1e-3, 1e-3, 0.0]] {
        let circle = found(&body, &guess);
        assert!(circle.shape.iter().all(|x| x.abs() < 1e-12), "{circle:?}");
        assert_eq!((circle.neutral, circle.turning_rate), (0, 0.0));
        all_near(&real_parts(&circle), &[gamma, gamma, -kappa2, -kappa2, -1.0, -1.0], EXACT);
    }
}

#[test]
fn the_ellipse_is_the_saddle_of_the_formulas() {
    let (gamma, kappa2) = (-0.04, -0.1_f64);
    let body = reduced(kappa2, gamma);
    let r2 = (-kappa2 / 8.0).sqrt();
    let mut random = Random(11);
    for _ in 0..50 {
        let start = beside(&body, &[0.0, 0.0, r2, 0.0, 0.0, 0.0], 0.01, &mut random);
        let ellipse = found(&body, &start);
        near(ellipse.shape[2].hypot(ellipse.shape[3]), r2, EXACT);
        assert!(ellipse.speed() < 1e-12 && ellipse.turning_rate.abs() < 1e-12);
        assert_eq!(ellipse.neutral, 1);
        let (plus, minus) = (gamma + 2.0 * r2, gamma - 2.0 * r2);
        all_near(&real_parts(&ellipse), &[plus, minus, 2.0 * kappa2, -1.0, -1.0], EXACT);
        let saddle = ellipse.saddle(&body).unwrap();
        near(saddle.out, plus, EXACT);
        near(saddle.inward, minus, EXACT);
    }
    // stable: no saddle
    let stable = found(&reduced(kappa2, -0.3), &[0.0, 0.0, r2, 0.0, 0.0, 0.0]);
    assert!(stable.growth() < 0.0 && stable.saddle(&body).is_none());
}

/// Straight motion: r1^2 = gamma - 2 s, kappa2 s + 8 s^3 = B r1^2; eigenvalues of the (r1, s) block, of psi, of z3.
#[test]
fn straight_motion_has_the_eigenvalues_of_the_amplitude_equations() {
    for (s, gamma) in [(0.05, 0.2), (-0.1, -0.12_f64), (-0.03, 0.02)] {
        let r1 = (gamma - 2.0 * s).sqrt();
        let kappa2 = (B * r1 * r1 - 8.0 * s * s * s) / s;
        let body = reduced(kappa2, gamma);
        let shape = [r1, 0.0, s, 0.0, 0.0, 0.0];
        let mut random = Random(12);
        for _ in 0..20 {
            let straight = found(&body, &beside(&body, &shape, 1e-3, &mut random));
            near(straight.speed(), r1, EXACT);
            near(straight.turning_rate, 0.0, EXACT);
            let (a, b, c, d) = (-2.0 * r1 * r1, -2.0 * r1, 2.0 * B * r1, -kappa2 - 24.0 * s * s);
            let (mean, square) = (0.5 * (a + d), 0.25 * (a - d) * (a - d) + b * c);
            let part = if square > 0.0 { square.sqrt() } else { 0.0 };
            let psi = 4.0 * s - B * r1 * r1 / s;
            all_near(&real_parts(&straight), &[mean + part, mean - part, psi, -1.0, -1.0], 1e-10);
        }
    }
}

/// Circular motion: 4 r2^2 = B r1^2, r2^2 = (2 gamma - kappa2)/72, turning rate 2 r2 |sin psi|; each eigenvalue is a root of
/// the characteristic polynomial of (r1, r2, psi), or -kappa3 -+ 3 i omega.
#[test]
fn circular_motion_has_its_radius_rate_and_eigenvalues() {
    for (kappa2, gamma) in [(-0.1, 0.1), (-0.2, 0.05), (0.02, 0.05), (0.06, 0.1)] {
        let r2 = ((2.0 * gamma - kappa2) / 72.0_f64).sqrt();
        let r1 = (32.0 * r2 * r2).sqrt();
        let cos = (gamma - r1 * r1) / (2.0 * r2);
        let sin = (1.0 - cos * cos).sqrt();
        for side in [1.0, -1.0] {
            let body = reduced(kappa2, gamma);
            let shape = [r1, 0.0, r2 * cos, side * r2 * sin, 0.0, 0.0];
            let circular = found(&body, &beside(&body, &shape, 1e-4, &mut Random(13)));
            near(circular.speed(), r1, EXACT);
            // the heading is -p1, and p1' = -2 r2 sin psi
            near(circular.turning_rate, side * 2.0 * r2 * sin, EXACT);
            let matrix = [
                [-2.0 * r1 * r1, -2.0 * r1 * cos, 2.0 * r1 * r2 * sin],
                [2.0 * B * r1 * cos, -kappa2 - 24.0 * r2 * r2, -B * r1 * r1 * sin],
                [-2.0 * B * r1 / r2 * sin, 8.0 * sin, 0.0],
            ];
            let mut want: Vec<f64> = DMatrix::from_fn(3, 3, |i, j| matrix[i][j])
                .complex_eigenvalues()
                .iter()
                .map(|z| z.re)
                .collect();
            want.extend([-1.0, -1.0]);
            all_near(&real_parts(&circular), &want, 1e-9);
            let fast =
                circular.eigenvalues.iter().any(|z| (z.1 - 3.0 * circular.turning_rate.abs()).abs() < EXACT);
            assert!(fast, "z3 turns three times as fast: {circular:?}");
        }
    }
}

/// Eigenvalues of central differences of the field (exact for a quadratic one), with the rotation taken out.
fn differences(body: &impl Equivariant, found: &RelativeEquilibrium) -> Vec<f64> {
    let dim = found.shape.len();
    let h = 1e-3;
    let field = |u: &[f64]| {
        let (mut rate, mut spin) = (vec![0.0; dim], vec![0.0; dim]);
        VectorField::<f64>::eval(body, 0.0, u, &mut rate);
        body.spin(u, &mut spin);
        rate.iter().zip(&spin).map(|(f, g)| f - found.turning_rate * g).collect::<Vec<f64>>()
    };
    let column = |j: usize| {
        let (mut up, mut down) = (found.shape.clone(), found.shape.clone());
        up[j] += h;
        down[j] -= h;
        field(&up).iter().zip(field(&down)).map(|(a, b)| (a - b) / (2.0 * h)).collect::<Vec<f64>>()
    };
    let columns: Vec<Vec<f64>> = (0..dim).map(column).collect();
    let matrix = DMatrix::from_fn(dim, dim, |i, j| columns[j][i]);
    let mut values: Vec<f64> = matrix.complex_eigenvalues().iter().map(|z| z.re).collect();
    let neutral = (0..dim).min_by(|&a, &b| values[a].abs().total_cmp(&values[b].abs())).unwrap();
    assert!(values[neutral].abs() < 1e-9 * found.scale, "{}", values[neutral]);
    values.remove(neutral);
    values.sort_by(|a, b| b.total_cmp(a));
    values
}

#[test]
fn shapes_of_the_cell_have_the_eigenvalues_of_an_independent_linearisation() {
    // straight, circular, two-fold at rest, two-fold saddle, three-fold at rest
    for (length, moves, turns) in
        [(8.0, true, false), (12.6, true, true), (17.0, false, false), (25.0, false, false)]
    {
        let body = cell(length, 12);
        let start = Random(21).state(24, 0.01);
        let control = StepControl::Adaptive { rtol: 1e-7, atol: 1e-8 };
        let method = Method::find("krogstad4").unwrap();
        let mut orbit = method.shape_orbit(&body, control, 0.0, &start).unwrap();
        drive(orbit.as_mut(), &Request::until(4000.0, 24), &mut ()).unwrap();
        let shape = found(&body, orbit.state());
        println!("{length}: {:.3e} {:.3e} {:?}", shape.speed(), shape.turning_rate, &shape.eigenvalues[..3]);
        assert_eq!(shape.neutral, 1);
        assert_eq!(shape.speed() > 1e-9, moves);
        assert_eq!(shape.turning_rate.abs() > 1e-6, turns);
        assert!(shape.growth() < 0.0);
        let want = differences(&body, &shape);
        // eigenvalues of a matrix that is not normal, with entries up to `scale`
        for (seen, want) in real_parts(&shape).iter().zip(&want) {
            near(*seen, *want, 1e-9 * shape.scale);
        }
    }
}

#[test]
fn the_resting_ellipse_of_the_cell_is_the_saddle_of_its_rectangular_motion() {
    let body = cell(14.0, 12);
    let mut guess = vec![0.0; 24];
    guess[2] = 0.5; // mode 2 alone grows to the pure shape
    let settings = settings("cell");
    let mut orbit = settings.method.shape_orbit(&body, settings.control, 0.0, &guess).unwrap();
    drive(orbit.as_mut(), &Request::until(2000.0, 24), &mut ()).unwrap();
    let ellipse = found(&body, orbit.state());
    assert!(ellipse.shape.chunks_exact(4).all(|pair| pair[0].hypot(pair[1]) < 1e-9), "odd modes are absent");
    let saddle = ellipse.saddle(&body).unwrap();
    let want = differences(&body, &ellipse);
    near(saddle.out, want[0], 1e-9 * ellipse.scale);
    assert!(want.iter().any(|x| (x - saddle.inward).abs() < 1e-9 * ellipse.scale));
    assert!(saddle.out > 0.0 && saddle.inward < 0.0 && saddle.out + saddle.inward < 0.0);
}

/// Any start leads to a true solution or to none; the neutral direction never shows among the eigenvalues.
#[test]
fn random_starts_find_solutions_or_nothing() {
    let mut random = Random(31);
    let mut solved = 0;
    for _ in 0..300 {
        let body = reduced(random.between(-0.22, 0.22), random.between(-0.16, 0.12));
        let Some(_) = RelativeEquilibrium::find(&body, &random.state(6, 0.3)) else { continue };
        solved += 1;
    }
    println!("{solved} of 300");
    assert!(solved > 200);
    assert!(RelativeEquilibrium::find(&reduced(0.1, 0.1), &[f64::NAN; 6]).is_none());
}
