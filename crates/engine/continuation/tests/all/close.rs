//! Special points that are close to each other, or come together: each is listed, or it is said that they are not told apart.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use motiform_analysis::{RelativeEquilibrium, Result};
use motiform_continuation::{Branch, Family, Point, Settings, Special};
use motiform_dynamics::{Equivariant, Scalar, VectorField};

type Body = Result<Box<dyn Equivariant>>;

/// All points of the branch from the equilibrium near `guess`.
fn branch(family: &dyn Family, p: f64, guess: &[f64], settings: &Settings) -> Vec<Point> {
    let start = RelativeEquilibrium::find(family.at(p).unwrap().as_ref(), guess).unwrap();
    Branch::of_equilibria(family, p, &start, settings, &()).unwrap().collect()
}

/// Parameters and names of the special points.
fn special(points: &[Point]) -> Vec<(f64, &'static str)> {
    points.iter().filter_map(|point| Some((point.parameter, point.special?.name()))).collect()
}

/// Ranges and steps from -1/2 that cannot matter.
fn settings() -> impl Iterator<Item = Settings> {
    [(-1.0, 1.0, 1.0), (-0.7, 1.3, 1.0), (-2.0, 1.0, 1.0), (-1.0, 1.0, 0.31)].into_iter().map(
        |(low, high, step)| {
            let settings = Settings::over(low, high);
            Settings { largest_step: step * settings.largest_step, ..settings }
        },
    )
}

/// `x' = scale (p x - x^3)`, `y' = scale ((p - apart) y - y^3)`.
struct TwoForks {
    p: f64,
    apart: f64,
    scale: f64,
}
motiform_models::plain!(TwoForks, 2);
impl<T: Scalar> VectorField<T> for TwoForks {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        du[0] = (u[0] * self.p - u[0] * u[0] * u[0]) * self.scale;
        du[1] = (u[1] * (self.p - self.apart) - u[1] * u[1] * u[1]) * self.scale;
    }
}

#[test]
fn crossings_close_to_each_other_are_two() {
    for scale in [1.0, 1e-3, 1e3] {
        for apart in [1e-5, 1e-6, 1e-7, 1e-8, 1e-9] {
            let family = move |p: f64| -> Body { Ok(Box::new(TwoForks { p, apart, scale })) };
            for settings in settings() {
                let points = branch(&family, -0.5, &[0.0, 0.0], &settings);
                let case = format!("{apart} x{scale} {:?} {}", settings.range, settings.largest_step);
                let found = special(&points);
                let [first, second] = &found[..] else { panic!("{case}: {found:?}") };
                assert!(first.1 == "branch-point" && second.1 == "branch-point", "{case}: {found:?}");
                assert!(first.0.abs() < 1e-10 && (second.0 - apart).abs() < 1e-10, "{case}: {found:?}");
                let unstable: Vec<usize> = points
                    .iter()
                    .filter(|p| (0.0..apart).contains(&p.parameter))
                    .map(|p| p.unstable)
                    .collect();
                assert!(unstable.contains(&1), "{case}: {unstable:?}");
            }
        }
    }
}

/// `z' = (p + i) z - |z|^2 z`, `w' = (p - apart + 1.7 i) w - |w|^2 w`.
struct TwoHopfs {
    p: f64,
    apart: f64,
}
motiform_models::plain!(TwoHopfs, 4);
impl<T: Scalar> VectorField<T> for TwoHopfs {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        for (place, growth, turns) in [(0, self.p, 1.0), (2, self.p - self.apart, 1.7)] {
            let (x, y) = (u[place], u[place + 1]);
            let rate = x.constant(growth) - x * x - y * y;
            du[place] = rate * x - y * turns;
            du[place + 1] = rate * y + x * turns;
        }
    }
}

#[test]
fn hopf_points_close_to_each_other_are_two() {
    for apart in [1e-5, 1e-6, 1e-7, 1e-9] {
        let family = move |p: f64| -> Body { Ok(Box::new(TwoHopfs { p, apart })) };
        for settings in settings() {
            let points = branch(&family, -0.5, &[0.0; 4], &settings);
            let all: Vec<(f64, f64)> = points
                .iter()
                .filter_map(|point| match point.special? {
                    Special::Hopf(hopf) => Some((point.parameter, hopf.frequency)),
                    _ => None,
                })
                .collect();
            let [first, second] = &all[..] else { panic!("{apart} {all:?}") };
            assert!(first.0.abs() < 1e-10 && (first.1 - 1.0).abs() < 1e-8, "{apart} {all:?}");
            assert!((second.0 - apart).abs() < 1e-10 && (second.1 - 1.7).abs() < 1e-8, "{apart} {all:?}");
        }
    }
}

/// The growth `e^2 - (p - at)^2` of the rest: of an oscillation (`turns` is not 0), or of `x' = (...) x + sign x^3` with `y' = -y`.
struct Window {
    p: f64,
    at: f64,
    half: f64,
    turns: f64,
    cubic: f64,
}
motiform_models::plain!(Window, 2);
impl<T: Scalar> VectorField<T> for Window {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, y) = (u[0], u[1]);
        let off = self.p - self.at;
        let growth = x.constant(self.half * self.half - off * off);
        if self.turns == 0.0 {
            (du[0], du[1]) = (growth * x + x * x * x * self.cubic, -y);
        } else {
            let rate = growth + (x * x + y * y) * self.cubic;
            (du[0], du[1]) = (rate * x - y * self.turns, rate * y + x * self.turns);
        }
    }
}

#[test]
fn a_short_stretch_of_growth_is_seen() {
    for (turns, name) in [(0.0, "branch-point"), (1.0, "hopf")] {
        for half in [1e-3, 1e-4, 3e-5, 1e-5] {
            for at in [0.0, 0.0123, -0.0371, 0.2] {
                let family =
                    move |p: f64| -> Body { Ok(Box::new(Window { p, at, half, turns, cubic: -1.0 })) };
                for settings in settings() {
                    let points = branch(&family, -0.5, &[0.0, 0.0], &settings);
                    let found = special(&points);
                    let case = format!("{name} {half} {at} {:?} {found:?}", settings.range);
                    let [first, second] = &found[..] else { panic!("{case}") };
                    assert!(first.1 == name && second.1 == name, "{case}");
                    assert!(
                        (first.0 + half - at).abs() < 1e-6 && (second.0 - half - at).abs() < 1e-6,
                        "{case}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_growth_that_comes_to_0_and_back_is_told() {
    for (turns, seen) in [(0.0, "branch-point"), (1.0, "hopf")] {
        for (half, cubic) in [(0.0, 1.0), (0.0, -1.0), (1e-7, -1.0)] {
            for at in [0.0, 0.0123, -0.0371, 0.2] {
                let family = move |p: f64| -> Body { Ok(Box::new(Window { p, at, half, turns, cubic })) };
                for settings in settings() {
                    let points = branch(&family, -0.5, &[0.0, 0.0], &settings);
                    let case = format!("{seen} {half} {at} {:?} {}", settings.range, settings.largest_step);
                    let found: Vec<(f64, Special)> =
                        points.iter().filter_map(|point| Some((point.parameter, point.special?))).collect();
                    let [(p, Special::Touch { seen: named, within })] = &found[..] else {
                        panic!("{case}: {found:?}")
                    };
                    assert!(
                        *named == seen && (p - at).abs() <= *within && *within < 1e-4,
                        "{case}: {found:?}"
                    );
                }
            }
        }
    }
}

/// `x' = x ((p - .1)(p - .1 - gap) - x^2)`, `y' = -y`: the branch of `x > 0` ends on the rest at .1, another begins at `.1 + gap`.
struct Gap {
    p: f64,
    gap: f64,
}
motiform_models::plain!(Gap, 2);
impl<T: Scalar> VectorField<T> for Gap {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let square = (self.p - 0.1) * (self.p - 0.1 - self.gap);
        du[0] = u[0] * (u[0].constant(square) - u[0] * u[0]);
        du[1] = -u[1];
    }
}

#[test]
fn a_gap_in_a_branch_is_not_stepped_over() {
    for gap in [1e-2, 3e-3, 1e-3, 3e-4, 1e-4] {
        let family = move |p: f64| -> Body { Ok(Box::new(Gap { p, gap })) };
        for (low, high, step) in [(0.0, 0.3, 1.0), (-0.1, 0.4, 1.0), (0.0, 0.3, 0.4), (-0.5, 0.5, 1.0)] {
            let settings = Settings::over(low, high);
            let settings = Settings { largest_step: step * settings.largest_step, ..settings };
            let root = (0.1 * (0.1 + gap)).sqrt();
            let points = branch(&family, 0.0, &[root, 0.0], &settings);
            let found = special(&points);
            let case = format!("{gap} {low} {high} {step} {found:?}");
            assert!(matches!(found[..], [(p, "branch-point")] if (p - 0.1).abs() < 1e-8), "{case}");
            assert!(points.iter().all(|point| point.parameter < 0.1 + 0.5 * gap), "{case}");
        }
    }
}
