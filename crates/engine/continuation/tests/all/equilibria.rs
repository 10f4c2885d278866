//! Branches of relative equilibria against normal forms, the lines of the reduced model, and closed forms of the full one.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::{full, near, reduced};
use motiform_analysis::{Error, RelativeEquilibrium, Result};
use motiform_continuation::{Branch, Broken, End, Family, Hopf, Point, Settings, Special, switch};
use motiform_dynamics::{Equivariant, Scalar, VectorField};
use motiform_models::tensor::reduced::Reduced;
use motiform_models::zoo;

type Body = Result<Box<dyn Equivariant>>;

/// All points of the branch from the equilibrium near `guess`.
fn branch(family: &dyn Family, p: f64, guess: &[f64], settings: &Settings) -> (Vec<Point>, End) {
    let start = RelativeEquilibrium::find(family.at(p).unwrap().as_ref(), guess).unwrap();
    let mut branch = Branch::of_equilibria(family, p, &start, settings, &()).unwrap();
    let points: Vec<Point> = branch.by_ref().collect();
    let end = branch.end().unwrap().clone();
    (points, end)
}

/// The special points among them.
fn specials(points: &[Point]) -> Vec<(f64, Special)> {
    points.iter().filter_map(|point| Some((point.parameter, point.special?))).collect()
}

/// The only special point.
fn only(points: &[Point]) -> &Point {
    let mut all = points.iter().filter(|point| point.special.is_some());
    let first = all.next().unwrap();
    assert!(all.next().is_none(), "{:?}", specials(points));
    first
}

/// `x' = p + x - x^3/3`: folds at `x = -1, 1`, `p = 2/3, -2/3`.
struct Fold(f64);
motiform_models::plain!(Fold, 1);
impl<T: Scalar> VectorField<T> for Fold {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let x = u[0];
        du[0] = x.constant(self.0) + x - x * x * x * (1.0 / 3.0);
    }
}

#[test]
fn a_branch_turns_at_its_folds_and_comes_to_the_other_end_of_the_range() {
    let family = |p: f64| -> Body { Ok(Box::new(Fold(p))) };
    let (points, end) = branch(&family, -2.0, &[-2.4], &Settings::over(-2.0, 2.0));
    let found = specials(&points);
    assert_eq!(found.iter().map(|s| s.1).collect::<Vec<_>>(), [Special::Fold, Special::Fold]);
    near(found[0].0, 2.0 / 3.0, 1e-12); // the parameter is quadratic in what the location leaves
    near(found[1].0, -2.0 / 3.0, 1e-12);
    assert_eq!((end, points.last().unwrap().parameter), (End::RangeLeft, 2.0));
    let between = points.iter().filter(|p| p.special.is_none() && p.motion.shape()[0].abs() < 1.0);
    assert!(between.clone().count() > 3 && between.clone().all(|p| p.unstable == 1 && p.slope < 0.0));
}

/// `x' = p x - x^2` has no symmetry: two branches cross at 0, `x = 0` and `x = p`.
struct Crossing(f64);
motiform_models::plain!(Crossing, 1);
impl<T: Scalar> VectorField<T> for Crossing {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        du[0] = u[0] * self.0 - u[0] * u[0];
    }
}

#[test]
fn both_sides_of_a_crossing_branch_are_followed() {
    let family = |p: f64| -> Body { Ok(Box::new(Crossing(p))) };
    let settings = Settings::over(-1.03, 1.0);
    let (points, _) = branch(&family, -1.03, &[-1e-9], &settings);
    let point = only(&points);
    assert_eq!(point.special, Some(Special::BranchPoint));
    near(point.parameter, 0.0, 1e-9);
    let mut ends = Vec::new();
    for side in switch(&family, point, &settings, &()).unwrap() {
        for point in side.into_iter().flatten() {
            near(point.motion.shape()[0], point.parameter, 1e-9);
            ends.push(point.parameter);
        }
    }
    assert!(ends.contains(&-1.03) && ends.contains(&1.0), "{ends:?}");
}

/// `z' = (p + 3i) z + c |z|^2 z`, and a decaying direction that the oscillation drives: `w' = -w + d |z|^2`, which acts back as
/// `w z`. On the centre manifold `w = d |z|^2 (1 + ..)`: to third order `c + d`.
struct Driven {
    p: f64,
    c: f64,
    d: f64,
}
motiform_models::plain!(Driven, 3);
impl<T: Scalar> VectorField<T> for Driven {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, y, w) = (u[0], u[1], u[2]);
        let square = x * x + y * y;
        let growth = x.constant(self.p) + square * self.c + w;
        du[0] = growth * x - y * 3.0;
        du[1] = growth * y + x * 3.0;
        du[2] = square * self.d - w;
    }
}

/// The critical vector of length 1 is `(1, -i)/sqrt 2`: `z = sqrt 2 a`, so the cubic coefficient is `2 (c + d)` and `l1 = 2 (c + d)/3`.
#[test]
fn the_first_lyapunov_coefficient_of_normal_forms_is_exact() {
    for (c, d) in [(-1.0, 0.0), (1.0, 0.0), (-1.0, 3.0), (2.0, -2.5)] {
        let family = move |p: f64| -> Body { Ok(Box::new(Driven { p, c, d })) };
        let (points, _) = branch(&family, -0.5, &[0.0, 0.0, 0.0], &Settings::over(-0.5, 0.5));
        let point = only(&points);
        let Some(Special::Hopf(Hopf { frequency, first_lyapunov, .. })) = point.special else {
            unreachable!()
        };
        near(point.parameter, 0.0, 1e-9);
        near(frequency, 3.0, 1e-9);
        near(first_lyapunov.coefficient().unwrap().value, 2.0 * (c + d) / 3.0, 1e-9);
    }
}

/// The reduced model along gamma.
fn along_gamma(kappa2: f64) -> impl Fn(f64) -> Body {
    move |gamma| Ok(Box::new(reduced(kappa2, gamma)))
}

#[test]
fn the_lines_of_the_reduced_model_are_met_where_its_formulas_say() {
    let settings = Settings::over(-0.16, 0.12);
    // a circle starts to move
    let (points, _) = branch(&along_gamma(0.1), -0.16, &[0.0; 6], &settings);
    let point = only(&points);
    assert_eq!(point.special, Some(Special::Pitchfork { breaks: Broken::Rotations }));
    near(point.parameter, 0.0, 1e-9);
    // an ellipse starts to move, along one axis and along the other
    let r2 = Reduced::PAPER.ellipse(-0.04).unwrap();
    let (points, _) = branch(&along_gamma(-0.04), -0.16, &[0.0, 0.0, r2, 0.0, 0.0, 0.0], &settings);
    let found = specials(&points);
    assert!(found.iter().all(|s| s.1 == Special::Pitchfork { breaks: Broken::Rotations }), "{found:?}");
    near(found[0].0, Reduced::PAPER.ellipse_to_straight(r2)[1], 1e-9);
    assert_eq!(found.len(), 2 - usize::from(2.0 * r2 > 0.12));
    // a circle becomes an ellipse
    let along_kappa2 = |kappa2: f64| -> Body { Ok(Box::new(reduced(kappa2, -0.1))) };
    let (points, _) = branch(&along_kappa2, 0.2, &[0.0; 6], &Settings::over(0.2, -0.2));
    assert_eq!(only(&points).special, Some(Special::Pitchfork { breaks: Broken::Rotations }));
    near(only(&points).parameter, 0.0, 1e-9);
}

#[test]
fn straight_motion_bends_and_circular_motion_oscillates_on_the_lines_of_the_reduced_model() {
    let [kappa2, gamma] = Reduced::PAPER.straight_to_circular(0.03);
    let family = along_gamma(kappa2);
    let settings = Settings::over(0.01, 0.2);
    let (points, _) = branch(&family, 0.01, &[0.1, 0.0, 0.01, 0.0, 0.0, 0.0], &settings);
    let point = only(&points);
    assert_eq!(point.special, Some(Special::Pitchfork { breaks: Broken::Mirror }));
    near(point.parameter, gamma, 1e-9);
    // the branch that begins there turns at the rate of the formula, sqrt(1 - cos^2) (2 a1 r2)
    let circular = switch(&family, point, &settings, &()).unwrap().pop().unwrap().pop().unwrap();
    let far = circular.last().unwrap();
    assert_eq!(far.parameter, 0.2);
    let expected = Reduced::PAPER.circular(kappa2, 0.2).unwrap();
    near(far.motion.equilibrium().unwrap().turning_rate.abs(), expected.turning_rate, 1e-10);
    assert!(far.is_stable() && expected.stable);
    // below gamma = -(2/5) kappa2 it oscillates
    let family = along_gamma(-0.06);
    let circular = Reduced::PAPER.circular(-0.06, 0.1).unwrap();
    let sine = (1.0 - circular.cos_psi * circular.cos_psi).sqrt();
    let guess = [circular.speed, 0.0, circular.r2 * circular.cos_psi, circular.r2 * sine, 0.0, 0.0];
    let (points, _) = branch(&family, 0.1, &guess, &Settings::over(0.1, 0.005));
    let hopf = points.iter().find(|point| matches!(point.special, Some(Special::Hopf(_)))).unwrap();
    near(hopf.parameter, 0.4 * 0.06, 1e-9);
}

/// The sign of the first Lyapunov coefficient is that of the formula, and both vanish at one place.
#[test]
fn the_kind_of_the_hopf_bifurcation_of_straight_motion_is_that_of_the_formula() {
    let ratio = |s: f64| {
        let [kappa2, gamma] = Reduced::PAPER.straight_hopf(s);
        let speed = (gamma - 2.0 * s).sqrt();
        let family = along_gamma(kappa2);
        let settings = Settings { largest_step: 0.1, ..Settings::over(gamma - 0.002, gamma + 0.002) };
        let (points, _) = branch(&family, gamma, &[speed, 0.0, s, 0.0, 0.0, 0.0], &settings.reversed());
        let (other, _) = branch(&family, gamma, &[speed, 0.0, s, 0.0, 0.0, 0.0], &settings);
        let (more, _) = branch(
            &family,
            points.last().unwrap().parameter,
            points.last().unwrap().motion.shape(),
            &settings,
        );
        let found: Vec<Point> = more.into_iter().chain(other).filter(|p| p.special.is_some()).collect();
        let Some(Special::Hopf(hopf)) = found[0].special else { unreachable!() };
        near(found[0].parameter, gamma, 1e-10);
        (hopf.first_lyapunov.coefficient().unwrap().value, Reduced::PAPER.straight_hopf_criticality(s))
    };
    let (mut low, mut high) = (-0.045, -0.02);
    let kind = |s: f64| Reduced::PAPER.straight_hopf_criticality(s);
    assert!(kind(low) * kind(high) < 0.0);
    for s in [low, -0.04, -0.03, high] {
        let (found, expected) = ratio(s);
        assert!(found / expected > 0.0, "{s}: {found} {expected}");
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if kind(middle) * kind(low) > 0.0 { low = middle } else { high = middle }
    }
    let there = ratio(low).0.abs();
    assert!(there < 1e-5 * ratio(-0.045).0.abs(), "{there}"); // differences of fourth order
}

/// The full model along kappa2 at kappa3 = 0.1.
fn full_model(kappa2: f64) -> Body {
    Ok(Box::new(full(kappa2, 0.1)))
}

/// Coefficients e11, e21, e22, e31, e32 of the full model, from its parameters.
const E: [f64; 5] = [2.0, -0.125, 0.3, 0.0125, 0.4];

/// With `z_n = conj..` turning as `exp(-i n Omega t)` and `z1 = r`, `q = r^2`:
/// `(kappa2 - 2i Omega)(kappa3 - 3i Omega) z2 = e21 q (kappa3 - 3i Omega) + e22 q (e31 q + e32 z2)`, `e11 z2 = q - gamma - i Omega`.
/// The real and the imaginary part of the difference.
fn closed_form(kappa2: f64, kappa3: f64, q: f64, omega: f64) -> [f64; 2] {
    let [e11, e21, e22, e31, e32] = E;
    let times = |a: [f64; 2], b: [f64; 2]| [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]];
    let z2 = [(q - 1.0) / e11, -omega / e11];
    let left = times(times([kappa2, -2.0 * omega], [kappa3, -3.0 * omega]), z2);
    let right = [
        e21 * q * kappa3 + e22 * q * (e31 * q + e32 * z2[0]),
        -3.0 * e21 * q * omega + e22 * q * e32 * z2[1],
    ];
    [left[0] - right[0], left[1] - right[1]]
}

/// `q` of straight motion: a root of a quadratic.
fn straight_square(kappa2: f64, kappa3: f64) -> f64 {
    let [e11, e21, e22, e31, e32] = E;
    let a = e22 * (e31 * e11 + e32);
    let b = e11 * e21 * kappa3 - e22 * e32 - kappa2 * kappa3;
    let c = kappa2 * kappa3;
    let root = (b * b - 4.0 * a * c).sqrt();
    (-b - root) / (2.0 * a)
}

#[test]
fn the_relative_equilibria_of_the_full_model_solve_its_two_quadratics() {
    let settings = Settings::over(0.3, 3.0).reversed();
    let (points, end) = branch(&full_model, 3.0, &[1.0, 0.0, -0.04, 0.0, 0.0, 0.0], &settings);
    assert_eq!(end, End::RangeLeft);
    for point in &points {
        let [re, im] = [point.motion.shape()[0], point.motion.shape()[1]];
        near(re * re + im * im, straight_square(point.parameter, 0.1), 1e-10);
    }
    // the drift pitchfork: the imaginary part over Omega vanishes as well
    let drift = |kappa2: f64| {
        let q = straight_square(kappa2, 0.1);
        (0.2 + 3.0 * kappa2) * (q - 1.0) + 0.1 * kappa2 - (3.0 * E[0] * E[1] + E[2] * E[4]) * q
    };
    let (mut low, mut high) = (2.0, 3.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if drift(middle) * drift(low) > 0.0 { low = middle } else { high = middle }
    }
    let bend = only(&points);
    assert_eq!(bend.special, Some(Special::Pitchfork { breaks: Broken::Mirror }));
    near(bend.parameter, low, 1e-9);
    near(bend.parameter, 2.713_569, 1e-6); // an independent program's digits

    let mut branches = switch(&full_model, bend, &settings, &()).unwrap();
    assert_eq!(branches.len(), 1, "left and right are copies");
    let circular: Vec<Point> = branches.pop().unwrap().pop().unwrap().collect();
    assert!(circular.iter().filter(|point| point.parameter < 2.7).count() > 30);
    for point in &circular {
        let motion = point.motion.equilibrium().unwrap();
        let [re, im] = [motion.shape[0], motion.shape[1]];
        let [a, b] = closed_form(point.parameter, 0.1, re * re + im * im, motion.turning_rate);
        assert!(a.hypot(b) < 1e-10, "{} {a} {b}", point.parameter);
    }
    let hopf = only(&circular);
    near(hopf.parameter, 1.121_937, 1e-6);
    let Some(Special::Hopf(kind)) = hopf.special else { unreachable!() };
    near(kind.period(), 21.6002, 1e-4);
    assert_eq!(kind.is_supercritical(), Some(false));
    assert!(
        circular
            .iter()
            .filter(|p| p.special.is_none())
            .all(|p| p.is_stable() == (p.parameter > hopf.parameter))
    );
}

#[test]
fn a_branch_has_the_same_bits_every_time() {
    let settings = Settings::over(0.3, 3.0).reversed();
    let run = || branch(&full_model, 3.0, &[1.0, 0.0, -0.04, 0.0, 0.0, 0.0], &settings);
    assert_eq!(run(), run());
}

#[test]
fn what_cannot_be_followed_is_refused_with_a_remedy() {
    let start = RelativeEquilibrium::find(&zoo::Hopf { mu: -0.5, omega: 2.0 }, &[0.1, 0.0]).unwrap();
    let family = |mu: f64| -> Body { Ok(Box::new(zoo::Hopf { mu, omega: 2.0 })) };
    let refused = |p: f64, start: &RelativeEquilibrium, settings: Settings| {
        Branch::of_equilibria(&family, p, start, &settings, &()).err().unwrap()
    };
    let range = Settings::over(-1.0, 1.0);
    assert!(matches!(refused(2.0, &start, range), Error::OutsideRange { .. }));
    assert!(matches!(refused(0.0, &start, Settings::over(1.0, 1.0)), Error::OutOfRange { .. }));
    assert!(matches!(refused(0.0, &start, Settings { first_step: 0.0, ..range }), Error::OutOfRange { .. }));
    let long = RelativeEquilibrium { shape: vec![0.0; 3], ..start.clone() };
    assert!(matches!(refused(0.0, &long, range), Error::Shape { expected: 2, got: 3, .. }));
    let wrong = RelativeEquilibrium { shape: vec![0.7, 0.7], ..start.clone() };
    let far = |p: f64| -> Body { Ok(Box::new(Fold(p))) };
    let wrong = RelativeEquilibrium { shape: vec![wrong.shape[0] * 1e3], ..wrong };
    assert!(matches!(
        Branch::of_equilibria(
            &far,
            1.0,
            &RelativeEquilibrium { shape: vec![f64::NAN], ..wrong },
            &range,
            &()
        ),
        Err(Error::NotOnABranch { .. })
    ));
    let none = |p: f64| -> Body {
        if p < 0.2 { far(p) } else { Err(Error::NoBody { value: p, why: "too large".to_owned() }) }
    };
    let rest = RelativeEquilibrium::find(&Fold(-1.0), &[-2.1]).unwrap();
    let mut branch = Branch::of_equilibria(&none, -1.0, &rest, &range, &()).unwrap();
    let last = branch.by_ref().last().unwrap();
    let Some(End::StepUnderflow { why, .. }) = branch.end() else { unreachable!() };
    assert!(why.to_string().contains("too large") && last.parameter > 0.19, "{why} {}", last.parameter);
}
