//! Branches of relative periodic orbits against normal forms, and against the digits of independent programs.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::{full, near, reduced};
use motiform_analysis::periodic::PeriodicGuess;
use motiform_analysis::symmetry::align;
use motiform_analysis::{PeriodicOrbit, RelativeEquilibrium, Result};
use motiform_continuation::{
    Allowance, Branch, End, Family, Motion, PeriodLaw, Point, Settings, Special, same_motion, switch,
};
use motiform_dynamics::{Equivariant, Request, Scalar, StopOnly, VectorField, Watch, drive::drive};
use motiform_models::tensor::reduced::Reduced;
use std::sync::atomic::AtomicBool;

type Body = Result<Box<dyn Equivariant>>;

/// `z' = (p + 2i) z + |z|^2 z - |z|^4 z`: an unstable circle `|z|^2 = (1 - sqrt(1 + 4p))/2` begins at the Hopf bifurcation `p = 0`,
/// and turns into the stable one at `p = -1/4`.
pub(crate) struct Bent(pub(crate) f64);
motiform_models::plain!(Bent, 2);
impl<T: Scalar> VectorField<T> for Bent {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, y) = (u[0], u[1]);
        let square = x * x + y * y;
        let growth = x.constant(self.0) + square - square * square;
        du[0] = growth * x - y * 2.0;
        du[1] = growth * y + x * 2.0;
    }
}

/// `x' = y`, `y' = p + b y + x^2 + x y`: at `p = -b^2` an unstable orbit begins about `x = -b`, which meets a saddle below.
struct Shrinking {
    p: f64,
    b: f64,
}
motiform_models::plain!(Shrinking, 2);
impl<T: Scalar> VectorField<T> for Shrinking {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, y) = (u[0], u[1]);
        du[0] = y;
        du[1] = x.constant(self.p) + y * self.b + x * x + x * y;
    }
}

#[test]
fn orbits_that_begin_unstable_are_unstable_whatever_the_tolerance() {
    let b = 0.3;
    let family = |p: f64| -> Body { Ok(Box::new(Shrinking { p, b })) };
    for tolerance in [1e-6, 1e-7, 1e-8, 1e-9, 1e-10] {
        for (low, high) in [(-0.3, 0.1), (-0.25, -0.01)] {
            let settings = Settings { tolerance, ..Settings::over(low, high) };
            let start = RelativeEquilibrium::find(&Shrinking { p: -0.2, b }, &[-0.45, 0.0]).unwrap();
            let mut equilibria = Branch::of_equilibria(&family, -0.2, &start, &settings, &()).unwrap();
            let hopf = equilibria.find(|point| matches!(point.special, Some(Special::Hopf(_)))).unwrap();
            near(hopf.parameter, -b * b, 1e-9);
            let orbits = switch(&family, &hopf, &settings, &()).unwrap().pop().unwrap().pop().unwrap();
            for point in orbits.take(40) {
                let case = format!("{tolerance} in {low} to {high}: {}", point.parameter);
                assert!(point.special.is_none() && point.unstable == 1, "{case} {:?}", point.special);
            }
        }
    }
}

fn bent(p: f64) -> Body {
    Ok(Box::new(Bent(p)))
}

#[test]
fn the_orbits_of_a_hopf_bifurcation_have_the_size_the_multiplier_and_the_fold_of_their_normal_form() {
    let settings = Settings::over(-0.5, 0.5);
    let rest = RelativeEquilibrium::find(&Bent(-0.4), &[0.1, 0.0]).unwrap();
    let mut equilibria = Branch::of_equilibria(&bent, -0.4, &rest, &settings, &()).unwrap();
    let hopf = equilibria.find(|point| point.special.is_some()).unwrap();
    let orbits = switch(&bent, &hopf, &settings, &()).unwrap().pop().unwrap().pop().unwrap();
    let mut folds = Vec::new();
    for point in orbits {
        let orbit = point.motion.orbit().unwrap();
        let square = orbit.shape[0].powi(2) + orbit.shape[1].powi(2);
        near(point.parameter, square * square - square, 1e-9);
        near(orbit.period(), std::f64::consts::PI, 1e-9);
        let rate = point.parameter + 3.0 * square - 5.0 * square * square;
        near(orbit.multipliers[0].0, (rate * orbit.period()).exp(), 1e-8);
        if point.special.is_some() {
            folds.push((point.parameter, point.special));
        } else {
            assert_eq!(point.unstable, usize::from(square < 0.5), "{} {square}", point.parameter);
        }
    }
    assert_eq!(folds.len(), 1);
    assert_eq!(folds[0].1, Some(Special::Fold));
    near(folds[0].0, -0.25, 1e-11);
}

/// [`bent`], with an allowance.
struct Allowed(Allowance);
impl Family for Allowed {
    fn at(&self, p: f64) -> Body {
        bent(p)
    }

    fn allowance(&self) -> Option<&Allowance> {
        Some(&self.0)
    }
}

/// The orbits of the Hopf bifurcation of [`bent`] within an allowance, the end, and what is left.
fn within(steps: u64) -> (Vec<Point>, Option<End>, u64) {
    let (settings, family) = (Settings::over(-0.5, 0.5), Allowed(Allowance::of(steps)));
    let rest = RelativeEquilibrium::find(&Bent(-0.4), &[0.1, 0.0]).unwrap();
    let mut equilibria = Branch::of_equilibria(&bent, -0.4, &rest, &settings, &()).unwrap();
    let hopf = equilibria.find(|point| point.special.is_some()).unwrap();
    let mut orbits = switch(&family, &hopf, &settings, &()).unwrap().pop().unwrap().pop().unwrap();
    let points: Vec<Point> = orbits.by_ref().collect();
    (points, orbits.end().cloned(), family.0.left())
}

/// The result before an allowance is spent is the beginning of the whole branch, to the bit.
#[test]
fn a_branch_of_orbits_ends_where_its_allowance_is_spent() {
    let enough = 1 << 40;
    let (whole, end, left) = within(enough);
    assert_ne!(end, Some(End::Spent));
    let (part, cut, rest) = within((enough - left) / 2);
    assert_eq!((cut, rest), (Some(End::Spent), 0));
    assert!(part.len() > 3 && part.len() < whole.len(), "{} {}", part.len(), whole.len());
    assert_eq!(part, whole[..part.len()]);
    let (all, as_before, none) = within(enough - left + 1);
    assert_eq!((all.len(), as_before, none), (whole.len(), end, 1));
}

#[test]
fn orbits_that_shrink_end_at_the_hopf_bifurcation() {
    let settings = Settings::over(-0.24, 1.0);
    let square: f64 = 0.5 * (1.0 - (1.0_f64 - 0.8).sqrt());
    let guess = PeriodicGuess { shape: &[square.sqrt(), 0.0], time: 3.1, angle: 0.0, mirrored: false };
    let start = PeriodicOrbit::find(&Bent(-0.2), &guess, &settings.flow, &()).unwrap();
    let mut branch = Branch::of_orbits(&bent, -0.2, &start, &settings, &()).unwrap();
    assert!(branch.by_ref().count() > 5);
    let Some(&End::Shrinks { parameter, time }) = branch.end() else { unreachable!("{:?}", branch.end()) };
    near(parameter, 0.0, 1e-6);
    near(time, std::f64::consts::PI, 1e-6);
}

/// The full model along kappa2 at kappa3 = 0.1.
fn full_model(kappa2: f64) -> Body {
    Ok(Box::new(full(kappa2, 0.1)))
}

/// The zigzag at kappa2 = 0.9, from a simulation.
pub(crate) fn zigzag() -> PeriodicOrbit {
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

fn specials(points: &[Point]) -> Vec<&Point> {
    points.iter().filter(|point| point.special.is_some()).collect()
}

fn period(point: &Point) -> f64 {
    point.motion.orbit().unwrap().period()
}

/// From where a zigzag stands, through its symmetry breaking, to the first two period doublings of the rotating ones.
#[test]
fn zigzags_lose_their_symmetry_and_the_rotating_ones_double_their_period() {
    let settings = Settings::over(0.7, 1.6);
    let start = zigzag();
    let branch = Branch::of_orbits(&full_model, 0.9, &start, &settings.reversed(), &()).unwrap();
    let points: Vec<Point> = branch.collect();
    near(period(&points[0]), 45.313_103_5, 1e-6);
    near(points[0].motion.orbit().unwrap().multipliers[0].0, -0.374_852_1, 1e-7);
    let found = specials(&points);
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].special, Some(Special::SymmetryBreaking));
    near(found[0].parameter, 0.783_547, 1e-6);
    near(period(found[0]), 36.2047, 1e-4);
    assert!(
        points
            .iter()
            .filter(|p| p.special.is_none())
            .all(|p| p.is_stable() == (p.parameter > found[0].parameter))
    );

    let mut rotating = switch(&full_model, found[0], &settings, &()).unwrap();
    assert_eq!(rotating.len(), 1, "left and right are copies");
    let rotating: Vec<Point> = rotating.pop().unwrap().pop().unwrap().collect();
    assert!(
        rotating[0].motion.orbit().unwrap().net_rotation() != 0.0
            && rotating[0].parameter < found[0].parameter
    );
    assert!(rotating[0].is_stable(), "supercritical");
    let doubling = specials(&rotating)[0];
    assert_eq!(doubling.special, Some(Special::PeriodDoubling));
    near(doubling.parameter, 0.7343, 1e-4);
    near(period(doubling), 34.5256, 1e-4);
    let doubled: Vec<Point> =
        switch(&full_model, doubling, &settings, &()).unwrap().pop().unwrap().pop().unwrap().collect();
    let second = specials(&doubled)[0];
    assert_eq!(second.special, Some(Special::PeriodDoubling));
    near(second.parameter, 0.7257, 1e-4);
}

#[test]
fn zigzags_end_where_the_period_grows_as_the_saddle_says() {
    let settings = Settings::over(0.7, 1.6);
    let mut branch = Branch::of_orbits(&full_model, 0.9, &zigzag(), &settings, &()).unwrap();
    let points: Vec<Point> = branch.by_ref().collect();
    let found = specials(&points);
    assert_eq!(found.iter().map(|p| p.special.unwrap().name()).collect::<Vec<_>>(), ["symmetry-breaking"]);
    near(found[0].parameter, 1.148_047, 1e-6);
    let Some(End::Homoclinic(connection)) = branch.end() else { unreachable!("{:?}", branch.end()) };
    near(connection.parameter, 1.344_179, 1e-6);
    let PeriodLaw::Logarithmic { rate } = connection.law else { unreachable!("{:?}", connection.law) };
    near(rate / connection.leading().unwrap().abs(), 1.0, 1e-2);
    let saddle = connection.saddle.as_ref().unwrap();
    assert!(saddle.turning_rate.abs() < 1e-9 && saddle.speed() > 0.1, "straight motion");
}

/// The rotating zigzags beyond the upper symmetry breaking double their period and end in a connection of their own.
#[test]
fn the_rotating_zigzags_on_the_other_side_end_elsewhere() {
    let settings = Settings::over(0.7, 1.6);
    let mut branch = Branch::of_orbits(&full_model, 0.9, &zigzag(), &settings, &()).unwrap();
    let breaking = branch.find(|point| point.special.is_some()).unwrap();
    let mut rotating = switch(&full_model, &breaking, &settings, &()).unwrap().pop().unwrap().pop().unwrap();
    let points: Vec<Point> = rotating.by_ref().collect();
    near(specials(&points)[0].parameter, 1.1621, 1e-4);
    let Some(End::Homoclinic(connection)) = rotating.end() else { unreachable!("{:?}", rotating.end()) };
    near(connection.parameter, 1.2317, 1e-4);
}

/// The quasi-periodic motion of the reduced model ends where growth and decay at the ellipse are equal, at gamma = 0, and its period
/// grows as `A/gamma`.
#[test]
fn the_quasi_periodic_motion_of_the_reduced_model_ends_in_a_resonance() {
    let family = |gamma: f64| -> Body { Ok(Box::new(reduced(-0.06, gamma))) };
    let settings = Settings::over(-0.01, 0.1);
    let circular = Reduced::PAPER.circular(-0.06, 0.05).unwrap();
    let sine = (1.0 - circular.cos_psi * circular.cos_psi).sqrt();
    let guess = [circular.speed, 0.0, circular.r2 * circular.cos_psi, circular.r2 * sine, 0.0, 0.0];
    let start = RelativeEquilibrium::find(&reduced(-0.06, 0.05), &guess).unwrap();
    let mut equilibria = Branch::of_equilibria(&family, 0.05, &start, &settings.reversed(), &()).unwrap();
    let hopf = equilibria.find(|point| point.special.is_some()).unwrap();
    near(hopf.parameter, 0.4 * 0.06, 1e-9);
    let mut orbits = switch(&family, &hopf, &settings, &()).unwrap().pop().unwrap().pop().unwrap();
    assert!(orbits.by_ref().all(|point| point.is_stable()));
    let Some(End::Homoclinic(connection)) = orbits.end() else { unreachable!("{:?}", orbits.end()) };
    let PeriodLaw::Resonant { amplitude } = connection.law else { unreachable!("{:?}", connection.law) };
    near(connection.parameter, 0.0, 1e-4);
    near(amplitude, 0.4227, 0.02 * 0.4227);
}

#[test]
fn copies_are_recognised_and_others_are_not() {
    let body = full(0.9, 0.1);
    let settings = Settings::over(0.7, 1.6);
    let start = zigzag();
    let first = |start: &PeriodicOrbit| {
        Branch::of_orbits(&full_model, 0.9, start, &settings, &()).unwrap().next().unwrap().motion
    };
    let motion = first(&start);
    let after = |time: f64| {
        let Settings { flow, .. } = settings;
        let mut orbit = flow.method.shape_orbit(&body, flow.control, 0.0, &start.shape).unwrap();
        drive(orbit.as_mut(), &Request::until(time, 6), &mut ()).unwrap();
        PeriodicOrbit { shape: orbit.state().to_vec(), ..start.clone() }
    };
    // either of two starts lies just before the other one
    let just = first(&after(1e-3));
    assert!(same_motion(&body, &motion, &just, &settings.flow, 1e-6));
    assert!(same_motion(&body, &just, &motion, &settings.flow, 1e-6));
    let mut later = after(7.7);
    body.mirror(&mut later.shape);
    body.rotate(0.3, &mut later.shape);
    later.angle = 0.6 - start.angle;
    let copy = first(&later);
    assert!(same_motion(&body, &motion, &copy, &settings.flow, 1e-6));
    let other = Branch::of_orbits(&full_model, 0.9, &start, &settings, &()).unwrap().nth(3).unwrap().motion;
    assert!(!same_motion(&body, &motion, &other, &settings.flow, 1e-6));
    let Motion::Orbit { mut orbit, nodes } = motion.clone() else { unreachable!() };
    orbit.shape[0] += 1e-3;
    assert!(!same_motion(&body, &motion, &Motion::Orbit { orbit, nodes }, &settings.flow, 1e-6));
}

#[test]
fn a_watch_stops_a_branch_and_what_was_computed_stays() {
    let settings = Settings::over(0.7, 1.6);
    let stop = AtomicBool::new(false);
    let watch = StopOnly(&stop as &dyn Watch);
    let mut branch = Branch::of_orbits(&full_model, 0.9, &zigzag(), &settings, &watch).unwrap();
    let first: Vec<Point> = branch.by_ref().take(3).collect();
    stop.store(true, std::sync::atomic::Ordering::Relaxed);
    let rest = branch.by_ref().count();
    assert_eq!((first.len(), rest, branch.end()), (3, 0, Some(&End::Stopped)));
    let again: Vec<Point> =
        Branch::of_orbits(&full_model, 0.9, &zigzag(), &settings, &()).unwrap().take(3).collect();
    assert_eq!(first, again);
}
