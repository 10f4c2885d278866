//! Relative periodic orbits against exact values, differences of the flow, and long simulations.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::{Random, cell, full, named, near, settings};
use motiform_analysis::periodic::{Flow, PeriodicGuess};
use motiform_analysis::symmetry::{Gauge, align};
use motiform_analysis::{PeriodicOrbit, Regime};
use motiform_dynamics::steppers::{DOP853, Method};
use motiform_dynamics::{Direction, Equivariant, Request, Section, StepControl, Trajectory, drive::drive};
use motiform_models::zoo::{Hopf, VanDerPol};
use nalgebra::DMatrix;

const CONTROL: StepControl = StepControl::Adaptive { rtol: 1e-12, atol: 1e-14 };
const FLOW: Flow = Flow { method: Method::Explicit(&DOP853), control: CONTROL, max_steps: 10_000_000 };

fn reference(system: &str, key: &str) -> f64 {
    let all: toml::Table = include_str!("../../../../../reference/zoo.toml").parse().unwrap();
    all[system][key].as_float().unwrap()
}

/// The state after `time`.
fn after(body: &(impl Equivariant + ?Sized), start: &[f64], time: f64) -> Vec<f64> {
    let mut orbit = FLOW.method.shape_orbit(body, FLOW.control, 0.0, start).unwrap();
    assert!(drive(orbit.as_mut(), &Request::until(time, start.len()), &mut ()).unwrap().is_complete());
    orbit.state().to_vec()
}

fn plain<'s>(shape: &'s [f64], time: f64) -> PeriodicGuess<'s> {
    PeriodicGuess { shape, time, angle: 0.0, mirrored: false }
}

/// The multiplier is exp of the divergence mu (1 - x^2) over the cycle (Liouville).
#[test]
fn van_der_pol_has_its_period_and_the_multiplier_of_its_divergence() {
    let body = VanDerPol { mu: reference("van_der_pol", "mu") };
    let start = after(&body, &[2.0, 0.1], 20.0);
    let orbit = PeriodicOrbit::find(&body, &plain(&start, 6.6), &FLOW, &()).unwrap();
    near(orbit.period(), reference("van_der_pol", "period"), 1e-10); // rtol 1e-12, some 60 steps
    assert_eq!((orbit.net_rotation(), orbit.multipliers.len()), (0.0, 1));
    near(orbit.exponents()[0], divergence(&body, &orbit.shape, orbit.period()), 1e-7);
}

/// The mean of `mu (1 - x^2)` over a cycle.
fn divergence(body: &VanDerPol, shape: &[f64], period: f64) -> f64 {
    const COUNT: usize = 10_000;
    let mut path = Trajectory::new(2);
    let mut run = FLOW.method.shape_orbit(body, CONTROL, 0.0, shape).unwrap();
    let request = Request { sample_every: Some(period / COUNT as f64), ..Request::until(period, 2) };
    drive(run.as_mut(), &request, &mut path).unwrap();
    // the trapezoidal rule is spectrally accurate over a period
    path.iter().take(COUNT).map(|(_, u)| body.mu * (1.0 - u[0] * u[0])).sum::<f64>() / COUNT as f64
}

/// The matrix of a period has it as 3e-10, which is round-off.
#[test]
fn a_multiplier_far_below_round_off_is_said_as_it_is() {
    let body = VanDerPol { mu: 3.0 };
    let start = after(&body, &[2.0, 0.1], 40.0);
    let verdict = named(&body, &start, &settings("tensor"));
    let said = verdict.why.split("largest multiplier ").nth(1).unwrap().split(':').next().unwrap();
    let period = verdict.period.unwrap();
    let exact = divergence(&body, &start, period) * period; // -34.9
    near(said.parse::<f64>().unwrap().ln(), exact, 2e-3);
}

#[test]
fn the_hopf_circle_has_the_multiplier_of_its_normal_form() {
    let body = Hopf { mu: reference("hopf", "mu"), omega: reference("hopf", "omega") };
    let (radius, period) = (reference("hopf", "radius"), reference("hopf", "period"));
    let orbit =
        PeriodicOrbit::find(&body, &plain(&[1.05 * radius, 0.02], 1.03 * period), &FLOW, &()).unwrap();
    near(orbit.period(), period, 1e-10);
    near(orbit.shape[0].hypot(orbit.shape[1]), radius, 1e-10);
    near(orbit.multipliers[0].0, (-2.0 * body.mu * period).exp(), 1e-10);
    near(orbit.exponents()[0], -2.0 * body.mu, 1e-10);
}

#[test]
fn there_is_no_orbit_where_there_is_none() {
    let body = Hopf { mu: -0.3, omega: 2.0 };
    assert!(PeriodicOrbit::find(&body, &plain(&[0.5, 0.0], 3.1), &FLOW, &()).is_none());
}

/// The eigenvalues of a matrix, largest modulus first.
fn moduli(columns: &[Vec<f64>]) -> Vec<f64> {
    let dim = columns.len();
    let matrix = DMatrix::from_fn(dim, dim, |i, j| columns[j][i]);
    let mut values: Vec<f64> = matrix.complex_eigenvalues().iter().map(|z| z.re.hypot(z.im)).collect();
    values.sort_by(|a, b| b.total_cmp(a));
    values
}

/// Period from an independent program; multipliers against differences of the flow itself.
#[test]
fn the_zigzag_is_its_own_mirror_image_after_half_a_period() {
    let body = full(0.9, 0.1);
    let verdict = named(&body, &Random(1).state(6, 0.01), &settings("tensor"));
    assert_eq!(verdict.regime, Regime::Zigzag);
    near(verdict.period.unwrap(), 45.3131, 1e-4); // the digits of the independent value
    assert_eq!((verdict.net_rotation, verdict.turning_rate), (Some(0.0), Some(0.0)));

    let start = after(&body, &[-0.5, 0.001, 0.0, 0.0, 0.0, 0.0], 1400.0);
    let time = 0.5 * verdict.period.unwrap();
    let angle = align(&body, &after(&body, &start, time), &start, true).angle;
    let guess = PeriodicGuess { shape: &start, time, angle, mirrored: true };
    let orbit = PeriodicOrbit::find(&body, &guess, &FLOW, &()).unwrap();
    near(orbit.period(), verdict.period.unwrap(), 1e-7); // the verdict's tolerance: 1e-9 per step
    assert_eq!(orbit.multipliers.len(), 4);

    let h = 1e-5; // error h^2 and 1e-12/h
    let image = |u: &[f64]| {
        let mut out = after(&body, u, orbit.time);
        body.rotate(-orbit.angle, &mut out);
        body.mirror(&mut out);
        out
    };
    let column = |j: usize| {
        let (mut up, mut down) = (orbit.shape.clone(), orbit.shape.clone());
        up[j] += h;
        down[j] -= h;
        image(&up).iter().zip(image(&down)).map(|(a, b)| (a - b) / (2.0 * h)).collect::<Vec<f64>>()
    };
    let seen = moduli(&(0..6).map(column).collect::<Vec<_>>());
    println!("{seen:?} {:?}", orbit.multipliers);
    near(seen[0], 1.0, 1e-6); // time, and the rotation (mirrored: -1)
    near(seen[1], 1.0, 1e-6);
    for (seen, multiplier) in seen[2..].iter().zip(&orbit.multipliers) {
        near(multiplier.0.hypot(multiplier.1), *seen, 1e-6);
    }
    assert!(orbit.growth() < 1.0);
}

/// Five directions of 24: the rest is iterated. The period is that of the shape's size in a long run.
#[test]
fn the_zigzag_of_the_cell_by_newton_picard_has_the_period_of_a_long_run() {
    let body = cell(29.2, 16);
    let settings = settings("cell");
    let verdict = named(&body, &Random(5).state(32, 0.01), &settings);
    println!("{}", verdict.why);
    assert_eq!(verdict.regime, Regime::Zigzag);
    let mut orbit =
        settings.method.shape_orbit(&body, settings.control, 0.0, &Random(6).state(32, 0.01)).unwrap();
    drive(orbit.as_mut(), &Request::until(4000.0, 32), &mut ()).unwrap();
    let gauge = Gauge::of(&body);
    let rate = |_t: f64, u: &[f64]| gauge.rate(&body, u);
    let sections = [Section { g: &rate, direction: Direction::Rising, terminal: false }];
    let mut path = Trajectory::new(32);
    let request = Request { sections: &sections, ..Request::until(8000.0, 32) };
    drive(orbit.as_mut(), &request, &mut path).unwrap();
    let times: Vec<f64> = path.crossings().iter().map(|crossing| crossing.t).collect();
    let period = verdict.period.unwrap();
    // the size has a period of its own: a whole number of them is the motion's
    let last = *times.last().unwrap();
    let seen: Vec<f64> = times.iter().map(|t| (last - t) / period).collect();
    for turns in [1.0, 4.0, 10.0] {
        let nearest = seen.iter().map(|t| (t - turns).abs()).fold(f64::INFINITY, f64::min);
        // tolerance 1e-6 per step and the multiplier's memory of it
        assert!(nearest < 1e-4, "{nearest} of a period after {turns}");
    }
}
