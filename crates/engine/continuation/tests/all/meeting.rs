//! Points where several directions are critical, or terms of higher order decide: all branches that meet there.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use motiform_analysis::{RelativeEquilibrium, Result};
use motiform_continuation::{Branch, Family, NormalForm, Point, Settings, Special, Undetermined, switch};
use motiform_dynamics::{Equivariant, Scalar, VectorField};

type Body = Result<Box<dyn Equivariant>>;

/// The special points of the branch from the equilibrium at 0.
fn special(family: &dyn Family, p: f64, settings: &Settings) -> Vec<Point> {
    let dim = family.at(p).unwrap().dim();
    let start = RelativeEquilibrium::find(family.at(p).unwrap().as_ref(), &vec![0.0; dim]).unwrap();
    let all = Branch::of_equilibria(family, p, &start, settings, &()).unwrap();
    all.filter(|point| point.special.is_some()).collect()
}

/// The last points of all legs that begin at a point, as states at the ends of the range, with the numbers of directions that grow.
fn ends(family: &dyn Family, point: &Point, settings: &Settings) -> Vec<(f64, Vec<f64>, usize)> {
    let legs = switch(family, point, settings, &()).unwrap().into_iter().flatten();
    legs.map(|leg| {
        let last = leg.last().unwrap();
        (last.parameter, last.motion.shape().to_vec(), last.unstable)
    })
    .collect()
}

/// Ranges and steps that cannot matter.
fn settings() -> impl Iterator<Item = Settings> {
    [(-1.0, 1.0, 1.0), (-0.7, 1.3, 1.0), (-2.0, 0.5, 1.0), (-1.0, 1.0, 0.31)].into_iter().map(
        |(low, high, step)| {
            let settings = Settings::over(low, high);
            Settings { largest_step: step * settings.largest_step, ..settings }
        },
    )
}

/// Prey that grows to `k` and its predator (Rosenzweig and MacArthur 1963), in a time that leaves no denominator.
struct Grazed {
    k: f64,
    d: f64,
}
motiform_models::plain!(Grazed, 2);
impl<T: Scalar> VectorField<T> for Grazed {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let one = u[0].constant(1.0);
        let sated = u[0] + one;
        du[0] = u[0] * sated * (one - u[0] * (1.0 / self.k)) - u[0] * u[1];
        du[1] = u[0] * u[1] - u[1] * sated * self.d;
    }
}

/// The branch of both crosses that of the prey alone, `(k, 0)`, at `k = d/(1 - d)`: the other branch is that one, whatever the size of the
/// shapes from which the first one was followed.
#[test]
fn a_branch_from_large_shapes_does_not_cross_itself_at_a_small_one() {
    for (d, k) in [0.15, 0.2, 0.26, 0.3].into_iter().flat_map(|d| [0.5, 1.0, 3.0].map(|k| (d, k))) {
        let family = move |k: f64| -> Body { Ok(Box::new(Grazed { k, d })) };
        let (settings, prey) = (Settings::over(0.1, 4.0), d / (1.0 - d));
        let both = [prey, (1.0 + prey) * (1.0 - prey / k)];
        let start = RelativeEquilibrium::find(family(k).unwrap().as_ref(), &both).unwrap();
        let mut points = Branch::of_equilibria(&family, k, &start, &settings, &()).unwrap();
        let down = Settings { first_step: -settings.first_step, ..settings };
        let mut back = Branch::of_equilibria(&family, k, &start, &down, &()).unwrap();
        let crossing = points.by_ref().chain(back.by_ref()).find(|p| p.special == Some(Special::BranchPoint));
        let crossing = crossing.unwrap_or_else(|| panic!("{d} {k}"));
        assert!((crossing.parameter - prey).abs() < 1e-9, "{d} {k}: {}", crossing.parameter);
        let legs: Vec<Branch<'_>> =
            switch(&family, &crossing, &settings, &()).unwrap().into_iter().flatten().collect();
        assert_eq!(legs.len(), 2);
        for point in legs.into_iter().flatten() {
            let shape = point.motion.shape();
            assert!((shape[0] - point.parameter).abs() < 1e-9 && shape[1].abs() < 1e-9, "{d} {k}: {shape:?}");
        }
    }
}

/// `x_i' = scale (p x_i - x_i^3)`, as many as `count`, and `y' = -y`.
struct Forks {
    p: f64,
    count: usize,
    scale: f64,
}
motiform_models::plain!(Forks, 4);
impl<T: Scalar> VectorField<T> for Forks {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        for (i, (du, u)) in du.iter_mut().zip(u).enumerate() {
            let fork = *u * self.p - *u * *u * *u;
            *du = if i < self.count { fork * self.scale } else { -*u };
        }
    }
}

#[test]
fn all_branches_of_pitchforks_at_one_point_are_found() {
    for (count, scale) in [(2, 1.0), (2, 0.01), (2, 30.0), (3, 1.0)] {
        let family = move |p: f64| -> Body { Ok(Box::new(Forks { p, count, scale })) };
        for settings in settings().take(if count == 2 { 4 } else { 1 }) {
            let case = format!("{count} x{scale} {:?} {}", settings.range, settings.largest_step);
            let found = special(&family, -0.5, &settings);
            let [only] = &found[..] else { panic!("{case} {found:?}") };
            assert!(only.parameter.abs() < 1e-10 && only.critical == count, "{case} {only:?}");
            let form = only.certificate.unwrap().normal_form;
            assert_eq!(form, Some(NormalForm::Undetermined(Undetermined::Directions)), "{case}");
            let ends = ends(&family, only, &settings);
            let root = settings.range.1.sqrt();
            let mut seen = std::collections::BTreeSet::new();
            for (p, state, unstable) in &ends {
                assert_eq!(*p, settings.range.1, "{case} {state:?}");
                let signs: Vec<i32> = state.iter().map(|x| (x / root).round() as i32).collect();
                assert!(
                    state.iter().zip(&signs).all(|(x, s)| (x - f64::from(*s) * root).abs() < 1e-6),
                    "{case}"
                );
                assert_eq!(*unstable, signs[..count].iter().filter(|s| **s == 0).count(), "{case} {state:?}");
                seen.insert(signs);
            }
            assert_eq!(
                (seen.len(), ends.len()),
                (3_usize.pow(count as u32) - 1, 3_usize.pow(count as u32) - 1),
                "{case}"
            );
        }
    }
}

/// `x' = x f(x, p)`, `y' = -y`, with `f = p^3 - x^2`, or `x^2 - p^2`.
struct High {
    p: f64,
    cusp: bool,
}
motiform_models::plain!(High, 2);
impl<T: Scalar> VectorField<T> for High {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, p) = (u[0], u[0].constant(self.p));
        du[0] = x * if self.cusp { p * p * p - x * x } else { x * x - p * p };
        du[1] = -u[1];
    }
}

#[test]
fn branches_that_terms_of_higher_order_decide_are_found() {
    for settings in settings() {
        let (low, high) = settings.range;
        for (cusp, expected) in [
            (true, vec![(high, high.powf(1.5)), (high, -high.powf(1.5))]),
            (false, vec![(high, high), (high, -high), (low, low), (low, -low)]),
        ] {
            let family = move |p: f64| -> Body { Ok(Box::new(High { p, cusp })) };
            let found = special(&family, -0.5, &settings);
            let case = format!("{cusp} {:?} {}", settings.range, settings.largest_step);
            let [only] = &found[..] else { panic!("{case} {found:?}") };
            assert!(only.parameter.abs() < 1e-3, "{case} {only:?}");
            let ends = ends(&family, only, &settings);
            assert_eq!(ends.len(), expected.len(), "{case} {ends:?}");
            for (p, x) in expected {
                let is = |end: &&(f64, Vec<f64>, usize)| end.0 == p && (end.1[0] - x).abs() < 1e-6;
                assert_eq!(ends.iter().filter(is).count(), 1, "{case} {p} {x} {ends:?}");
            }
        }
    }
}

/// `z' = p z - |z|^2 z + .3 conj(z)^3`, whose symmetry under quarter turns is not stated: branches along the axes, and between them.
struct Square(f64);
motiform_models::plain!(Square, 2);
impl<T: Scalar> VectorField<T> for Square {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, y) = (u[0], u[1]);
        let rate = x.constant(self.0) - x * x - y * y;
        du[0] = rate * x + (x * x * x - x * y * y * 3.0) * 0.3;
        du[1] = rate * y - (x * x * y * 3.0 - y * y * y) * 0.3;
    }
}

#[test]
fn branches_of_both_kinds_of_a_square_are_found() {
    let family = |p: f64| -> Body { Ok(Box::new(Square(p))) };
    for settings in settings() {
        let found = special(&family, -0.5, &settings);
        let [only] = &found[..] else { panic!("{found:?}") };
        assert_eq!((only.special, only.critical), (Some(Special::BranchPoint), 2));
        let ends = ends(&family, only, &settings);
        let p = settings.range.1;
        for k in 0..8 {
            let (sin, cos) = libm::sincos(f64::from(k) * std::f64::consts::FRAC_PI_4);
            let size = (p / if k % 2 == 0 { 0.7 } else { 1.3 }).sqrt();
            let is = |end: &&(f64, Vec<f64>, usize)| {
                (end.1[0] - size * cos).hypot(end.1[1] - size * sin) < 1e-6
                    && end.2 == usize::from(k % 2 == 1)
            };
            assert_eq!(ends.iter().filter(is).count(), 1, "{k} {ends:?}");
        }
        assert_eq!(ends.len(), 8);
    }
}

/// `x' = p x - x^3`, `y' = (p - apart) y - y^3` close to each other: each branch begins at its own point.
#[test]
fn branches_of_pitchforks_close_to_each_other_begin_at_their_own() {
    struct Two(f64, f64);
    motiform_models::plain!(Two, 2);
    impl<T: Scalar> VectorField<T> for Two {
        fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
            du[0] = u[0] * self.0 - u[0] * u[0] * u[0];
            du[1] = u[1] * (self.0 - self.1) - u[1] * u[1] * u[1];
        }
    }
    for apart in [1e-5, 1e-6, 1e-7, 1e-8] {
        let family = move |p: f64| -> Body { Ok(Box::new(Two(p, apart))) };
        let settings = Settings::over(-1.0, 1.0);
        let found = special(&family, -0.5, &settings);
        assert_eq!(found.len(), 2, "{apart}");
        for (place, point) in found.iter().enumerate() {
            for leg in switch(&family, point, &settings, &()).unwrap().into_iter().flatten() {
                let points: Vec<Point> = leg.collect();
                let last = points.last().unwrap();
                let [along, across] = [last.motion.shape()[place], last.motion.shape()[1 - place]];
                assert!(
                    (along.abs() - 1.0).abs() < 1e-4 && across.abs() < 1e-6,
                    "{apart} {place} {along} {across}"
                );
                let all: Vec<f64> =
                    points.iter().filter(|p| p.special.is_some()).map(|p| p.parameter).collect();
                // on the first branch the other direction passes 0 at p = apart, on the second it grows from the beginning
                if place == 0 {
                    assert!(matches!(all[..], [p] if (p - apart).abs() < 1e-10), "{apart} {all:?}");
                } else {
                    assert!(all.is_empty() && points.iter().all(|p| p.unstable == 1), "{apart} {all:?}");
                }
            }
        }
    }
}

/// `z' = (p^power + i) z - |z|^2 z`, `w' = (p + turns i) w - |w|^2 w`; without `turns` `w' = -w`.
struct Oscillations {
    p: f64,
    power: i32,
    turns: f64,
}
motiform_models::plain!(Oscillations, 4);
impl<T: Scalar> VectorField<T> for Oscillations {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let second = if self.turns == 0.0 { -1.0 } else { self.p };
        for (place, growth, turns) in [(0, self.p.powi(self.power), 1.0), (2, second, self.turns)] {
            let (x, y) = (u[place], u[place + 1]);
            let rate = x.constant(growth) - x * x - y * y;
            du[place] = rate * x - y * turns;
            du[place + 1] = rate * y + x * turns;
        }
    }
}

/// The oscillation of one pair has the size of the root of its growth, and the other pair grows on it as at rest.
#[test]
fn each_pair_that_is_critical_at_one_point_has_its_oscillation() {
    let family = |p: f64| -> Body { Ok(Box::new(Oscillations { p, power: 1, turns: 1.7 })) };
    for settings in settings().take(2) {
        let found = special(&family, -0.5, &settings);
        assert_eq!(found.len(), 2, "{found:?}");
        for (place, frequency) in [(0, 1.0), (2, 1.7)] {
            let is = |point: &&Point| matches!(point.special, Some(Special::Hopf(hopf)) if (hopf.frequency - frequency).abs() < 1e-8);
            let point = found.iter().find(is).unwrap();
            assert!(point.parameter.abs() < 1e-10 && point.critical == 2, "{point:?}");
            let Some(Special::Hopf(hopf)) = point.special else { unreachable!() };
            assert_eq!(hopf.is_supercritical(), None);
            let mut legs = switch(&family, point, &settings, &()).unwrap().into_iter().flatten().flatten();
            assert!(legs.all(|point| point.special.is_none() && point.neutral == 0 && point.unstable == 2));
            let ends = ends(&family, point, &settings);
            let [(p, state, unstable)] = &ends[..] else { panic!("{ends:?}") };
            let size = state[place].hypot(state[place + 1]);
            assert!(*p == settings.range.1 && (size - p.sqrt()).abs() < 1e-6 && *unstable == 2, "{ends:?}");
        }
    }
}

#[test]
fn an_oscillation_that_begins_at_high_order_is_found() {
    let family = |p: f64| -> Body { Ok(Box::new(Oscillations { p, power: 3, turns: 0.0 })) };
    for settings in settings().take(1) {
        let found = special(&family, -0.5, &settings);
        let [only] = &found[..] else { panic!("{found:?}") };
        let ends = ends(&family, only, &settings);
        let [(p, state, unstable)] = &ends[..] else { panic!("{ends:?}") };
        let size = state[0].hypot(state[1]);
        assert!(*p == settings.range.1 && (size - p.powf(1.5)).abs() < 1e-6 && *unstable == 0, "{ends:?}");
    }
}
