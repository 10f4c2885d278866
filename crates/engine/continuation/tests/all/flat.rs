//! Crossings of higher order, special points close to each other, and loops that are entered where they turn back.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use motiform_analysis::{RelativeEquilibrium, Result};
use motiform_continuation::{Branch, End, Family, Point, Settings, Special, switch};
use motiform_dynamics::{Equivariant, Scalar, VectorField};

type Body = Result<Box<dyn Equivariant>>;

/// All points of the branch from the equilibrium near `guess`.
fn branch(family: &dyn Family, p: f64, guess: &[f64], settings: &Settings) -> Vec<Point> {
    let start = RelativeEquilibrium::find(family.at(p).unwrap().as_ref(), guess).unwrap();
    Branch::of_equilibria(family, p, &start, settings, &()).unwrap().collect()
}

/// Steps that begin towards smaller values of the parameter.
fn down(low: f64, high: f64) -> Settings {
    let settings = Settings::over(low, high);
    Settings { first_step: -settings.first_step.abs(), ..settings }
}

/// `x' = p x - x^n`, `y' = -y` about `x = at`, for odd n: the branch `p = x^(n-1)` crosses that of `x = 0`.
struct Flat {
    p: f64,
    order: i32,
    at: f64,
}
motiform_models::plain!(Flat, 2);
impl<T: Scalar> VectorField<T> for Flat {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let x = u[0] - u[0].constant(self.at);
        du[0] = x * self.p - (1..self.order).fold(x, |power, _| power * x);
        du[1] = -u[1];
    }
}

#[test]
fn pitchforks_of_high_order_are_crossings_from_every_range_and_step() {
    for (order, at) in [(5, 0.0), (7, 0.0), (5, 0.3), (7, 0.3)] {
        let family = move |p: f64| -> Body { Ok(Box::new(Flat { p, order, at })) };
        for (low, high) in [(-1.0, 1.0), (-0.5, 1.0), (-1.0, 2.0), (-2.0, 1.0), (-1.0, 0.9), (-1.0, 1.3)] {
            for (start, step) in [(0.1_f64, 1.0), (0.5, 1.0), (0.5, 0.3), (0.37, 1.0)] {
                let mut settings = down(low, high);
                settings.largest_step *= step;
                let root = start.powf(1.0 / f64::from(order - 1));
                let points = branch(&family, start, &[at + root, 0.0], &settings);
                let all: Vec<&Point> = points.iter().filter(|point| point.special.is_some()).collect();
                let case = format!("order {order} at {at}, {low} to {high}, from {start}, step {step}");
                let [only] = &all[..] else {
                    panic!("{case}: {:?}", all.iter().map(|p| (p.parameter, p.special)).collect::<Vec<_>>())
                };
                assert_eq!(only.special, Some(Special::BranchPoint), "{case} {only:?}");
                assert!(only.parameter.abs() < 1e-9, "{case}: {}", only.parameter);
                assert!(points.iter().all(|p| p.unstable == 0), "{case}");
                let crossing = switch(&family, only, &settings, &()).unwrap();
                let mut ends = Vec::new();
                for leg in crossing.into_iter().flatten() {
                    let last = leg.last().unwrap();
                    assert!((last.motion.shape()[0] - at).abs() < 1e-6, "{case}");
                    ends.push(last.parameter);
                }
                ends.sort_by(f64::total_cmp);
                assert_eq!(ends, [low, high], "{case}");
            }
        }
    }
}

/// `x' = p - x^2`, `y' = 4 (x - d) (3/10 - x) y - y^3`: a fold at 0, pitchforks at d^2 and .09, and between these a loop of `y != 0`.
struct Loop {
    p: f64,
    d: f64,
}
motiform_models::plain!(Loop, 2);
impl<T: Scalar> VectorField<T> for Loop {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, y) = (u[0], u[1]);
        du[0] = x.constant(self.p) - x * x;
        du[1] = (x - x.constant(self.d)) * (x.constant(0.3) - x) * y * 4.0 - y * y * y;
    }
}

#[test]
fn between_neighbouring_special_points_a_point_tells_what_grows() {
    for d in [1e-3, 3e-3, 0.01, 0.03, 0.1] {
        let family = move |p: f64| -> Body { Ok(Box::new(Loop { p, d })) };
        let points = branch(&family, 0.5, &[0.7, 0.0], &down(-0.5, 1.0));
        let between = |point: &&Point| point.special.is_none() && point.motion.shape()[0].abs() < d;
        let stable = points.iter().filter(between).filter(|p| p.motion.shape()[0] > 0.0);
        assert!(stable.clone().count() > 0, "{d}: no point between fold and pitchfork");
        assert!(stable.clone().all(|p| p.unstable == 0), "{d}");
    }
}

#[test]
fn a_loop_that_is_entered_where_it_turns_back_is_passed_once() {
    for d in [3e-3, 0.01, 0.1] {
        let family = move |p: f64| -> Body { Ok(Box::new(Loop { p, d })) };
        let settings = down(-0.5, 1.0);
        let points = branch(&family, 0.5, &[0.7, 0.0], &settings);
        let forks: Vec<&Point> = points.iter().filter(|p| p.special == Some(Special::BranchPoint)).collect();
        assert_eq!(
            forks.len(),
            2,
            "{d}: {:?}",
            points.iter().filter_map(|p| Some((p.parameter, p.special?))).collect::<Vec<_>>()
        );
        for fork in forks {
            for leg in switch(&family, fork, &settings, &()).unwrap().into_iter().flatten() {
                let mut leg = leg;
                let met = leg.by_ref().filter(|point| point.special.is_some()).count();
                assert!(matches!(leg.end(), Some(End::Closed)), "{d}: {:?}", leg.end());
                assert_eq!(met, 2, "{d}: both pitchforks, once each");
            }
        }
    }
}

/// `x' = p x - x^n` for even n: the branch `p = x^(n-1)` crosses that of `x = 0`, and is stable on one side.
#[test]
fn crossings_of_high_order_are_crossings() {
    for order in [2, 4, 6] {
        let family = move |p: f64| -> Body { Ok(Box::new(Flat { p, order, at: 0.0 })) };
        for (low, high) in [(-1.0, 1.0), (-0.5, 1.0), (-1.0, 2.0), (-1.0, 0.9)] {
            for start in [0.1_f64, 0.5, 0.37] {
                let root = start.powf(1.0 / f64::from(order - 1));
                let points = branch(&family, start, &[root, 0.0], &down(low, high));
                let all: Vec<&Point> = points.iter().filter(|point| point.special.is_some()).collect();
                let case = format!("order {order}, {low} to {high}, from {start}");
                let found: Vec<_> =
                    all.iter().map(|p| (p.parameter, p.special, p.motion.shape()[0])).collect();
                assert!(
                    matches!(&all[..], [only] if only.special == Some(Special::BranchPoint)),
                    "{case}: {found:?}"
                );
                assert!(all[0].parameter.abs() < 1e-9, "{case}: {found:?}");
            }
        }
    }
}

/// `x' = x (-(p - 1/10) (p - 1/10 - d) - x^2)`: a loop between two pitchforks of rest, as small as a step.
struct Bubble {
    p: f64,
    d: f64,
}
motiform_models::plain!(Bubble, 2);
impl<T: Scalar> VectorField<T> for Bubble {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        du[0] = u[0] * (-(self.p - 0.1) * (self.p - 0.1 - self.d)) - u[0] * u[0] * u[0];
        du[1] = -u[1];
    }
}

#[test]
fn a_loop_as_small_as_a_step_is_passed_once() {
    for d in [0.003, 0.01, 0.03] {
        for (low, high) in [(-1.0, 1.0), (-0.5, 0.7)] {
            let family = move |p: f64| -> Body { Ok(Box::new(Bubble { p, d })) };
            let points = branch(&family, 0.5, &[0.0, 0.0], &down(low, high));
            let forks: Vec<&Point> = points.iter().filter(|p| p.special.is_some()).collect();
            assert_eq!(forks.len(), 2, "{d} in {low} to {high}");
            for fork in forks {
                for mut leg in switch(&family, fork, &down(low, high), &()).unwrap().into_iter().flatten() {
                    let met = leg.by_ref().filter(|point| point.special.is_some()).count();
                    assert!(
                        matches!(leg.end(), Some(End::Closed)) && met == 2,
                        "{d}: {met}, {:?}",
                        leg.end()
                    );
                }
            }
        }
    }
}

/// `x' = p x + e - x^3`: no pitchfork, a branch that is stable for all p, and another one with a fold at `3 (e/2)^(2/3)`.
struct Imperfect {
    p: f64,
    e: f64,
}
motiform_models::plain!(Imperfect, 2);
impl<T: Scalar> VectorField<T> for Imperfect {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let x = u[0];
        du[0] = x * self.p - x * x * x + x.constant(self.e);
        du[1] = -u[1];
    }
}

#[test]
fn a_pitchfork_that_is_not_quite_one_is_none() {
    for e in [1e-9, 1e-8, 1e-7, 1e-5] {
        for (low, high) in [(-1.0, 1.0), (-2.0, 2.0), (-0.5, 1.0), (-1.0, 0.7)] {
            let family = move |p: f64| -> Body { Ok(Box::new(Imperfect { p, e })) };
            let points = branch(&family, 0.5, &[0.7, 0.0], &down(low, high));
            let found: Vec<_> = points.iter().filter_map(|p| Some((p.parameter, p.special?))).collect();
            assert!(
                found.is_empty() && points.iter().all(|p| p.unstable == 0),
                "{e} in {low} to {high}: {found:?}"
            );
            assert_eq!(points.last().unwrap().parameter, low, "{e} in {low} to {high}");
        }
    }
}
