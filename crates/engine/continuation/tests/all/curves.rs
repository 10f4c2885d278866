//! Curves of special points over two parameters, against formulas, normal forms and the digits of an independent program.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::{full, near, reduced};
use motiform_analysis::periodic::PeriodicGuess;
use motiform_analysis::symmetry::align;
use motiform_analysis::{Error, PeriodicOrbit, RelativeEquilibrium, Result};
use motiform_continuation::{
    Branch, Curve, CurvePoint, Degenerate, End, Family, Family2, Point, Settings, Special, WholeCurve, switch,
};
use motiform_dynamics::{Equivariant, Request, Scalar, VectorField, drive::drive};
use motiform_models::tensor::reduced::Reduced;

type Body = Result<Box<dyn Equivariant>>;

/// The first special point of this kind on the branch from the equilibrium near `guess`.
fn special(family: &dyn Family, p: f64, guess: &[f64], settings: &Settings, name: &str) -> Point {
    let start = RelativeEquilibrium::find(family.at(p).unwrap().as_ref(), guess).unwrap();
    let mut branch = Branch::of_equilibria(family, p, &start, settings, &()).unwrap();
    branch.find(|point| point.special.is_some_and(|special| special.name() == name)).unwrap()
}

fn follow(
    family: &dyn Family2,
    point: &Point,
    second: f64,
    settings: &Settings,
    range: (f64, f64),
) -> (Vec<CurvePoint>, End) {
    let mut curve = Curve::of(family, point, second, settings, range, &()).unwrap();
    let points: Vec<CurvePoint> = curve.by_ref().collect();
    (points, curve.end().unwrap().clone())
}

fn degenerate(points: &[CurvePoint]) -> Vec<(Degenerate, [f64; 2])> {
    points.iter().filter_map(|point| Some((point.degenerate?, point.parameters))).collect()
}

/// The reduced model over (gamma, kappa2).
fn plane([gamma, kappa2]: [f64; 2]) -> Body {
    Ok(Box::new(reduced(kappa2, gamma)))
}

#[test]
fn the_lines_where_bodies_at_rest_start_to_move_are_those_of_the_formulas() {
    let settings = Settings::over(-0.16, 0.12);
    let along = |gamma: f64| plane([gamma, 0.1]);
    let point = special(&along, -0.16, &[0.0; 6], &settings, "pitchfork");
    let (points, end) = follow(&plane, &point, 0.1, &settings, (0.01, 0.22));
    assert_eq!(end, End::RangeLeft);
    assert!(points.len() > 10);
    points.iter().for_each(|point| near(point.parameters[0], 0.0, 1e-9));
    near(points.last().unwrap().parameters[1], 0.22, 1e-9);
    // both critical eigenvalues, those of all directions, are left out of the count
    assert!(points.iter().all(|point| point.unstable == 0 && point.degenerate.is_none()));
    let whole = WholeCurve::through(&plane, &point, 0.1, &settings, (0.01, 0.22), &()).unwrap();
    assert_eq!(whole.points[whole.points.len() - points.len() + 1..], points[1..]);
    near(whole.points[0].parameters[1], 0.01, 1e-9);
    assert_eq!(whole.ends, [End::RangeLeft, End::RangeLeft]);
    // the ellipse
    let r2 = Reduced::PAPER.ellipse(-0.04).unwrap();
    let along = |gamma: f64| plane([gamma, -0.04]);
    let point = special(&along, -0.16, &[0.0, 0.0, r2, 0.0, 0.0, 0.0], &settings, "pitchfork");
    for settings in [settings, settings.reversed()] {
        let (points, end) = follow(&plane, &point, -0.04, &settings, (-0.22, -0.001));
        assert!(end == End::RangeLeft && points.len() > 5);
        for CurvePoint { parameters: [gamma, kappa2], .. } in points {
            let r2 = Reduced::PAPER.ellipse(kappa2).unwrap();
            near(gamma, Reduced::PAPER.ellipse_to_straight(r2)[1], 1e-9);
        }
    }
}

#[test]
fn straight_motion_bends_along_the_broken_line_of_the_reduced_model() {
    let [kappa2, gamma] = Reduced::PAPER.straight_to_circular(0.03);
    let settings = Settings::over(0.005, 0.3);
    let along = |gamma: f64| plane([gamma, kappa2]);
    let point = special(&along, 0.01, &[0.1, 0.0, 0.01, 0.0, 0.0, 0.0], &settings, "pitchfork");
    near(point.parameter, gamma, 1e-9);
    let (points, end) = follow(&plane, &point, kappa2, &settings, (0.01, 0.22));
    assert_eq!(end, End::RangeLeft);
    assert!(points.len() > 10);
    for point in points {
        let s = (point.motion.shape()[2].powi(2) + point.motion.shape()[3].powi(2)).sqrt();
        let [kappa2, gamma] = Reduced::PAPER.straight_to_circular(s);
        near(point.parameters[0], gamma, 1e-9);
        near(point.parameters[1], kappa2, 1e-9);
    }
}

#[test]
fn circular_motion_oscillates_along_a_straight_line() {
    let settings = Settings::over(0.001, 0.12);
    let along = |gamma: f64| plane([gamma, -0.06]);
    let circular = Reduced::PAPER.circular(-0.06, 0.1).unwrap();
    let sine = (1.0 - circular.cos_psi * circular.cos_psi).sqrt();
    let guess = [circular.speed, 0.0, circular.r2 * circular.cos_psi, circular.r2 * sine, 0.0, 0.0];
    let point = special(&along, 0.1, &guess, &settings.reversed(), "hopf");
    let (points, end) = follow(&plane, &point, -0.06, &settings.reversed(), (-0.22, -0.001));
    assert_eq!(end, End::RangeLeft);
    assert!(points.len() > 10 && degenerate(&points).is_empty());
    for CurvePoint { parameters: [gamma, kappa2], special, .. } in points {
        near(gamma, -0.4 * kappa2, 1e-9);
        let Special::Hopf(hopf) = special else { unreachable!() };
        assert_eq!(hopf.is_supercritical(), Some(true));
    }
}

#[test]
fn the_hopf_line_of_straight_motion_has_its_bautin_point_where_the_formula_changes_its_sign() {
    let s = -0.03;
    let [kappa2, gamma] = Reduced::PAPER.straight_hopf(s);
    let speed = (gamma - 2.0 * s).sqrt();
    let settings = Settings::over(-0.16, 0.01);
    let along = |gamma: f64| plane([gamma, kappa2]);
    let near_start = Settings::over(gamma - 0.004, gamma + 0.004);
    let start = RelativeEquilibrium::find(&reduced(kappa2, gamma - 0.001), &[speed, 0.0, s, 0.0, 0.0, 0.0]);
    let guess = start.unwrap().shape;
    let point = special(&along, gamma - 0.001, &guess, &near_start, "hopf");
    near(point.parameter, gamma, 1e-9);
    let (points, _) = follow(&plane, &point, kappa2, &settings.reversed(), (-0.2, -0.001));
    for point in &points {
        let s = -(point.motion.shape()[2].powi(2) + point.motion.shape()[3].powi(2)).sqrt();
        let [kappa2, gamma] = Reduced::PAPER.straight_hopf(s);
        near(point.parameters[0], gamma, 1e-8);
        near(point.parameters[1], kappa2, 1e-8);
    }
    let (mut low, mut high) = (-0.045, -0.02);
    let kind = |s: f64| Reduced::PAPER.straight_hopf_criticality(s);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if kind(middle) * kind(low) > 0.0 { low = middle } else { high = middle }
    }
    let [kappa2, gamma] = Reduced::PAPER.straight_hopf(low);
    let found = degenerate(&points);
    let bautin: Vec<_> = found.iter().filter(|found| found.0 == Degenerate::Bautin).collect();
    assert_eq!(bautin.len(), 1);
    near(bautin[0].1[1], kappa2, 1e-6); // differences of fourth order
    near(bautin[0].1[0], gamma, 1e-6);
}

/// `z' = (p + 3i) z + q |z|^2 z`, `w' = -w + d |z|^2` acting back as `w z`: to third order `q + d`.
struct Driven {
    p: f64,
    q: f64,
}
motiform_models::plain!(Driven, 3);
impl<T: Scalar> VectorField<T> for Driven {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, y, w) = (u[0], u[1], u[2]);
        let square = x * x + y * y;
        let growth = x.constant(self.p) + square * self.q + w;
        du[0] = growth * x - y * 3.0;
        du[1] = growth * y + x * 3.0;
        du[2] = square * 0.3 - w;
    }
}

#[test]
fn a_normal_form_has_its_bautin_point_at_the_known_place() {
    let family = |[p, q]: [f64; 2]| -> Body { Ok(Box::new(Driven { p, q })) };
    let along = |p: f64| family([p, -1.0]);
    let settings = Settings::over(-0.5, 0.5);
    let point = special(&along, -0.4, &[0.0; 3], &settings, "hopf");
    let (points, end) = follow(&family, &point, -1.0, &settings, (-1.0, 1.0));
    assert_eq!(end, End::RangeLeft);
    let found = degenerate(&points);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].0, Degenerate::Bautin);
    near(found[0].1[0], 0.0, 1e-9);
    near(found[0].1[1], -0.3, 1e-7);
}

/// `x' = p + q x - x^3`: folds on `27 p^2 = 4 q^3`, a cusp at 0.
struct Cusp(f64, f64);
motiform_models::plain!(Cusp, 1);
impl<T: Scalar> VectorField<T> for Cusp {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let x = u[0];
        du[0] = x.constant(self.0) + x * self.1 - x * x * x;
    }
}

#[test]
fn folds_meet_in_a_cusp() {
    let family = |[p, q]: [f64; 2]| -> Body { Ok(Box::new(Cusp(p, q))) };
    let along = |p: f64| family([p, 0.8]);
    let settings = Settings::over(-1.0, 1.0);
    let point = special(&along, -1.0, &[-1.2], &settings, "fold");
    let (points, end) = follow(&family, &point, 0.8, &settings.reversed(), (-0.5, 1.0));
    assert_eq!(end, End::RangeLeft);
    let last = points.last().unwrap().parameters;
    near(last[1], 1.0, 1e-9);
    assert!(last[0] * points[0].parameters[0] < 0.0, "the other side");
    for point in &points {
        let [p, q] = point.parameters;
        near(27.0 * p * p, 4.0 * q * q * q, 1e-8);
    }
    let found = degenerate(&points);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].0, Degenerate::Cusp);
    near(found[0].1[0], 0.0, 1e-8);
    near(found[0].1[1], 0.0, 1e-8);
}

/// `x' = y`, `y' = p + q x + x^2 - x y`: folds on `4 p = q^2`, Hopf bifurcations on `p = 0`, `q < 0`; both meet at 0.
struct Bogdanov(f64, f64);
motiform_models::plain!(Bogdanov, 2);
impl<T: Scalar> VectorField<T> for Bogdanov {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, y) = (u[0], u[1]);
        du[0] = y;
        du[1] = x.constant(self.0) + x * self.1 + x * x - x * y;
    }
}

#[test]
fn a_hopf_curve_ends_and_a_fold_curve_passes_at_a_bogdanov_takens_point() {
    let family = |[p, q]: [f64; 2]| -> Body { Ok(Box::new(Bogdanov(p, q))) };
    let along = |p: f64| family([p, -0.5]);
    let settings = Settings::over(-1.0, 1.0);
    let point = special(&along, -0.3, &[-0.35, 0.0], &settings, "hopf");
    near(point.parameter, 0.0, 1e-9);
    let (points, end) = follow(&family, &point, -0.5, &settings, (-1.0, 1.0));
    assert_eq!(end, End::Degenerate { kind: Degenerate::BogdanovTakens });
    let last = points.last().unwrap();
    assert_eq!(last.degenerate, Some(Degenerate::BogdanovTakens));
    near(last.parameters[0], 0.0, 1e-8);
    near(last.parameters[1], 0.0, 1e-8);
    let point = special(&along, -0.3, &[-0.35, 0.0], &settings, "fold");
    let (points, _) = follow(&family, &point, -0.5, &settings, (-1.0, 1.0));
    points.iter().for_each(|p| near(4.0 * p.parameters[0], p.parameters[1].powi(2), 1e-9));
    let found = degenerate(&points);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].0, Degenerate::BogdanovTakens);
    near(found[0].1[1], 0.0, 1e-8);
}

/// Whatever the ranges, and so the steps: near the point round-off splits the double eigenvalue 0 into two real ones or a pair.
#[test]
fn a_fold_curve_passes_the_bogdanov_takens_point_in_any_range() {
    let family = |[p, q]: [f64; 2]| -> Body { Ok(Box::new(Bogdanov(p, q))) };
    let along = |p: f64| family([p, -0.5]);
    for (first, second) in
        [(0.3, 0.8), (0.3, 1.0), (0.4, 0.7), (0.5, 0.9), (0.7, 0.6), (0.9, 1.3), (1.0, 0.8), (2.0, 3.0)]
    {
        let settings = Settings::over(-first, first);
        let point = special(&along, 0.03, &[0.07, 0.0], &settings, "fold");
        let (points, _) = follow(&family, &point, -0.5, &settings, (-second, second));
        let found = degenerate(&points);
        assert_eq!(found.len(), 1, "{first}, {second}: {found:?}");
        assert_eq!(found[0].0, Degenerate::BogdanovTakens, "{first}, {second}");
        near(found[0].1[1], 0.0, 1e-7);
    }
}

/// `z' = (1 + 2i - |z|^2) z` and `w' = (p + q i + |z|^2 - 1) w - |w|^2 w`: over the period pi the multipliers of the circle `|z| = 1` are
/// `exp((p +- q i) pi)`.
struct Ring(f64, f64);
motiform_models::plain!(Ring, 4);
impl<T: Scalar> VectorField<T> for Ring {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let [x, y, a, b] = [u[0], u[1], u[2], u[3]];
        let one = x.constant(1.0);
        let square = x * x + y * y;
        let (inner, outer) = (one - square, x.constant(self.0) + square - one - a * a - b * b);
        du[0] = inner * x - y * 2.0;
        du[1] = inner * y + x * 2.0;
        du[2] = outer * a - b * self.1;
        du[3] = outer * b + a * self.1;
    }
}

#[test]
fn a_curve_of_tori_meets_its_strong_resonances() {
    let family = |[p, q]: [f64; 2]| -> Body { Ok(Box::new(Ring(p, q))) };
    let along = |p: f64| family([p, 2.4]);
    let settings = Settings::over(-0.3, 0.3);
    let guess = PeriodicGuess { shape: &[1.0, 0.0, 0.0, 0.0], time: 3.1, angle: 0.0, mirrored: false };
    let start = PeriodicOrbit::find(&Ring(-0.3, 2.4), &guess, &settings.flow, &()).unwrap();
    let torus =
        Branch::of_orbits(&along, -0.3, &start, &settings, &()).unwrap().find(|p| p.special.is_some());
    let (points, end) = follow(&family, &torus.unwrap(), 2.4, &settings, (2.1, 2.9));
    assert_eq!(end, End::RangeLeft);
    points.iter().for_each(|point| near(point.parameters[0], 0.0, 1e-9));
    let found = degenerate(&points);
    let orders: Vec<Degenerate> = found.iter().map(|found| found.0).collect();
    assert_eq!(orders, [Degenerate::Resonance { order: 4 }, Degenerate::Resonance { order: 3 }]);
    near(found[0].1[1], 2.5, 1e-8);
    near(found[1].1[1], 2.0 + 2.0 / 3.0, 1e-8);
}

/// The full model.
fn whole([kappa2, kappa3]: [f64; 2]) -> Body {
    Ok(Box::new(full(kappa2, kappa3)))
}

#[test]
fn the_hopf_curve_of_circular_motion_has_one_bautin_point_just_right_of_the_window() {
    let along = |kappa2: f64| whole([kappa2, 0.1]);
    let settings = Settings::over(0.3, 2.0);
    let guess = RelativeEquilibrium::find(&full(3.0, 0.1), &[1.0, 0.0, -0.04, 0.0, 0.0, 0.0]).unwrap();
    let wide = Settings::over(0.3, 3.0).reversed();
    let mut straight = Branch::of_equilibria(&along, 3.0, &guess, &wide, &()).unwrap();
    let bend = straight.find(|point| point.special.is_some()).unwrap();
    let circular = switch(&along, &bend, &wide, &()).unwrap().pop().unwrap().pop().unwrap();
    let hopf = circular.into_iter().find(|point| point.special.is_some()).unwrap();
    near(hopf.parameter, 1.121_937_264, 1e-8);
    let mut all = Vec::new();
    for settings in [settings, settings.reversed()] {
        let (points, end) = follow(&whole, &hopf, 0.1, &settings, (0.005, 1.0));
        assert_eq!(end, End::RangeLeft);
        all.extend(degenerate(&points));
    }
    let bautin: Vec<_> = all.iter().filter(|found| found.0 == Degenerate::Bautin).collect();
    assert_eq!(bautin.len(), 1);
    assert!(bautin[0].1[0] > 1.6 && bautin[0].1[0] < 1.7, "{bautin:?}");
}

/// The zigzag at kappa2 = 0.9, from a simulation.
fn zigzag() -> PeriodicOrbit {
    let body = full(0.9, 0.1);
    let flow = Settings::over(0.0, 1.0).flow;
    let after = |start: &[f64], time: f64| {
        let mut orbit = flow.method.shape_orbit(&body, flow.control, 0.0, start).unwrap();
        drive(orbit.as_mut(), &Request::until(time, 6), &mut ()).unwrap();
        orbit.state().to_vec()
    };
    let start = after(&[-0.5, 0.001, 0.0, 0.0, 0.0, 0.0], 1400.0);
    let time = 0.5 * 45.3;
    let angle = align(&body, &after(&start, time), &start, true).angle;
    let guess = PeriodicGuess { shape: &start, time, angle, mirrored: true };
    PeriodicOrbit::find(&body, &guess, &flow, &()).unwrap()
}

/// From the lower symmetry breaking at kappa3 = 0.1 over the arch to the upper one.
#[test]
fn the_symmetry_breakings_of_zigzags_lie_on_one_arch() {
    let along = |kappa2: f64| whole([kappa2, 0.1]);
    let settings = Settings::over(0.7, 1.6);
    let mut branch = Branch::of_orbits(&along, 0.9, &zigzag(), &settings.reversed(), &()).unwrap();
    let lower = branch.find(|point| point.special.is_some()).unwrap();
    near(lower.parameter, 0.783_547_485, 1e-8);
    let (points, end) = follow(&whole, &lower, 0.1, &Settings { largest_step: 0.05, ..settings }, (0.1, 0.2));
    let last = points.last().unwrap();
    assert_eq!(end, End::RangeLeft);
    near(last.parameters[1], 0.1, 1e-9);
    near(last.parameters[0], 1.148_047_264, 1e-8);
    let top = points.iter().map(|point| point.parameters[1]).fold(0.0, f64::max);
    assert!(top > 0.1 && top < 0.15, "{top}");
}

/// The first period doublings of the rotating zigzags lie on another arch, outside the one of the symmetry breakings.
#[test]
fn the_period_doublings_of_rotating_zigzags_lie_on_an_arch_outside() {
    let along = |kappa2: f64| whole([kappa2, 0.1]);
    let settings = Settings::over(0.7, 1.6);
    let mut branch = Branch::of_orbits(&along, 0.9, &zigzag(), &settings.reversed(), &()).unwrap();
    let lower = branch.find(|point| point.special.is_some()).unwrap();
    let rotating = switch(&along, &lower, &settings, &()).unwrap().pop().unwrap().pop().unwrap();
    let doubling = rotating.into_iter().find(|point| point.special.is_some()).unwrap();
    let settings = Settings { largest_step: 0.05, ..settings };
    let (points, end) = follow(&whole, &doubling, 0.1, &settings, (0.1, 0.2));
    let last = points.last().unwrap();
    assert_eq!(end, End::RangeLeft);
    near(last.parameters[1], 0.1, 1e-9);
    near(last.parameters[0], 1.1621, 1e-4);
}

#[test]
fn what_is_no_special_point_of_the_family_is_refused() {
    let family = |[p, q]: [f64; 2]| -> Body { Ok(Box::new(Cusp(p, q))) };
    let along = |p: f64| family([p, 0.8]);
    let settings = Settings::over(-1.0, 1.0);
    let fold = special(&along, -1.0, &[-1.2], &settings, "fold");
    let refused = |point: &Point, second: f64, settings: &Settings, range: (f64, f64)| {
        Curve::of(&family, point, second, settings, range, &()).err().unwrap()
    };
    let ordinary = Point { special: None, ..fold.clone() };
    assert!(matches!(refused(&ordinary, 0.8, &settings, (0.0, 1.0)), Error::NotOnABranch { .. }));
    assert!(matches!(refused(&fold, 2.0, &settings, (0.0, 1.0)), Error::OutsideRange { .. }));
    assert!(matches!(refused(&fold, 0.8, &settings, (1.0, 0.0)), Error::OutOfRange { .. }));
    assert!(matches!(refused(&fold, 0.3, &settings, (0.0, 1.0)), Error::NotOnABranch { .. }));
    let other = |[p, q]: [f64; 2]| -> Body { Ok(Box::new(Bogdanov(p, q))) };
    assert!(matches!(
        Curve::of(&other, &fold, 0.8, &settings, (0.0, 1.0), &()),
        Err(Error::Shape { expected: 2, got: 1, .. })
    ));
}

#[test]
fn a_curve_has_the_same_bits_every_time() {
    let family = |[p, q]: [f64; 2]| -> Body { Ok(Box::new(Cusp(p, q))) };
    let along = |p: f64| family([p, 0.8]);
    let settings = Settings::over(-1.0, 1.0);
    let fold = special(&along, -1.0, &[-1.2], &settings, "fold");
    let run = || follow(&family, &fold, 0.8, &settings.reversed(), (-0.5, 1.0));
    assert_eq!(run(), run());
}
