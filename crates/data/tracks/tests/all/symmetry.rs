//! The effect of a rotation, translation, scale, mirror, another first vertex or sense on the modes.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{normal, uniform};
use crate::fits::random;
use motiform_tracks::modes::{ModeOptions, RadiusFit, TangentModes, fold, outline_modes};
use motiform_tracks::synthetic::blur;

type Points = Vec<[f64; 2]>;
type Expected = dyn Fn(usize, [f64; 2]) -> [f64; 2];

fn fitted(points: &[[f64; 2]]) -> (RadiusFit, TangentModes) {
    let modes = outline_modes(points, &ModeOptions::default());
    (modes.radius.unwrap(), modes.tangent.unwrap())
}

/// Largest difference of modes from those expected, relative to R0.
fn difference(before: &[[f64; 2]], after: &[[f64; 2]], expected: &Expected, r0: f64) -> f64 {
    let part = |(k, (a, b)): (usize, (&[f64; 2], &[f64; 2]))| {
        let wanted = expected(k + 2, *a);
        (b[0] - wanted[0]).abs().max((b[1] - wanted[1]).abs()) / r0
    };
    before.iter().zip(after).enumerate().map(part).fold(0.0, f64::max)
}

/// Applies a change to noisy outlines and compares modes, centre and errors.
fn check(
    change: impl Fn(&Points) -> Points,
    expected: &Expected,
    centre: impl Fn([f64; 2]) -> [f64; 2],
    scale: f64,
) {
    let (mut next, mut noise) = (uniform(3), normal(3));
    for _ in 0..100 {
        let size = 0.6 * next();
        let truth = random(&mut next, size);
        let mut points = truth.vertices(30 + (50.0 * next()) as usize, next());
        blur(&mut points, 0.01 * truth.r0, &mut noise);
        let ((radius, tangent), (other, turned)) = (fitted(&points), fitted(&change(&points)));
        let r0 = scale * truth.r0;
        assert!(difference(&radius.z, &other.z, expected, r0) < 1e-13);
        assert!(difference(&tangent.w, &turned.w, expected, r0) < 1e-13);
        let wanted = centre(radius.centre);
        assert!((0..2).all(|k| (other.centre[k] - wanted[k]).abs() < 1e-13 * (r0 + wanted[k].abs())));
        assert!((other.r0 - scale * radius.r0).abs() < 1e-13 * r0);
        assert!((other.sigma - scale * radius.sigma).abs() < 1e-12 * scale * radius.sigma);
    }
}

fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    [x * angle.cos() - y * angle.sin(), x * angle.sin() + y * angle.cos()]
}

#[test]
fn rotation_multiplies_by_a_phase() {
    for angle in [0.4, 2.0, -3.0] {
        let phase = move |n: usize, z: [f64; 2]| turned(z, -(n as f64) * angle);
        check(|points| points.iter().map(|p| turned(*p, angle)).collect(), &phase, |c| turned(c, angle), 1.0);
    }
}

#[test]
fn translation_moves_the_centre() {
    let shift = |p: [f64; 2]| [p[0] + 3.0, p[1] - 2.0];
    check(|points| points.iter().map(|p| shift(*p)).collect(), &|_, z| z, shift, 1.0);
}

#[test]
fn scale_multiplies_all() {
    let times = |p: [f64; 2]| p.map(|x| 0.3589 * x);
    check(|points| points.iter().map(|p| times(*p)).collect(), &move |_, z| times(z), times, 0.3589);
}

#[test]
fn another_first_vertex_changes_nothing() {
    let rotate = |points: &Points| [&points[11..], &points[..11]].concat();
    check(rotate, &|_, z| z, |c| c, 1.0);
}

#[test]
fn the_other_sense_changes_nothing() {
    check(|points| points.iter().rev().copied().collect(), &|_, z| z, |c| c, 1.0);
}

#[test]
fn a_mirror_conjugates() {
    let mirror = |p: [f64; 2]| [p[0], -p[1]];
    check(|points| points.iter().map(|p| mirror(*p)).collect(), &move |_, z| mirror(z), mirror, 1.0);
}

/// The covariance turns with the modes.
#[test]
fn covariances_turn_too() {
    let (mut next, mut noise) = (uniform(4), normal(4));
    let mut points = random(&mut next, 0.5).vertices(50, 0.0);
    blur(&mut points, 0.02, &mut noise);
    let quarter: Points = points.iter().map(|[x, y]| [-y, *x]).collect();
    let (a, b) = (fitted(&points).0, fitted(&quarter).0);
    let (a, b) = (a.observed_covariance(1.0, 3), b.observed_covariance(1.0, 3));
    // X' = -Y, Y' = X; z2' = -z2; z3' = i z3
    let from = [(1, -1.0), (0, 1.0), (2, -1.0), (3, -1.0), (5, -1.0), (4, 1.0)];
    for (j, (from_j, sign_j)) in from.into_iter().enumerate() {
        for (k, (from_k, sign_k)) in from.into_iter().enumerate() {
            let wanted = sign_j * sign_k * a[from_j][from_k];
            assert!((b[j][k] - wanted).abs() < 1e-12 * (a[0][0] + a[2][2]), "{j} {k}");
        }
    }
}

#[test]
fn folds_do_not_depend_on_the_first_vertex() {
    let square = [
        [1.0, 0.0],
        [1.0, 1.0],
        [-1.0, 1.0],
        [-1.0, -1.0],
        [1.0, -1.0],
        [1.0, -0.5],
        [0.5, -0.5],
        [0.6, -0.2],
    ];
    let backs: Vec<f64> = (0..square.len())
        .map(|k| fold(&[&square[k..], &square[..k]].concat(), [0.0; 2]).unwrap().back)
        .collect();
    assert!(backs[0] > 0.1 && backs.iter().all(|back| (back - backs[0]).abs() < 1e-12), "{backs:?}");
}
