//! Equations with an offset, or beside a variable that does not act on the others: the answers are those without.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use motiform_analysis::{RelativeEquilibrium, Result};
use motiform_continuation::{Branch, Family, Point, Settings, Special, switch};
use motiform_dynamics::{Equivariant, Scalar, VectorField};

type Body = Result<Box<dyn Equivariant>>;

/// The term that decides: `x' = p x - x^2`, `p x - x^3` or `p - x^2`.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Form {
    Transcritical,
    Pitchfork,
    Fold,
}

/// The form about `x = at`, as a text is read: a sum of powers of x whose terms cancel. `y' = at - y`, and `z' = silent - z`.
#[derive(Clone, Copy, Debug)]
struct Offset {
    p: f64,
    form: Form,
    at: f64,
    silent: f64,
}
motiform_models::plain!(Offset, 3);
impl<T: Scalar> VectorField<T> for Offset {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, a) = (u[0], self.at);
        let number = |value: f64| x.constant(value);
        let linear = x * self.p - number(self.p * a);
        let square = x * x - x * (2.0 * a) + number(a * a);
        let cube = x * x * x - x * x * (3.0 * a) + x * (3.0 * a * a) - number(a * a * a);
        du[0] = match self.form {
            Form::Transcritical => linear - square,
            Form::Pitchfork => linear - cube,
            Form::Fold => number(self.p) - square,
        };
        du[1] = number(a) - u[1];
        du[2] = number(self.silent) - u[2];
    }
}

/// All offsets and silent variables, and the size of the error that round-off of the offset may leave in a location.
const CASES: [(f64, f64); 9] = [
    (0.0, 0.0),
    (10.0, 0.0),
    (100.0, 0.0),
    (300.0, 0.0),
    (1000.0, 0.0),
    (0.0, 1.0),
    (0.0, 300.0),
    (0.0, 1000.0),
    (0.0, 3e4),
];

/// The points of both legs from the equilibrium at this distance from the offset.
fn legs(family: &dyn Family, start: (f64, [f64; 3]), settings: &Settings) -> Vec<Vec<Point>> {
    let (p, guess) = start;
    let start = RelativeEquilibrium::find(family.at(p).unwrap().as_ref(), &guess).unwrap();
    let leg = |settings: &Settings| {
        Branch::of_equilibria(family, p, &start, settings, &()).unwrap().collect::<Vec<Point>>()
    };
    vec![leg(&settings.reversed()), leg(settings)]
}

#[test]
fn crossings_are_found_beside_any_offset_and_silent_variable() {
    for form in [Form::Transcritical, Form::Pitchfork] {
        for (at, silent) in CASES {
            for (low, high, step) in [(-1.0, 1.0, 1.0), (-0.6, 1.7, 1.0), (-1.0, 1.0, 0.25), (-1.0, 1.0, 0.1)]
            {
                let case = format!("{form:?} at {at} beside {silent}, {low} to {high}, step {step}");
                let family = move |p: f64| -> Body { Ok(Box::new(Offset { p, form, at, silent })) };
                let mut settings = Settings::over(low, high);
                settings.largest_step *= step;
                settings.first_step *= step;
                let all = legs(&family, (-0.5, [at + 0.01, at, silent]), &settings);
                let points: Vec<&Point> = all.iter().flatten().collect();
                let special: Vec<&&Point> = points.iter().filter(|p| p.special.is_some()).collect();
                let found: Vec<_> = special.iter().map(|p| (p.parameter, p.special)).collect();
                let [only] = special[..] else { panic!("{case}: {found:?}") };
                assert_eq!(only.special, Some(Special::BranchPoint), "{case}");
                let error = only.certificate.unwrap().error;
                assert!(only.parameter.abs() <= error, "{case}: {} +- {error}", only.parameter);
                let terms = if form == Form::Transcritical { at * at } else { at * at * at };
                let known = 1e-9_f64.max((1e-14 * terms.max(silent)).sqrt());
                assert!(error < known, "{case}: {error} {only:?}");
                for point in points.iter().filter(|point| point.special.is_none()) {
                    assert_eq!(
                        point.unstable,
                        usize::from(point.parameter > 0.0),
                        "{case}: {}",
                        point.parameter
                    );
                    assert!((point.motion.shape()[0] - at).abs() < 1e-2, "{case}: {}", point.parameter);
                }
                crosses(&family, only, (form, at), &settings, &case);
            }
        }
    }
}

/// The other branch is `x = p`, or `x^2 = p`, within the range and up to its ends.
fn crosses(family: &dyn Family, point: &Point, (form, at): (Form, f64), settings: &Settings, case: &str) {
    let other = switch(family, point, settings, &()).unwrap_or_else(|error| panic!("{case}: {error}"));
    let mut ends = Vec::new();
    for leg in other.into_iter().flatten() {
        let points: Vec<Point> = leg.collect();
        for point in &points {
            let (x, p) = (point.motion.shape()[0] - at, point.parameter);
            assert!((settings.range.0..=settings.range.1).contains(&p), "{case}: {p}");
            let off = if form == Form::Transcritical { x - p } else { x * x - p };
            assert!(off.abs() < 1e-2, "{case}: {x} at {p}");
        }
        ends.push(points.last().unwrap().parameter);
    }
    ends.sort_by(f64::total_cmp);
    let (low, high) = settings.range;
    let expected = if form == Form::Transcritical { [low, high] } else { [high, high] };
    assert_eq!(ends, expected, "{case}");
}

#[test]
fn folds_are_found_beside_any_offset_and_silent_variable() {
    for (at, silent) in CASES {
        for (low, high, step) in [(-1.0, 1.0, 1.0), (-0.6, 1.7, 1.0), (-1.0, 1.0, 0.25)] {
            let case = format!("at {at} beside {silent}, {low} to {high}, step {step}");
            let family = move |p: f64| -> Body { Ok(Box::new(Offset { p, form: Form::Fold, at, silent })) };
            let mut settings = Settings::over(low, high);
            settings.largest_step *= step;
            let all = legs(&family, (0.5, [at + 0.7, at, silent]), &settings);
            let found: Vec<&Point> = all.iter().flatten().filter(|point| point.special.is_some()).collect();
            let [only] = found[..] else { panic!("{case}: {}", found.len()) };
            assert_eq!(only.special, Some(Special::Fold), "{case}");
            let error = only.certificate.unwrap().error;
            assert!(
                only.parameter.abs() <= error && error < 1e-9_f64.max(1e-14 * at * at),
                "{case}: {} +- {error}",
                only.parameter
            );
            for point in all.iter().flatten().filter(|point| point.special.is_none()) {
                let x = point.motion.shape()[0] - at;
                assert_eq!(point.unstable, usize::from(x < 0.0), "{case}: {x}");
            }
            assert!(all.iter().all(|leg| leg.last().unwrap().parameter == high), "{case}");
        }
    }
}

/// Van der Pol's equations about `(at, at)`, as a text is read: orbits of the amplitude `2 sqrt(p)` begin at 0.
struct Oscillator {
    p: f64,
    at: f64,
}
motiform_models::plain!(Oscillator, 2);
impl<T: Scalar> VectorField<T> for Oscillator {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, y, a) = (u[0], u[1], self.at);
        let number = |value: f64| x.constant(value);
        let even = x * x * y - x * y * (2.0 * a) + y * (a * a);
        let odd = x * x * (-a) + x * (2.0 * a * a) - number(a * a * a);
        du[0] = y - number(a);
        du[1] = y * self.p - number(self.p * a) - x + number(a) - even - odd;
    }
}

#[test]
fn oscillations_begin_beside_any_offset() {
    for at in [0.0, 10.0, 100.0, 1000.0] {
        for (low, high) in [(-1.0, 1.0), (-0.6, 1.7)] {
            let case = format!("at {at}, {low} to {high}");
            let family = move |p: f64| -> Body { Ok(Box::new(Oscillator { p, at })) };
            let settings = Settings::over(low, high);
            let start = RelativeEquilibrium::find(&Oscillator { p: -0.5, at }, &[at + 0.01, at]).unwrap();
            let branch = Branch::of_equilibria(&family, -0.5, &start, &settings, &()).unwrap();
            let found: Vec<Point> = branch.filter(|point| point.special.is_some()).collect();
            let [only] = &found[..] else { panic!("{case}: {}", found.len()) };
            let Some(Special::Hopf(hopf)) = only.special else { panic!("{case}: {:?}", only.special) };
            assert!(only.parameter.abs() <= only.certificate.unwrap().error, "{case}: {}", only.parameter);
            assert_eq!(hopf.is_supercritical(), Some(true), "{case}: {hopf:?}");
            let orbits =
                switch(&family, only, &settings, &()).unwrap_or_else(|error| panic!("{case}: {error}"));
            let points: Vec<Point> = orbits.into_iter().flatten().flatten().collect();
            assert_eq!(points.last().unwrap().parameter, high, "{case}");
            for point in &points {
                assert!(point.is_stable(), "{case}: {} {:?}", point.parameter, point.special);
                let largest =
                    point.motion.shapes().iter().map(|u| (u[0] - at).hypot(u[1] - at)).fold(0.0, f64::max);
                let expected = 2.0 * point.parameter.sqrt();
                assert!(
                    point.parameter > 0.2 || (largest / expected - 1.0).abs() < 0.1,
                    "{case}: {}",
                    point.parameter
                );
            }
        }
    }
}
