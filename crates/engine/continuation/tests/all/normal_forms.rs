//! Leading coefficients of normal forms: against exact ones, in other units and from other starts, and against the branches that begin.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{full, near, reduced};
use crate::orbits::{Bent, zigzag};
use motiform_analysis::periodic::PeriodicGuess;
use motiform_analysis::symmetry::align;
use motiform_analysis::{PeriodicOrbit, RelativeEquilibrium, Result};
use motiform_continuation::{Branch, Coefficient, Family, Point, Settings, Special, switch};
use motiform_continuation::{NormalForm, TestFunction};
use motiform_dynamics::{Equivariant, Scalar, VectorField};

type Body = Result<Box<dyn Equivariant>>;

/// The special points of a branch of equilibria.
fn steady(family: &dyn Family, p: f64, guess: &[f64], settings: &Settings) -> Vec<Point> {
    let body = family.at(p).expect("a body");
    let start = RelativeEquilibrium::find(body.as_ref(), guess).expect("an equilibrium");
    let branch = Branch::of_equilibria(family, p, &start, settings, &()).expect("it lies on a branch");
    branch.filter(|point| point.special.is_some()).collect()
}

/// The special points of a branch of orbits.
fn periodic(family: &dyn Family, p: f64, guess: &PeriodicGuess<'_>, settings: &Settings) -> Vec<Point> {
    let body = family.at(p).expect("a body");
    let start = PeriodicOrbit::find(body.as_ref(), guess, &settings.flow, &()).expect("an orbit");
    let branch = Branch::of_orbits(family, p, &start, settings, &()).expect("it lies on a branch");
    branch.filter(|point| point.special.is_some()).collect()
}

fn form(point: &Point) -> NormalForm {
    match point.special {
        Some(Special::Hopf(hopf)) => hopf.first_lyapunov,
        _ => point.certificate.and_then(|found| found.normal_form).expect("it has a certificate"),
    }
}

fn coefficient(point: &Point) -> Coefficient {
    form(point).coefficient().unwrap_or_else(|| unreachable!("{point:?}"))
}

/// The coefficient is this within its error, which is small.
fn is(point: &Point, expected: f64) {
    let Coefficient { value, error } = coefficient(point);
    assert!((value - expected).abs() <= error + 1e-8 * expected.abs(), "{value} +- {error}, not {expected}");
    assert!(error < 1e-4 * expected.abs(), "{value} +- {error}");
}

/// `x' = p + x - x^3/3` in a unit of length: at the folds `x = -1, 1` the second derivative is 2.
struct Fold {
    p: f64,
    unit: f64,
}
motiform_models::plain!(Fold, 1);
impl<T: Scalar> VectorField<T> for Fold {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let x = u[0] * (1.0 / self.unit);
        du[0] = (x.constant(self.p) + x - x * x * x * (1.0 / 3.0)) * self.unit;
    }
}

#[test]
fn the_coefficient_of_a_fold_is_half_the_second_derivative_in_every_unit() {
    for unit in [1e-4, 1.0, 1e4] {
        let family = |p: f64| -> Body { Ok(Box::new(Fold { p, unit })) };
        let found = steady(
            &family,
            -2.0,
            &[-2.4 * unit],
            &Settings { largest_size: 1e9, ..Settings::over(-2.0, 2.0) },
        );
        assert_eq!(found.len(), 2);
        found.iter().for_each(|point| is(point, 1.0 / unit));
    }
}

/// `x'' = (p - x^2) x' - x`: with `x = a cos t` the mean growth is `a' = p a / 2 - a^3 / 8` (van der Pol), and `a = sqrt 2 |z|`.
struct VanDerPol(f64);
motiform_models::plain!(VanDerPol, 2);
impl<T: Scalar> VectorField<T> for VanDerPol {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, y) = (u[0], u[1]);
        du[0] = y;
        du[1] = (x.constant(self.0) - x * x) * y - x;
    }
}

/// The Lorenz equations with Prandtl number 10 and geometry 8/3.
pub(super) struct Lorenz(pub(super) f64);
motiform_models::plain!(Lorenz, 3);
impl<T: Scalar> VectorField<T> for Lorenz {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, y, z) = (u[0], u[1], u[2]);
        du[0] = (y - x) * 10.0;
        du[1] = x * self.0 - y - x * z;
        du[2] = x * y - z * (8.0 / 3.0);
    }
}

/// Lorenz: subcritical at 470/19. Source: Marsden and McCracken (1976), The Hopf Bifurcation and its Applications, section 4B.
#[test]
fn first_lyapunov_coefficients_of_classical_oscillators() {
    let van_der_pol = |p: f64| -> Body { Ok(Box::new(VanDerPol(p))) };
    let found = steady(&van_der_pol, -0.5, &[0.0; 2], &Settings::over(-0.5, 0.5));
    assert_eq!(found.len(), 1);
    is(&found[0], -0.25);
    let lorenz = |r: f64| -> Body { Ok(Box::new(Lorenz(r))) };
    let side = (8.0_f64 / 3.0 * 22.0).sqrt();
    let found = steady(&lorenz, 23.0, &[side, side, 22.0], &Settings::over(22.0, 27.0));
    assert_eq!(found.len(), 1);
    near(found[0].parameter, 470.0 / 19.0, 1e-8);
    let Coefficient { value, error } = coefficient(&found[0]);
    assert!(value > 0.0 && error < 1e-6 * value, "{value} +- {error}");
}

/// Orbits of radius r of `Bent` have a fold at `r^2 = 1/2`, where the second derivative of `r'` is `-4 r`.
#[test]
fn the_coefficient_of_a_fold_of_orbits_is_that_of_the_growth_of_their_radius() {
    let family = |p: f64| -> Body { Ok(Box::new(Bent(p))) };
    for parts in [1, 4, 7] {
        let settings = Settings { parts, ..Settings::over(-0.3, 0.5) };
        let radius = (0.5 * (1.0 + 0.2_f64.sqrt())).sqrt();
        let guess = PeriodicGuess { shape: &[0.0, radius], time: 3.1, angle: 0.0, mirrored: false };
        let found = periodic(&family, -0.2, &guess, &settings.reversed());
        assert_eq!(found.len(), 1, "{parts}");
        is(&found[0], 2.0_f64.sqrt());
    }
}

/// A band around the orbit `z = e^(it)` that is turned over once a period: `w = e^(it/2) (xi + i eta)` with
///
/// `xi' = g xi`, `eta' = -eta`, `g = p + c xi^2 + d s`, `s = |z|^2 - 1`, which tends to `e xi^2`.
///
/// In the equations `e^(it)` is `z`, whose modulus adds `s / 4` to `g`.
struct Band {
    p: f64,
    c: f64,
    d: f64,
    e: f64,
}
motiform_models::plain!(Band, 4);
impl<T: Scalar> VectorField<T> for Band {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, y, a, b) = (u[0], u[1], u[2], u[3]);
        let one = x.constant(1.0);
        let s = x * x + y * y - one;
        // w^2 conj z, and z conj w
        let even = (a * a - b * b) * x + a * b * y * 2.0;
        let (re, im) = (x * a + y * b, y * a - x * b);
        let square = (a * a + b * b + even) * 0.5;
        let g = square * self.c + s * self.d + x.constant(self.p);
        let radial = square * self.e - s;
        du[0] = radial * x - y;
        du[1] = radial * y + x;
        du[2] = (g - one) * a * 0.5 - b * 0.5 + (g + one) * re * 0.5;
        du[3] = (g - one) * b * 0.5 + a * 0.5 + (g + one) * im * 0.5;
    }
}

#[test]
fn the_coefficient_of_a_period_doubling_is_that_of_a_band_that_is_turned_over() {
    for (c, d, e) in
        [(-1.0, 0.0, 0.0), (1.0, 0.0, 0.0), (-1.0, 0.75, 2.0), (-2.0, 1.0, 0.5), (0.5, -1.0, 1.0)]
    {
        let expected = c + (d + 0.25) * e;
        let family = move |p: f64| -> Body { Ok(Box::new(Band { p, c, d, e })) };
        for parts in [3, 4] {
            let settings = Settings { parts, ..Settings::over(-0.3, 0.3) };
            let guess =
                PeriodicGuess { shape: &[0.6, 0.8, 0.0, 0.0], time: 6.3, angle: 0.0, mirrored: false };
            let found = periodic(&family, -0.2, &guess, &settings);
            assert_eq!(found.len(), 1);
            assert_eq!(found[0].special, Some(Special::PeriodDoubling));
            is(&found[0], expected);
        }
    }
}

/// Where the cubic term vanishes its sign is not decided.
#[test]
fn a_coefficient_within_its_error_decides_nothing() {
    let family = |p: f64| -> Body { Ok(Box::new(Band { p, c: -0.25, d: 0.0, e: 1.0 })) };
    let guess = PeriodicGuess { shape: &[0.6, 0.8, 0.0, 0.0], time: 6.3, angle: 0.0, mirrored: false };
    let found = periodic(&family, -0.2, &guess, &Settings::over(-0.3, 0.3));
    let Coefficient { value, error } = coefficient(&found[0]);
    assert!(value.abs() < 1e-5 && error < 1e-4, "{value} +- {error}");
    assert_eq!(Coefficient { value: 5e-7, error: 2e-7 }.is_negative(), None);
    assert_eq!(Coefficient { value: -7e-7, error: 2e-7 }.is_negative(), Some(true));
}

/// Beside a pitchfork the branch that begins, `xi^2 = - growth' dp / c`, is where the coefficient says: at two distances, extrapolated.
fn agrees(family: &dyn Family, point: &Point, settings: &Settings) {
    let certificate = point.certificate.unwrap();
    assert_eq!(certificate.test, TestFunction::Growth);
    let growth = certificate.transversality / point.slope;
    let mut branch = switch(family, point, settings, &()).unwrap();
    let near: Vec<Point> = branch.pop().unwrap().pop().unwrap().take(2).collect();
    let seen = |other: &Point| {
        let body = family.at(point.parameter).unwrap();
        let apart = align(body.as_ref(), other.motion.shape(), point.motion.shape(), false).distance;
        let square = apart * apart;
        (square, -growth * (other.parameter - point.parameter) / square)
    };
    let [(square, first), (more, second)] = [seen(&near[0]), seen(&near[1])];
    let at_the_point = first - square * (second - first) / (more - square);
    let found = coefficient(point);
    assert!((found.value / at_the_point - 1.0).abs() < 0.02, "{found:?}: {first} {second} {at_the_point}");
}

/// Motion begins at rest: all directions are images of each other. In the tensor model's amplitude equations
/// `z1' = (gamma + kappa2...) z1`, rest loses its stability to the first mode, or to the second.
#[test]
fn motion_that_begins_at_rest_has_the_amplitude_that_the_coefficient_says() {
    let settings = Settings { first_step: 1e-4, largest_step: 0.005, ..Settings::over(-0.2, 0.2) };
    let along_kappa2 = |kappa2: f64| -> Body { Ok(Box::new(reduced(kappa2, -0.1))) };
    let along_gamma = |gamma: f64| -> Body { Ok(Box::new(reduced(-0.06, gamma))) };
    for (family, start) in [(&along_kappa2 as &dyn Family, -0.1), (&along_gamma, -0.15)] {
        let found = steady(family, start, &[0.0; 6], &settings);
        let forks = found.iter().filter(|point| matches!(point.special, Some(Special::Pitchfork { .. })));
        let mut count = 0;
        for fork in forks {
            count += 1;
            agrees(family, fork, &Settings { first_step: 1e-4, ..settings });
        }
        assert!(count > 0);
    }
}

/// Straight motion begins to turn (a drift pitchfork, where the critical direction and the rotation form a Jordan block).
#[test]
fn straight_motion_of_the_full_model_begins_to_turn_as_the_coefficient_says() {
    let family = |kappa2: f64| -> Body { Ok(Box::new(full(kappa2, 0.1))) };
    let settings = Settings::over(2.5, 3.0);
    let found = steady(&family, 2.9, &[-0.9, 0.0, 0.2, 0.0, 0.0, 0.0], &settings.reversed());
    let fork = found.iter().find(|point| (point.parameter - 2.713_569).abs() < 1e-6).unwrap();
    assert_eq!(coefficient(fork).is_negative(), Some(true), "{fork:?}");
    agrees(&family, fork, &Settings { first_step: 1e-4, ..settings });
}

/// The zigzag at kappa2 = 0.9 of the full model loses its symmetry, and its rotating images double their period; both supercritically, with
/// coefficients that do not depend on the number of parts.
#[test]
fn coefficients_of_the_zigzag_do_not_depend_on_its_parts() {
    let family = |kappa2: f64| -> Body { Ok(Box::new(full(kappa2, 0.1))) };
    let start = zigzag();
    let all: Vec<[Coefficient; 2]> = [4, 6]
        .into_iter()
        .map(|parts| {
            let settings = Settings { parts, ..Settings::over(0.72, 1.0) };
            let branch = Branch::of_orbits(&family, 0.9, &start, &settings.reversed(), &()).unwrap();
            let broken = branch.into_iter().find(|point| point.special.is_some()).unwrap();
            assert_eq!(broken.special, Some(Special::SymmetryBreaking));
            let rotating = switch(&family, &broken, &settings, &()).unwrap().pop().unwrap().pop().unwrap();
            let doubling = rotating.into_iter().find(|point| point.special.is_some()).unwrap();
            assert_eq!(doubling.special, Some(Special::PeriodDoubling));
            [coefficient(&broken), coefficient(&doubling)]
        })
        .collect();
    for (four, six) in all[0].iter().zip(&all[1]) {
        assert_eq!((four.is_negative(), six.is_negative()), (Some(true), Some(true)));
        assert!(
            (four.value - six.value).abs() <= four.error + six.error + 1e-6 * six.value.abs(),
            "{four:?} {six:?}"
        );
        assert!(four.error < 0.02 * four.value.abs(), "{four:?}");
    }
}
