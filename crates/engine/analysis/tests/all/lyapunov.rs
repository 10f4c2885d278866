//! Lyapunov exponents against exact and published values, and against a method that knows no tangent flow.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;
use crate::samples::draws;

use common::{Random, cell, full, near, reduced};
use motiform_analysis::lyapunov::separates;
use motiform_analysis::{Estimate, Lyapunov, LyapunovSettings, lyapunov, lyapunov_followed, series_mean};
use motiform_dynamics::steppers::{DOP853, Method};
use motiform_dynamics::{Equivariant, Integration, Orbit, Outcome, Request, StepControl, drive::drive};
use motiform_models::tensor::Tensor;
use motiform_models::zoo::{Hopf, Linear, Lorenz, Rossler, Torus};

fn settings(count: usize, transient: f64, span: f64) -> LyapunovSettings {
    LyapunovSettings {
        count,
        method: Method::Explicit(&DOP853),
        control: StepControl::Adaptive { rtol: 1e-9, atol: 1e-12 },
        transient,
        span,
        escape_norm: 1e6,
        max_steps: 100_000_000,
    }
}

fn run<B: Equivariant>(body: &B, start: &[f64], settings: &LyapunovSettings) -> Lyapunov {
    lyapunov(body, start, settings, &()).unwrap()
}

fn published(system: &str) -> (Vec<f64>, f64) {
    let all: toml::Table = include_str!("../../../../../reference/zoo.toml").parse().unwrap();
    let list = all[system]["exponents"].as_array().unwrap();
    (list.iter().map(|x| x.as_float().unwrap()).collect(), all[system]["tolerance"].as_float().unwrap())
}

fn agree(seen: &[Estimate], want: &[f64], tolerance: f64) {
    println!("{seen:?}, expected {want:?}");
    assert_eq!(seen.len(), want.len());
    for (s, w) in seen.iter().zip(want) {
        assert!((s.value - w).abs() <= s.error + tolerance, "{s:?} is not {w}");
    }
}

/// Within the first stretches such vectors become parallel to the last digit, and lose their directions; in lanes too
/// (kernels/tests/all/exponent_lanes.rs).
#[test]
fn rates_that_differ_by_hundreds_are_all_found() {
    let body = Linear { rows: [[-0.1, 3.0, 0.0], [0.0, -60.0, 1.0], [0.0, 0.0, -700.0]] };
    let seen = run(&body, &[1.0, 1.0, 1.0], &settings(3, 10.0, 40.0));
    agree(&seen.exponents, &[-0.1, -60.0, -700.0], 0.0);
    assert!(seen.exponents.iter().all(|x| x.error < 1e-2), "{seen:?}");

    // without a transient, the length of stretches is found while averages are taken, which begin again
    let seen = run(&body, &[1.0, 1.0, 1.0], &settings(3, 0.0, 40.0));
    agree(&seen.exponents, &[-0.1, -60.0, -700.0], 1e-2);
    assert!((seen.time - 40.0).abs() < 1e-9, "{seen:?}");
}

/// Real eigenvalues, and a pair -0.1 +- 2 i, in a matrix that is not normal.
#[test]
fn a_linear_flow_has_the_real_parts_of_its_eigenvalues() {
    let body = Linear { rows: [[-0.5, 3.0, 0.0], [0.0, -0.2, 1.0], [0.0, 0.0, -1.5]] };
    let seen = run(&body, &[1.0, 1.0, 1.0], &settings(3, 100.0, 400.0));
    agree(&seen.exponents, &[-0.2, -0.5, -1.5], 0.0);
    assert!(seen.exponents.iter().all(|x| x.error < 1e-5), "{seen:?}");

    let spiral = Linear { rows: [[-0.1, -4.0, 5.0], [1.0, -0.1, 2.0], [0.0, 0.0, -0.7]] };
    let seen = run(&spiral, &[1.0, 0.0, 1.0], &settings(3, 100.0, 2000.0));
    agree(&seen.exponents, &[-0.1, -0.1, -0.7], 0.0);
    assert!(seen.exponents.iter().all(|x| x.error < 2e-2), "{seen:?}");

    // an unstable one at its fixed point, where it stays
    let unstable = Linear { rows: [[0.3, 1.0], [0.0, -1.0]] };
    agree(&run(&unstable, &[0.0, 0.0], &settings(2, 50.0, 200.0)).exponents, &[0.3, -1.0], 0.0);
}

#[test]
fn cycles_and_tori_have_their_exact_exponents() {
    let (want, tolerance) = published("hopf");
    agree(
        &run(&Hopf { mu: 0.3, omega: 2.0 }, &[0.5, 0.1], &settings(2, 100.0, 500.0)).exponents,
        &want,
        tolerance,
    );
    let (want, tolerance) = published("torus");
    let seen = run(&Torus::default(), &[0.9, 0.0, 0.0, 1.1], &settings(4, 100.0, 1000.0));
    agree(&seen.exponents, &want, tolerance);
}

/// Sprott's values; their sum is the divergence -(sigma + 1 + beta), which is the same everywhere.
#[test]
fn lorenz_has_its_published_exponents_and_their_exact_sum() {
    let body = Lorenz::default();
    let seen = run(&body, &[1.0, 1.0, 20.0], &settings(3, 50.0, 3000.0));
    let (want, tolerance) = published("lorenz");
    agree(&seen.exponents, &want, tolerance);
    assert!(seen.exponents[0].error < 0.02);
    let sum: f64 = seen.exponents.iter().map(|x| x.value).sum();
    near(sum, -(body.sigma + 1.0 + body.beta), 1e-6); // 1e-9 per step, some 50 steps per time unit
    assert_eq!(seen.neutral, 1);
    assert!(seen.zeros()[0].covers(0.0));
    // Sprott (2003), app. A: 2.0621
    let dimension = seen.dimension().unwrap();
    near(dimension.value, 2.0621, dimension.error + 1e-4);
    assert!(dimension.error < 2e-3 && seen.exponents[..2].iter().all(|x| x.value > -0.5), "{dimension:?}");
    let few = run(&body, &[1.0, 1.0, 20.0], &settings(2, 50.0, 300.0));
    assert_eq!(few.dimension(), None, "the sum of two exponents is not negative");
}

#[test]
fn rossler_has_its_published_exponents() {
    let seen = run(&Rossler::default(), &[1.0, 1.0, 0.0], &settings(3, 200.0, 10_000.0));
    let (want, tolerance) = published("rossler");
    agree(&seen.exponents, &want, tolerance);
    assert!(seen.exponents[0].error < 0.01);
}

/// 95 % errors: of 100 independent runs (100 time units each, some 130 turns), at least 90 cover the published value. They
/// are cautious, for a run this short by a factor of 5: growth along Lorenz's orbit makes up for itself from turn to turn,
/// so that means over short batches scatter by their ends.
#[test]
fn errors_cover_the_truth_as_often_as_they_say() {
    let mut random = Random(1963);
    let truth = published("lorenz").0[0];
    let mut start = || [random.between(-10.0, 10.0), random.between(-10.0, 10.0), random.between(15.0, 35.0)];
    let mut seen = || run(&Lorenz::default(), &start(), &settings(1, 20.0, 100.0)).exponents[0];
    let runs: Vec<Estimate> = (0..100).map(|_| seen()).collect();
    let covered = runs.iter().filter(|estimate| estimate.covers(truth)).count();
    let mean_square =
        |part: fn(&Estimate, f64) -> f64| runs.iter().map(|x| part(x, truth).powi(2)).sum::<f64>() / 100.0;
    let (off, error) = (mean_square(|x, truth| x.value - truth).sqrt(), mean_square(|x, _| x.error).sqrt());
    println!("{covered} of 100; off by {off}, errors {error}");
    assert!(covered >= 90, "{covered} of 100: errors are too small");
    assert!(error < 12.0 * off, "errors of {error} say nothing about {off}");
}

/// The share of many runs whose intervals cover `truth`, or their own mean; and the width of the intervals
/// against 1.96 times the scatter.
fn coverage(runs: &[Estimate], truth: Option<f64>) -> (f64, f64) {
    let n = runs.len() as f64;
    let truth = truth.unwrap_or_else(|| runs.iter().map(|x| x.value).sum::<f64>() / n);
    let covered = runs.iter().filter(|x| x.has_error() && x.covers(truth)).count();
    let scatter = (runs.iter().map(|x| (x.value - truth).powi(2)).sum::<f64>() / n).sqrt();
    let width = (runs.iter().map(|x| x.error * x.error).sum::<f64>() / n).sqrt();
    (covered as f64 / n, width / (1.96 * scatter))
}

/// The errors of chaotic runs are 95 % errors, and not by being wide: 0.92 to 0.985 leaves two standard errors of 160 runs (1.7 %)
/// on either side of 0.95. Those of the zeros are bounds: every run is covered.
#[test]
fn errors_of_chaos_are_sharp() {
    let lorenz = |seed| {
        let mut random = Random(seed);
        let start = [random.between(-10.0, 10.0), random.between(-10.0, 10.0), random.between(15.0, 35.0)];
        run(&Lorenz::default(), &start, &settings(1, 20.0, 1000.0)).exponents[0]
    };
    let starts = draws(60, 160);
    let lorenz: Vec<Estimate> = (0..starts).map(lorenz).collect();
    let mut seen = vec![("lorenz", coverage(&lorenz, Some(published("lorenz").0[0])))];
    for (name, kappa2, kappa3) in [("(.5, .1)", 0.5, 0.1), ("(.63, .11)", 0.63, 0.11)] {
        let model = full(kappa2, kappa3);
        let runs: Vec<Lyapunov> = (0..starts)
            .map(|seed| run(&model, &Random(seed).state(6, 0.01), &settings(3, 300.0, 1500.0)))
            .filter(|run| run.outcome.is_complete())
            .collect();
        let firsts: Vec<Estimate> = runs.iter().map(|run| run.exponents[0]).collect();
        seen.push((name, coverage(&firsts, None)));
        let zeros: Vec<Estimate> = runs.iter().flat_map(Lyapunov::zeros).collect();
        let (covered, width) = coverage(&zeros, Some(0.0));
        println!("{name}: zeros {covered}, {width} times too wide; {} of {starts} runs", runs.len());
        assert!(covered > draws(0.98, 0.99) && width < 4.0, "{name}: zeros {covered} {width}");
    }
    // of 60 runs less than 51 are covered with a probability of 3e-4, and the scatter has an error of a tenth
    for (name, (covered, width)) in seen {
        println!("{name}: {covered}, width {width}");
        assert!(
            draws(0.85..=1.0, 0.92..=0.985).contains(&covered)
                && draws(0.75..1.5, 0.9..1.25).contains(&width),
            "{name}: {covered} {width}"
        );
    }
}

/// Averages over less than a turn, or over an instant of which only round-off is seen, are too short for an
/// error and have none.
#[test]
fn short_averages_have_no_error() {
    let model = full(0.5, 0.1);
    for span in [1e-9, 1e-4, 0.01, 1.0, 5.0] {
        let seen = run(&model, &Random(1).state(6, 0.01), &settings(1, 0.0, span));
        println!("{span}: {:?} {:?}", seen.exponents, seen.without_error());
        assert!(!seen.exponents[0].has_error() && seen.exponents[0].value.is_finite(), "{span}");
        assert!(seen.without_error().is_some_and(|why| why.contains("too short")), "{span}");
    }
    let seen = run(&model, &Random(1).state(6, 0.01), &settings(1, 200.0, 1000.0));
    assert!(seen.exponents[0].has_error() && seen.without_error().is_none());
}

/// A short run that still approaches a stable circular motion has the zero of the rotations alone: its flow
/// decays like everything else. The slowest rate is .164, so it ends at e^-10 of its size from the motion.
#[test]
fn a_run_that_settles_has_no_neutral_direction_along_its_flow() {
    for (transient, span) in [(30.0, 30.0), (40.0, 25.0), (200.0, 200.0)] {
        let seen = run(&full(0.5, 0.5), &Random(1).state(6, 0.3), &settings(6, transient, span));
        assert_eq!(seen.neutral, 1, "after {transient}: {:?}", seen.exponents);
    }
}

/// A run is counted by the motion that it ends on: a circle has no neutral direction, an ellipse at rest and straight motion that of the
/// rotations alone, however small the velocity has become, and whether they are stable or the start has their symmetry. Growth rates of the
/// circle: -kappa2 and gamma.
#[test]
fn neutral_directions_are_those_of_the_motion_that_a_run_ends_on() {
    let general = Random(1).state(6, 0.01);
    for (kappa2, gamma, start, neutral) in [
        (0.1, -0.05, general.clone(), 0),
        (-0.2, -0.4, general.clone(), 1),
        (0.18, 0.1, general.clone(), 1),
        (0.02, 0.05, general.clone(), 1),
        (-0.1, -0.04, vec![0.0, 0.0, 0.0, 0.0, 0.1, 0.0], 0),
        (-0.1, -0.04, vec![0.0, 0.0, 0.1, 0.0, 0.0, 0.0], 1),
        (-0.14, 0.05, general, 2),
    ] {
        for (transient, span) in [(300.0, 300.0), (600.0, 2000.0)] {
            let seen = run(&reduced(kappa2, gamma), &start, &settings(6, transient, span));
            assert_eq!(seen.neutral, neutral, "{kappa2} {gamma} {transient}: {:?}", seen.exponents);
            let zeros = seen.exponents.iter().filter(|one| one.covers(0.0)).count();
            assert_eq!(zeros, neutral, "{kappa2} {gamma} {transient}: {:?}", seen.exponents);
        }
    }
    for (length, neutral) in [(6.0, 0), (9.0, 1), (16.0, 1)] {
        let body = cell(length, 12);
        let methods = common::settings("cell");
        let settings = LyapunovSettings {
            method: methods.method,
            control: methods.control,
            ..settings(2, 2000.0, 500.0)
        };
        let seen = run(&body, &Random(2).state(24, 0.01), &settings);
        assert_eq!(seen.neutral, neutral, "{length}: {:?}", seen.exponents);
    }
}

/// The rule for a positive exponent on both sides of each of its limits: three errors, and a growth by e^10
/// in all and by e^3.58 in each run.
#[test]
fn a_positive_exponent_needs_three_errors_and_growth_beyond_powers_of_time() {
    let one = |value, error| Estimate { value, error };
    assert!(separates(one(0.031, 0.01), 1e4, 1, 1.0) && !separates(one(0.029, 0.01), 1e4, 1, 1.0));
    assert!(separates(one(0.01, 1e-4), 1010.0, 1, 1.0) && !separates(one(0.01, 1e-4), 990.0, 1, 1.0));
    assert!(separates(one(0.01, 1e-4), 3600.0, 10, 1.0) && !separates(one(0.01, 1e-4), 3550.0, 10, 1.0));
    assert!(!separates(one(0.031, 0.01), 1e4, 1, 1.3) && !separates(one(f64::NAN, 0.01), 1e4, 1, 1.0));
    let chaos = run(&full(0.5, 0.1), &Random(1).state(6, 0.01), &settings(1, 300.0, 2000.0));
    let order = run(&full(0.9, 0.1), &Random(1).state(6, 0.01), &settings(1, 3000.0, 2000.0));
    assert!(chaos.separates() && !order.separates(), "{:?} {:?}", chaos.exponents, order.exponents);
}

/// Chaos has two zeros: along the flow, and along the rotations.
#[test]
fn both_neutral_directions_of_a_chaotic_body_vanish_within_their_errors() {
    let tensor = run(&full(0.5, 0.1), &Random(1).state(6, 0.01), &settings(3, 500.0, 4000.0));
    let methods = common::settings("cell");
    let slow = LyapunovSettings {
        method: methods.method,
        control: methods.control,
        ..settings(3, 6000.0, 12_000.0) // errors of zeros are then a tenth of the exponent
    };
    let cell = run(&cell(21.6, 21), &Random(5).state(42, 0.01), &slow);
    for (name, seen) in [("tensor", &tensor), ("cell", &cell)] {
        println!("{name}: {:?}", seen.exponents);
        assert_eq!(seen.neutral, 2);
        assert!(seen.exponents[0].value > 2.0 * seen.exponents[0].error);
        for zero in seen.zeros() {
            assert!(zero.covers(0.0), "{name}: {zero:?}");
            assert!(zero.error < 0.2 * seen.exponents[0].value, "{name}: {zero:?}");
        }
    }
}

/// lambda_1 from two orbits a distance of 1e-7 apart, brought back to it every `EVERY`: Benettin, Galgani, Strelcyn (1976),
/// Phys. Rev. A 14, 2338. `None` if one escapes.
fn two_orbits(model: &Tensor, start: &[f64], transient: f64, span: f64) -> Option<Estimate> {
    const APART: f64 = 1e-7;
    const EVERY: f64 = 5.0;
    let control = StepControl::Adaptive { rtol: 1e-11, atol: 1e-13 };
    let mut orbit = Orbit::new(model, &DOP853, control, 0.0, start).unwrap();
    let first = drive(&mut orbit, &Request::until(0.5 * transient, 6), &mut ()).unwrap();
    let mut beside = orbit.state().to_vec();
    beside[0] += APART;
    let mut rates = Vec::new();
    let mut ended: Outcome = first;
    let mut other = Orbit::new(model, &DOP853, control, orbit.t(), &beside).unwrap();
    while ended.is_complete() && orbit.t() < transient + span {
        let t = orbit.t() + EVERY;
        ended = drive(&mut orbit, &Request::until(t, 6), &mut ()).unwrap();
        if !drive(&mut other, &Request::until(t, 6), &mut ()).unwrap().is_complete() {
            return None;
        }
        let step: Vec<f64> = other.state().iter().zip(orbit.state()).map(|(a, b)| a - b).collect();
        let length = step.iter().map(|x| x * x).sum::<f64>().sqrt();
        if t > transient {
            rates.push((length / APART).ln() / EVERY);
        }
        let back: Vec<f64> = orbit.state().iter().zip(&step).map(|(a, b)| a + b * APART / length).collect();
        other.restart(&back);
    }
    ended.is_complete().then(|| series_mean(&rates).unwrap())
}

#[test]
fn the_tensor_model_has_the_exponents_of_two_nearby_orbits() {
    for kappa2 in [0.35, 0.5, 0.6, 0.7] {
        let model = full(kappa2, 0.1);
        // transient chaos at small kappa2: the first seeds that last
        let mut starts = (1..40).map(|seed| Random(seed).state(6, 0.01));
        let tangent = starts
            .by_ref()
            .map(|start| run(&model, &start, &settings(1, 500.0, 4000.0)))
            .find(|seen| seen.outcome.is_complete());
        let tangent = tangent.unwrap().exponents[0];
        let orbits = starts.find_map(|start| two_orbits(&model, &start, 500.0, 4000.0)).unwrap();
        println!("{kappa2}: {tangent:?} {orbits:?}");
        let error = tangent.error.hypot(orbits.error);
        assert!((tangent.value - orbits.value).abs() <= error, "{kappa2}: {tangent:?} {orbits:?}");
        assert!(tangent.value > 2.0 * tangent.error);
    }
}

/// At kappa2 = kappa3 = 0.1 every orbit blows up.
#[test]
fn a_run_that_escapes_has_no_exponents() {
    let seen = run(&full(0.1, 0.1), &Random(1).state(6, 0.01), &settings(2, 100.0, 20_000.0));
    assert!(matches!(seen.outcome, Outcome::Escaped { singular: true, .. }), "{:?}", seen.outcome);
    assert!(seen.exponents.is_empty());
}

/// Looking on changes nothing, and what is seen ends in the result.
#[test]
fn a_run_that_is_followed_is_the_same_run() {
    let settings = settings(3, 20.0, 400.0);
    let start = [1.0, 1.0, 20.0];
    let alone = run(&Lorenz::default(), &start, &settings);
    let mut seen = Vec::new();
    let followed = lyapunov_followed(&Lorenz::default(), &start, &settings, &(), &mut |so_far| {
        seen.push((so_far.time(), so_far.exponents()));
    });
    assert_eq!(followed.unwrap(), alone);
    assert_eq!(seen.len(), alone.history.len());
    assert!(seen.windows(2).all(|pair| pair[0].0 < pair[1].0));
    let (time, last) = seen.pop().unwrap();
    assert!((time - alone.time).abs() < 1e-9);
    for (seen, result) in last.unwrap().iter().zip(&alone.exponents) {
        assert_eq!(seen.value.to_bits(), result.value.to_bits());
        assert!(seen.error <= result.error);
    }
}

/// Rates that are immense against the time of the average: there is no end, and no endless loop either.
#[test]
fn immense_rates_end_with_a_word() {
    let body = cell(0.1, 3);
    let settings = LyapunovSettings {
        count: 6,
        method: Method::find("krogstad4").unwrap(),
        control: StepControl::Adaptive { rtol: 1e-6, atol: 1e-7 },
        transient: 100.0,
        span: 1000.0,
        escape_norm: 1e6,
        max_steps: 1_000_000,
    };
    let found = lyapunov(&body, &[0.1; 6], &settings, &()).unwrap();
    assert!(matches!(found.outcome, Outcome::StepBudget { .. }), "{:?}", found.outcome);
    assert!(found.exponents.is_empty());
}
