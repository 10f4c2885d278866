//! Ends of branches, special points between two of their points, and the beginnings of zigzags and tori.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::near;
use motiform_analysis::periodic::PeriodicGuess;
use motiform_analysis::{Error, PeriodicOrbit, RelativeEquilibrium, Result};
use motiform_continuation::{Branch, Broken, End, Family, Point, Settings, Special, switch};
use motiform_dynamics::{Equivariant, Scalar, Semilinear, Shape, Symmetry, System, VectorField};
use motiform_models::tensor::{Tensor, TensorParameters};
use motiform_models::zoo;

type Body = Result<Box<dyn Equivariant>>;

fn branch(family: &dyn Family, p: f64, guess: &[f64], settings: &Settings) -> (Vec<Point>, End) {
    let start = RelativeEquilibrium::find(family.at(p).unwrap().as_ref(), guess).unwrap();
    let mut branch = Branch::of_equilibria(family, p, &start, settings, &()).unwrap();
    let points: Vec<Point> = branch.by_ref().collect();
    let end = branch.end().unwrap().clone();
    (points, end)
}

fn specials(points: &[Point]) -> Vec<(f64, Special)> {
    points.iter().filter_map(|point| Some((point.parameter, point.special?))).collect()
}

/// `x' = 1 - x^2 - p^2`: a circle of equilibria.
struct Isola(f64);
motiform_models::plain!(Isola, 1);
impl<T: Scalar> VectorField<T> for Isola {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        du[0] = u[0].constant(1.0 - self.0 * self.0) - u[0] * u[0];
    }
}

#[test]
fn a_closed_branch_ends_at_its_start() {
    let family = |p: f64| -> Body { Ok(Box::new(Isola(p))) };
    for settings in [Settings::over(-2.0, 2.0), Settings::over(2.0, -2.0)] {
        let (points, end) = branch(&family, 0.3, &[1.0], &settings);
        assert_eq!(end, End::Closed);
        let last = points.last().unwrap();
        assert_eq!(last.parameter, 0.3);
        near(last.motion.shape()[0], points[0].motion.shape()[0], 1e-9);
        let folds: Vec<f64> = specials(&points).iter().map(|s| s.0.abs()).collect();
        assert_eq!(folds.len(), 2);
        folds.iter().for_each(|p| near(*p, 1.0, 1e-10));
        assert!(points.iter().any(|p| p.parameter.abs() < 0.1 && p.motion.shape()[0] < -0.9));
    }
}

/// `x' = p x - 1`: `x = 1/p`.
struct Pole(f64);
motiform_models::plain!(Pole, 1);
impl<T: Scalar> VectorField<T> for Pole {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        du[0] = u[0] * self.0 - u[0].constant(1.0);
    }
}

#[test]
fn a_shape_that_grows_without_bound_ends_its_branch() {
    let family = |p: f64| -> Body { Ok(Box::new(Pole(p))) };
    let settings = Settings { largest_size: 20.0, largest_step: 0.1, ..Settings::over(1.0, -1.0) };
    let (points, end) = branch(&family, 1.0, &[1.0], &settings);
    let End::BlowUp { size } = end else { unreachable!("{end:?}") };
    assert!(size > 20.0 && size < 25.0);
    let last = points.last().unwrap();
    near(last.parameter * last.motion.shape()[0], 1.0, 1e-9);
}

/// `x' = ((p - p0)^2 - e^2) x - x^2`: the rest changes its stability twice, at `p0 - e` and `p0 + e`.
struct Twice {
    p: f64,
    centre: f64,
    half: f64,
}
motiform_models::plain!(Twice, 1);
impl<T: Scalar> VectorField<T> for Twice {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let off = self.p - self.centre;
        du[0] = u[0] * (off * off - self.half * self.half) - u[0] * u[0];
    }
}

/// Wherever the two changes lie within one step (of 0.02), both are found.
#[test]
fn two_opposite_changes_within_one_step_do_not_cancel() {
    for half in [0.009, 0.004, 0.001, 0.0002] {
        for i in 0..20 {
            let centre = 0.503 + 0.001 * f64::from(i);
            let family = move |p: f64| -> Body { Ok(Box::new(Twice { p, centre, half })) };
            let (points, _) = branch(&family, 0.0, &[0.0], &Settings::over(0.0, 1.0));
            let found = specials(&points);
            assert_eq!(found.len(), 2, "{half} {centre} {found:?}");
            near(found[0].0, centre - half, 1e-9);
            near(found[1].0, centre + half, 1e-9);
        }
    }
}

#[test]
fn a_change_that_cannot_be_located_is_told() {
    let family = |mu: f64| -> Body {
        if mu.abs() < 1e-3 {
            Err(Error::NoBody { value: mu, why: "a hole".to_owned() })
        } else {
            Ok(Box::new(zoo::Hopf { mu, omega: 2.0 }))
        }
    };
    let (points, end) = branch(&family, -0.49, &[0.0, 0.0], &Settings::over(-0.5, 0.5));
    assert_eq!(end, End::RangeLeft);
    let found = specials(&points);
    let [(_, Special::Unresolved { seen, from, to })] = found[..] else { unreachable!("{found:?}") };
    assert!(seen == "hopf" && from < 0.0 && to > 0.0 && to - from < 0.05, "{from} {to}");
    let point = points.iter().find(|point| point.special.is_some()).unwrap();
    assert!(switch(&family, point, &Settings::over(-0.5, 0.5), &()).unwrap().is_empty());
}

/// `z' = (1 + 2i - |z|^2) z` and `w' = (p + 3.2 i + |z|^2 - 1) w - |w|^2 w`: over the period pi the multipliers of the circle `|z| = 1` are
/// `exp((p +- 3.2 i) pi)`.
struct Ring(f64);
motiform_models::plain!(Ring, 4);
impl<T: Scalar> VectorField<T> for Ring {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let [x, y, a, b] = [u[0], u[1], u[2], u[3]];
        let one = x.constant(1.0);
        let square = x * x + y * y;
        let (inner, outer) = (one - square, x.constant(self.0) + square - one - a * a - b * b);
        du[0] = inner * x - y * 2.0;
        du[1] = inner * y + x * 2.0;
        du[2] = outer * a - b * 3.2;
        du[3] = outer * b + a * 3.2;
    }
}

#[test]
fn a_torus_begins_where_a_pair_of_multipliers_leaves_the_unit_circle() {
    let family = |p: f64| -> Body { Ok(Box::new(Ring(p))) };
    let settings = Settings::over(-0.3, 0.3);
    let guess = PeriodicGuess { shape: &[1.0, 0.0, 0.0, 0.0], time: 3.1, angle: 0.0, mirrored: false };
    let start = PeriodicOrbit::find(&Ring(-0.3), &guess, &settings.flow, &()).unwrap();
    let points: Vec<Point> = Branch::of_orbits(&family, -0.3, &start, &settings, &()).unwrap().collect();
    let found = specials(&points);
    let [(parameter, Special::Torus { angle })] = found[..] else { unreachable!("{found:?}") };
    near(parameter, 0.0, 1e-9);
    near(angle, std::f64::consts::TAU - 3.2 * std::f64::consts::PI + std::f64::consts::TAU, 1e-8);
    assert!(
        points
            .iter()
            .filter(|p| p.special.is_none())
            .all(|p| p.unstable == 2 * usize::from(p.parameter > 0.0))
    );
}

/// A straight motion, `z' = (1 - |z|^2 + i a) z`, that an odd oscillation `(a + ib)' = (p + 2i - |a + ib|^2)(a + ib)` swings from side to
/// side.
struct Swing(f64);
impl System for Swing {
    fn dim(&self) -> usize {
        4
    }
}
impl<T: Scalar> VectorField<T> for Swing {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let [x, y, a, b] = [u[0], u[1], u[2], u[3]];
        let speed = x.constant(1.0) - x * x - y * y;
        let growth = x.constant(self.0) - a * a - b * b;
        du[0] = speed * x - a * y;
        du[1] = speed * y + a * x;
        du[2] = growth * a - b * 2.0;
        du[3] = growth * b + a * 2.0;
    }
}
impl<T: Scalar> Semilinear<T> for Swing {
    fn linear(&self, lambda: &mut [T::Real]) {
        lambda.iter_mut().for_each(|rate| *rate = Scalar::zero(*rate));
    }
    fn nonlinear(&self, t: T::Real, u: &[T], du: &mut [T]) {
        VectorField::<T>::eval(self, t, u, du);
    }
}
impl<T: Scalar> Shape<T> for Swing {
    fn velocity(&self, shape: &[T]) -> [T; 2] {
        [shape[0], shape[1]]
    }
}
impl Equivariant for Swing {
    fn symmetry(&self) -> Symmetry {
        Symmetry::FULL
    }
    fn rotate(&self, angle: f64, u: &mut [f64]) {
        let (sin, cos) = (angle.sin(), angle.cos());
        (u[0], u[1]) = (cos * u[0] - sin * u[1], sin * u[0] + cos * u[1]);
    }
    fn spin(&self, u: &[f64], out: &mut [f64]) {
        out.copy_from_slice(&[-u[1], u[0], 0.0, 0.0]);
    }
    fn mirror(&self, u: &mut [f64]) {
        for i in 1..4 {
            u[i] = -u[i];
        }
    }
}

/// The zigzags that begin have `|a + ib|^2 = p`, period pi, and multiplier `exp(-2 p pi/2)` over half of it.
#[test]
fn zigzags_begin_at_an_odd_oscillation_of_straight_motion() {
    let family = |p: f64| -> Body { Ok(Box::new(Swing(p))) };
    let settings = Settings::over(-0.2, 0.2);
    let (points, _) = branch(&family, -0.2, &[0.6, 0.8, 0.0, 0.0], &settings);
    let hopf = points.iter().find(|point| point.special.is_some()).unwrap();
    near(hopf.parameter, 0.0, 1e-9);
    let Some(Special::Hopf(kind)) = hopf.special else { unreachable!() };
    near(kind.frequency, 2.0, 1e-9);
    let mut zigzags = switch(&family, hopf, &settings, &()).unwrap();
    assert_eq!(zigzags.len(), 1);
    let mut branch = zigzags.pop().unwrap().pop().unwrap();
    let points: Vec<Point> = branch.by_ref().collect();
    assert_eq!((branch.end(), points.last().unwrap().parameter), (Some(&End::RangeLeft), 0.2));
    for point in &points {
        let orbit = point.motion.orbit().unwrap();
        assert!(orbit.mirrored && point.is_stable());
        near(orbit.period(), std::f64::consts::PI, 1e-9);
        near(orbit.shape[2].powi(2) + orbit.shape[3].powi(2), point.parameter, 1e-9);
        near(orbit.multipliers[0].0, (-std::f64::consts::PI * point.parameter).exp(), 1e-8);
    }
}

/// With gamma = kappa2 four eigenvalues of a pure third mode vanish at once, at kappa3 = -18/35. The branch of straight motion passes this
/// shape; a growth rate passes 0 there. A pair of eigenvalues has a frequency of 1e-5, which is rounding: there is no Hopf bifurcation.
#[test]
fn where_a_branch_passes_a_shape_of_more_symmetry_there_is_no_hopf_bifurcation() {
    let family = |kappa3: f64| -> Body {
        Ok(Box::new(Tensor::new(&TensorParameters {
            gamma: 0.3,
            kappa2: 0.3,
            kappa3,
            a1: 0.8,
            a3: 0.5,
            b1: 0.6,
            b2: 0.7,
            b3: 1.0,
            d1: 0.3,
            d2: 0.9,
            d3: 1.0,
            d6: 0.4,
            ..TensorParameters::default()
        })))
    };
    for largest_step in [0.005, 0.02, 0.06] {
        let settings = Settings { largest_step, ..Settings::over(-0.8, 0.5) }.reversed();
        let (points, end) = branch(&family, -0.34, &[0.1, 0.0, 0.05, 0.0, 0.15, 0.0], &settings);
        assert!(points[0].motion.equilibrium().unwrap().speed() > 0.05, "it is straight motion");
        let found = specials(&points);
        let [(at, Special::Pitchfork { breaks: Broken::Rotations })] = found[..] else { panic!("{found:?}") };
        near(at, -18.0 / 35.0, 1e-8);
        assert!(matches!(end, End::Meets { gains: Broken::Rotations, .. }), "{end:?}");
    }
}
