//! Branches of two classical systems against published numbers (`reference/zoo.toml`): Rossler's cycles, Lorenz's homoclinic orbit.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::near;
use motiform_analysis::periodic::PeriodicGuess;
use motiform_analysis::{PeriodicOrbit, RelativeEquilibrium, Result};
use motiform_continuation::{Branch, End, Family, Point, Settings, Special, switch};
use motiform_dynamics::drive::{Request, drive};
use motiform_dynamics::{Equivariant, Scalar, VectorField};
use motiform_models::zoo::{Lorenz, Rossler};

type Body = Result<Box<dyn Equivariant>>;

fn reference(table: &str, key: &str) -> f64 {
    let all: toml::Table = include_str!("../../../../../reference/zoo.toml").parse().unwrap();
    all[table][key].as_float().unwrap()
}

fn rossler(c: f64) -> Body {
    Ok(Box::new(Rossler { c, ..Rossler::default() }))
}

/// The multiplier that is neither 1 (along the flow) nor nearly 0.
fn multiplier(point: &Point) -> f64 {
    let orbit = point.motion.orbit().unwrap();
    orbit.multipliers.iter().map(|value| value.0).min_by(f64::total_cmp).unwrap()
}

/// Followed from the stable cycle at c = 2 to c = 5.7, where it is unstable: period and multiplier have the published digits. So has the
/// cycle of twice the period that begins where the multiplier is -1.
#[test]
fn rosslers_cycles_double_their_period_and_have_the_published_multipliers() {
    let settings = Settings::over(1.9, 5.7);
    let body = Rossler { c: 2.0, ..Rossler::default() };
    let flow = settings.flow;
    let mut orbit = flow.method.shape_orbit(&body, flow.control, 0.0, &[1.0, 1.0, 0.0]).unwrap();
    drive(orbit.as_mut(), &Request::until(500.0, 3), &mut ()).unwrap();
    let guess = PeriodicGuess { shape: orbit.state(), time: 5.8, angle: 0.0, mirrored: false };
    let start = PeriodicOrbit::find(&body, &guess, &flow, &()).unwrap();
    let points: Vec<Point> = Branch::of_orbits(&rossler, 2.0, &start, &settings, &()).unwrap().collect();
    let last = points.last().unwrap();
    near(last.parameter, 5.7, 0.0);
    near(last.motion.orbit().unwrap().period(), reference("rossler", "period"), 3e-9);
    near(last.motion.orbit().unwrap().period(), reference("rossler", "period_again"), 1e-12);
    near(multiplier(last), reference("rossler", "multiplier"), 3e-8);
    let doubling = points.iter().find(|point| point.special == Some(Special::PeriodDoubling)).unwrap();
    near(multiplier(doubling), -1.0, 1e-6);
    let doubled: Vec<Point> =
        switch(&rossler, doubling, &settings, &()).unwrap().pop().unwrap().pop().unwrap().collect();
    let last = doubled.last().unwrap();
    near(last.parameter, 5.7, 0.0);
    near(last.motion.orbit().unwrap().period(), reference("rossler", "period2"), 6e-9);
    near(multiplier(last), reference("rossler", "multiplier2"), 1e-7);
}

fn lorenz(rho: f64) -> Body {
    Ok(Box::new(Lorenz { rho, ..Lorenz::default() }))
}

/// Convection loses its stability at rho = sigma (sigma + beta + 3)/(sigma - beta - 1) = 470/19, subcritically; the unstable cycle that
/// begins there ends on the homoclinic orbit of the rest.
#[test]
fn lorenzs_cycle_ends_on_the_homoclinic_orbit() {
    let settings = Settings::over(10.0, 30.0);
    let c = (8.0_f64 / 3.0 * 19.0).sqrt();
    let body = Lorenz { rho: 20.0, ..Lorenz::default() };
    let mut rate = [0.0; 3];
    VectorField::<f64>::eval(&body, 0.0, &[c, c, 19.0], &mut rate);
    assert!(rate.iter().all(|x| x.abs() < 1e-12));
    let start = RelativeEquilibrium::find(&body, &[c, c, 19.0]).unwrap();
    let mut branch = Branch::of_equilibria(&lorenz, 20.0, &start, &settings, &()).unwrap();
    let hopf = branch.find(|point| point.special.is_some()).unwrap();
    near(hopf.parameter, 470.0 / 19.0, 1e-8);
    let Some(Special::Hopf(kind)) = hopf.special else { unreachable!("{:?}", hopf.special) };
    assert_eq!(kind.is_supercritical(), Some(false));
    let mut cycles = switch(&lorenz, &hopf, &settings, &()).unwrap().pop().unwrap().pop().unwrap();
    assert!(cycles.by_ref().all(|point| point.unstable > 0 || point.special.is_some()));
    let Some(End::Homoclinic(connection)) = cycles.end() else { unreachable!("{:?}", cycles.end()) };
    near(connection.parameter, reference("lorenz", "homoclinic"), 1e-4);
}

/// The special points of the orbits from the one that the flow settles on from `start`.
fn special_points(
    family: &dyn Family,
    at: f64,
    start: &[f64],
    (time, settings): (f64, Settings),
) -> Vec<Point> {
    let (body, flow) = (family.at(at).unwrap(), settings.flow);
    let mut orbit = flow.method.shape_orbit(body.as_ref(), flow.control, 0.0, start).unwrap();
    drive(orbit.as_mut(), &Request::until(200.0, start.len()), &mut ()).unwrap();
    let guess = PeriodicGuess { shape: orbit.state(), time, angle: 0.0, mirrored: false };
    let found = PeriodicOrbit::find(body.as_ref(), &guess, &flow, &()).unwrap();
    let branch = Branch::of_orbits(family, at, &found, &settings, &()).unwrap();
    branch.filter(|point| point.special.is_some()).collect()
}

/// The symmetric cycle at large rho loses its symmetry at 312.97 (Sparrow 1982: about 313), for every range and
/// step size. Close to that point the error of the cycle is the round-off divided by the growth rate.
#[test]
fn lorenzs_symmetric_cycle_loses_its_symmetry_in_every_range() {
    for low in [290.0, 295.0, 300.0, 305.0, 310.0, 312.0] {
        let settings = Settings { first_step: -0.005, ..Settings::over(low, 350.0) };
        let found = special_points(&lorenz, 350.0, &[10.0, 20.0, 300.0], (0.3885, settings));
        let [only] = &found[..] else { unreachable!("from {low}: {} points", found.len()) };
        assert_eq!(only.special, Some(Special::BranchPoint), "from {low}");
        near(only.parameter, 312.973533, 3e-7);
        let ends = |leg: Branch<'_>| leg.last().unwrap().parameter;
        let crossing: Vec<f64> =
            switch(&lorenz, only, &settings, &()).unwrap().into_iter().flatten().map(ends).collect();
        assert_eq!(crossing, [low; 2], "both orbits that begin go to the other side");
    }
}

/// `r' = r (1 - r^2)`, `theta' = 2`, `z' = p z - z^3`: the cycle has a pitchfork at 0.
struct Forked(f64);
motiform_models::plain!(Forked, 3);
impl<T: Scalar> VectorField<T> for Forked {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let (x, y, z) = (u[0], u[1], u[2]);
        let growth = x.constant(1.0) - x * x - y * y;
        du[0] = growth * x - y * 2.0;
        du[1] = growth * y + x * 2.0;
        du[2] = z * self.0 - z * z * z;
    }
}

/// Also where a step or a guess meets the place exactly, so that Newton's method has nothing to go by.
#[test]
fn a_pitchfork_of_a_cycle_is_found_in_every_range() {
    let family = |p: f64| -> Body { Ok(Box::new(Forked(p))) };
    for (low, high) in [(-0.5, 0.5), (-0.5, 0.3), (-0.6, 0.4), (-0.55, 0.45), (-1.0, 0.5)] {
        let found = special_points(
            &family,
            -0.5,
            &[1.0, 0.0, 0.0],
            (std::f64::consts::PI, Settings::over(low, high)),
        );
        let [only] = &found[..] else { unreachable!("{low} to {high}: {} points", found.len()) };
        assert_eq!(only.special, Some(Special::BranchPoint), "{low} to {high}");
        near(only.parameter, 0.0, 1e-9);
    }
}
