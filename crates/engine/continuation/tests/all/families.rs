//! Branches whose solutions form families that the equations do not state as a symmetry.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::near;
use motiform_analysis::periodic::PeriodicGuess;
use motiform_analysis::{PeriodicOrbit, RelativeEquilibrium, Result};
use motiform_continuation::{Branch, End, Point, Settings, switch};
use motiform_dynamics::{Equivariant, Scalar, VectorField};

type Body = Result<Box<dyn Equivariant>>;

/// `z' = p z + a |z|^2 z - |z|^4 z`: circles of equilibria, `p + a r^2 - r^4 = 0`, with the growth `2 a r^2 - 4 r^4` across them.
struct Circles {
    p: f64,
    a: f64,
}
motiform_models::plain!(Circles, 2);
impl<T: Scalar> VectorField<T> for Circles {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let square = u[0] * u[0] + u[1] * u[1];
        let growth = square * self.a - square * square + square.constant(self.p);
        du[0] = growth * u[0];
        du[1] = growth * u[1];
    }
}

fn of_equilibria(a: f64, (p, angle): (f64, f64), settings: &Settings) -> (Vec<Point>, Option<End>) {
    let family = move |p: f64| -> Body { Ok(Box::new(Circles { p, a })) };
    let radius = (0.5 * (a + (a * a + 4.0 * p).sqrt())).sqrt();
    let (sin, cos) = angle.sin_cos();
    let start = RelativeEquilibrium::find(&Circles { p, a }, &[radius * cos, radius * sin]).unwrap();
    let mut branch = Branch::of_equilibria(&family, p, &start, settings, &()).unwrap();
    let points = branch.by_ref().collect();
    (points, branch.end().cloned())
}

fn names(points: &[Point]) -> Vec<&'static str> {
    points.iter().filter_map(|point| Some(point.special?.name())).collect()
}

#[test]
fn circles_of_equilibria_are_a_family_whose_fold_is_a_fold() {
    for (angle, low, high, step) in
        [(0.3, -1.0, 1.0, 0.02), (2.0, -0.7, 1.5, 0.02), (0.0, -1.0, 1.0, 0.01), (1.0, -3.0, 0.7, 0.02)]
    {
        let settings = Settings { largest_step: step, ..Settings::over(low, high) }.reversed();
        let (points, end) = of_equilibria(1.0, (0.5, angle), &settings);
        assert_eq!(names(&points[..points.len().min(400)]).first(), Some(&"fold"), "{angle} {end:?}");
        let fold = points.iter().find(|point| point.special.is_some()).unwrap();
        near(fold.parameter, -0.25, 1e-9);
        for point in &points {
            let shape = point.motion.shape();
            let square = shape[0] * shape[0] + shape[1] * shape[1];
            near(point.parameter, square * square - square, 1e-8);
            if square > 0.05 {
                assert_eq!(point.family, 1, "{} {}", point.parameter, square);
            }
            if point.special.is_none() && square > 0.05 {
                assert_eq!(
                    (point.unstable, point.neutral),
                    (usize::from(square < 0.5), 0),
                    "{}",
                    point.parameter
                );
            }
        }
    }
}

#[test]
fn a_circle_of_equilibria_is_stable_within_its_family() {
    for (angle, high) in [(0.3, 1.0), (4.0, 2.0)] {
        let (points, end) = of_equilibria(-1.0, (0.5, angle), &Settings::over(-1.0, high));
        assert_eq!((names(&points).len(), end), (0, Some(End::RangeLeft)));
        assert!(points.iter().all(|point| point.is_stable() && point.family == 1));
        near(points.last().unwrap().parameter, high, 0.0);
    }
}

/// `z' = (1 + i - |z|^2) z` beside `w' = mu w - |w|^2 w`: a limit cycle for every w on the circle `|w|^2 = mu`.
struct Beside(f64);
motiform_models::plain!(Beside, 4);
impl<T: Scalar> VectorField<T> for Beside {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, y) = (u[0], u[1]);
        let growth = x.constant(1.0) - x * x - y * y;
        du[0] = growth * x - y;
        du[1] = growth * y + x;
        let other = x.constant(self.0) - u[2] * u[2] - u[3] * u[3];
        du[2] = other * u[2];
        du[3] = other * u[3];
    }
}

fn beside(mu: f64) -> Body {
    Ok(Box::new(Beside(mu)))
}

#[test]
fn limit_cycles_over_a_circle_are_a_family_without_special_points() {
    for (mu, angle, high) in [(0.5, 0.0_f64, 1.0), (0.3, 1.0, 2.0), (0.2, 4.0, 1.0)] {
        let radius = f64::sqrt(mu);
        let shape = [1.0, 0.0, radius * angle.cos(), radius * angle.sin()];
        let guess = PeriodicGuess { shape: &shape, time: std::f64::consts::TAU, angle: 0.0, mirrored: false };
        let settings = Settings::over(-1.0, high);
        let start = PeriodicOrbit::find(&Beside(mu), &guess, &settings.flow, &()).unwrap();
        let mut branch = Branch::of_orbits(&beside, mu, &start, &settings, &()).unwrap();
        let points: Vec<Point> = branch.by_ref().collect();
        assert_eq!((names(&points).len(), branch.end()), (0, Some(&End::RangeLeft)), "{mu}");
        for point in &points {
            let shape = point.motion.shape();
            near(shape[2] * shape[2] + shape[3] * shape[3], point.parameter, 1e-8);
            assert!(point.is_stable() && point.family == 1, "{}", point.parameter);
            let multipliers = &point.motion.orbit().unwrap().multipliers;
            assert_eq!(multipliers.len(), 3);
            assert!(multipliers[0] == (1.0, 0.0), "{multipliers:?}");
        }
    }
}

#[test]
fn the_family_that_begins_where_the_circle_grows_is_followed() {
    for (low, high) in [(-1.0, 1.0), (-0.4, 0.7)] {
        let settings = Settings::over(low, high);
        let shape = [1.0, 0.0, 0.0, 0.0];
        let guess = PeriodicGuess { shape: &shape, time: std::f64::consts::TAU, angle: 0.0, mirrored: false };
        let start = PeriodicOrbit::find(&Beside(-0.2), &guess, &settings.flow, &()).unwrap();
        let mut branch = Branch::of_orbits(&beside, -0.2, &start, &settings, &()).unwrap();
        let point = branch.find(|point| point.special.is_some()).unwrap();
        near(point.parameter, 0.0, 1e-8);
        assert_eq!(point.family, 0);
        for leg in switch(&beside, &point, &settings, &()).unwrap().into_iter().flatten() {
            let mut leg = leg;
            let points: Vec<Point> = leg.by_ref().collect();
            assert_eq!(names(&points), Vec::<&str>::new(), "{:?}", leg.end());
            assert_eq!(leg.end(), Some(&End::RangeLeft));
            assert!(points.iter().all(|point| point.is_stable() && point.family == 1));
        }
    }
}
