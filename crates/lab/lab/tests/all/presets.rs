//! The presets show what they claim: the paper's motions, measured on their trajectories.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::common;

use common::{column, headings, polar, preset, run, tensor};
use motiform_dynamics::Outcome;
use motiform_store::table::same_bits;
use motiform_study::presets::PRESETS;
use motiform_study::{Dataset, RunPlan, Study};

#[test]
fn every_preset_plans_says_what_it_is_and_runs() {
    for known in PRESETS {
        let study = preset(known.name, |study| {
            (study.run.transient, study.run.t_end, study.run.dt_out) = (1.0, 5.0, 0.0);
        });
        assert!(study.about.ends_with('.') && study.about.matches(". ").count() <= 1, "{}", study.about);
        assert!(study.about.starts_with("Fig. ") && !study.title.is_empty(), "{}", known.name);
        for free in &study.free {
            assert!(study.parameters.iter().any(|(name, _)| name == free), "{}: {free}", known.name);
        }
        let dataset = run(&study);
        assert_eq!(dataset.manifest.outcome.outcome, Outcome::Completed { t: 5.0 }, "{}", known.name);
        assert_eq!(dataset.trajectory.rows(), 2001, "{}", known.name);
        RunPlan::new(&preset(known.name, |_| {})).unwrap();
    }
    assert_eq!(PRESETS.len(), 10);
}

/// Times at which the turning rate rises through zero (the heading is at its lowest), by linear interpolation.
fn lowest_headings(dataset: &Dataset) -> Vec<f64> {
    let (t, rate) = (column(dataset, "t"), column(dataset, "turning_rate"));
    let rises = (1..t.len()).filter(|&i| rate[i - 1] < 0.0 && rate[i] >= 0.0);
    rises.map(|i| t[i - 1] + (t[i] - t[i - 1]) * rate[i - 1] / (rate[i - 1] - rate[i])).collect()
}

/// The path that the README shows is that of every machine: a start that is its own mirror image to round-off
/// gives either of two, which depended on the tolerance.
#[test]
fn the_path_of_fig5a_does_not_depend_on_rounding() {
    let end = |rtol: f64, shift: f64| {
        let dataset = run(&preset("fig5a", |study| {
            study.run.rtol = rtol;
            study.set_initial("v2", -0.35 * (1.0 + shift)).unwrap();
        }));
        ["x", "y"].map(|name| *column(&dataset, name).last().unwrap())
    };
    let exact = end(1e-12, 0.0);
    for (rtol, shift) in [(1e-8, 0.0), (1e-9, 0.0), (1e-10, 0.0), (1e-9, 1e-7), (1e-9, -1e-7)] {
        let other = end(rtol, shift);
        let away = libm::hypot(other[0] - exact[0], other[1] - exact[1]);
        assert!(away < 1e-3, "rtol {rtol}, moved by {shift}: {away}");
    }
}

/// physics.md 1.2: the heading swings about 80 degrees peak to peak, with period about 45, and comes back to itself.
#[test]
fn fig5a_is_a_zigzag() {
    let dataset = run(&preset("fig5a", |study| study.run.t_end = 500.0));
    let lowest = lowest_headings(&dataset);
    assert!(lowest.len() >= 10, "{lowest:?}");
    for pair in lowest.windows(2) {
        assert!((pair[1] - pair[0] - 45.0).abs() < 3.0, "{lowest:?}");
    }
    let headings = headings(&dataset);
    let high = headings.iter().copied().fold(f64::MIN, f64::max);
    let low = headings.iter().copied().fold(f64::MAX, f64::min);
    assert!(((high - low).to_degrees() - 80.0).abs() < 5.0, "{} degrees", (high - low).to_degrees());

    // No net rotation: the heading at its lowest is stationary, so a row within dt/2 = 0.025 of that time shows it to
    // about (2 pi/45)^2 * 0.7 * 0.025^2 / 2 = 4e-6.
    let row = |t: f64| (t / 0.05).round() as usize;
    let turned = headings[row(*lowest.last().unwrap())] - headings[row(lowest[0])];
    assert!(turned.abs() < 1e-4, "turned by {turned:e} in {} periods", lowest.len() - 1);

    // It runs on, from left to right as in the paper.
    let (x, y) = (column(&dataset, "x"), column(&dataset, "y"));
    let (far, aside) = (x[x.len() - 1] - x[0], y[y.len() - 1] - y[0]);
    assert!(far > 0.5 * 500.0 * 0.9 && far > aside.abs(), "{far} {aside}");
}

/// Times and rows of the highest speed of each leg; times by the parabola through three rows.
fn legs(dataset: &Dataset) -> Vec<(f64, usize)> {
    let (t, speed) = (column(dataset, "t"), column(dataset, "speed"));
    let peak = |&i: &usize| speed[i] > 0.1 && speed[i] > speed[i - 1] && speed[i] >= speed[i + 1];
    let rows = (1..t.len() - 1).filter(peak);
    rows.map(|i| {
        let (before, at, after) = (speed[i - 1], speed[i], speed[i + 1]);
        (t[i] + 0.5 * (t[i + 1] - t[i]) * (before - after) / (before - 2.0 * at + after), i)
    })
    .collect()
}

/// Rests at a motionless ellipse, each longer than the last by |lambda_-|/lambda_+, lambda_pm = gamma +- 2 a1 r2 and
/// r2^2 = -kappa2/(8 b3), until round-off decides when a rest ends; in between straight legs at right angles.
#[test]
fn fig2_rests_grow_and_legs_meet_at_right_angles() {
    let study = preset("fig2", |study| study.run.t_end = 2500.0);
    let dataset = run(&study);
    let parameter = |name: &str| dataset.manifest.plan.computation.parameters.get(name).unwrap();
    let r2 = (-parameter("kappa2") / (8.0 * parameter("b3"))).sqrt();
    let (gamma, pull) = (parameter("gamma"), 2.0 * parameter("a1") * r2);
    let growth = (pull - gamma) / (pull + gamma);
    assert!((growth - 1.4357).abs() < 1e-4, "{growth}");

    let legs = legs(&dataset);
    assert!(legs.len() >= 8, "{legs:?}");
    // From leg to leg T -> growth * T + const, so the differences of T grow by exactly that factor once the legs are
    // alike; the first legs are not yet (they still differ by 1e-3 in speed).
    let periods: Vec<f64> = legs.windows(2).map(|pair| pair[1].0 - pair[0].0).collect();
    let factor = (periods[3] - periods[2]) / (periods[2] - periods[1]);
    assert!((factor / growth - 1.0).abs() < 0.01, "{factor} against {growth}; {periods:?}");
    let first = (periods[2] - periods[1]) / (periods[1] - periods[0]);
    assert!((first / growth - 1.0).abs() < 0.03, "{first} against {growth}; {periods:?}");
    // Without the floor the eighth would last growth^4 times the fourth: 800.
    assert!(periods[5..].iter().all(|&period| 200.0 < period && period < 300.0), "{periods:?}");

    let headings = headings(&dataset);
    let speed = column(&dataset, "speed");
    for pair in legs[1..].windows(2) {
        let turn = (headings[pair[1].1] - headings[pair[0].1]).to_degrees().rem_euclid(180.0);
        assert!((turn - 90.0).abs() < 1.0, "{turn} degrees");
        // At rest on the way: the speed falls by exp(-|lambda_-| t), here below 2e-4 of a leg's 0.3 at least.
        let rest = speed[pair[0].1..pair[1].1].iter().copied().fold(f64::MAX, f64::min);
        assert!(rest < 2e-4, "{rest}");
    }
    let stillest = speed.iter().copied().fold(f64::MAX, f64::min);
    assert!(stillest < 1e-10, "{stillest}");
}

/// A rosette in an annulus about the origin; its crossings lie on the segment, and are the same in every run.
#[test]
fn fig3_fills_an_annulus() {
    let study = preset("fig3", |study| study.run.t_end = 4000.0);
    let dataset = run(&study);
    assert!(
        column(&dataset, "turning_rate").iter().all(|&rate| rate > 0.0),
        "turns anticlockwise throughout"
    );
    let places = column(&dataset, "x").iter().zip(column(&dataset, "y"));
    let radii: Vec<f64> = places.map(|(x, y)| x.hypot(*y)).collect();
    assert!(radii.iter().all(|&r| 2.0 < r && r < 4.5));
    let crossings = dataset.crossings.as_ref().unwrap();
    assert!(crossings.rows() > 40, "{}", crossings.rows());
    assert!(crossings.get("y").unwrap().iter().all(|&y| (y - 3.0).abs() < 1e-12));
    assert!(crossings.get("x").unwrap().iter().all(|&x| -3.0 < x && x < 3.0));
    let again = run(&study);
    assert!(same_bits(crossings, again.crossings.as_ref().unwrap()));
    assert!(same_bits(&dataset.trajectory, &again.trajectory));
}

/// physics.md 1.1: 16 a1 r2^2 = b1 r1^2, r2^2 = (2 gamma - kappa2)/(32 a1/b1 + 8 b3), cos psi = (gamma - r1^2)/(2 a1 r2),
/// p1' = -2 a1 r2 sin psi, and the heading is -p1. (The preset's transient of 500 leaves 1e-7 of the way.)
#[test]
fn fig1_turns_in_circles_at_the_analytic_rate() {
    let dataset = run(&preset("fig1", |study| (study.run.transient, study.run.rtol) = (2000.0, 1e-12)));
    let parameter = |name: &str| dataset.manifest.plan.computation.parameters.get(name).unwrap();
    let (gamma, kappa2) = (parameter("gamma"), parameter("kappa2"));
    let (a1, b1, b3) = (parameter("a1"), parameter("b1"), parameter("b3"));
    let r2 = ((2.0 * gamma - kappa2) / (32.0 * a1 / b1 + 8.0 * b3)).sqrt();
    let r1 = (16.0 * a1 / b1).sqrt() * r2;
    let cos = (gamma - r1 * r1) / (2.0 * a1 * r2);
    let (_, _, psi) = polar(&dataset);
    assert!((psi.cos() - cos).abs() < 1e-8, "{psi}");
    let rate = 2.0 * a1 * r2 * (1.0 - cos * cos).sqrt() * psi.signum();
    for (&turning, &speed) in column(&dataset, "turning_rate").iter().zip(column(&dataset, "speed")) {
        assert!((turning - rate).abs() < 1e-8, "{turning} against {rate}");
        assert!((speed - r1).abs() < 1e-8, "{speed} against {r1}");
    }
}

/// The state at the end of `study`, as a start.
fn restart(study: &Study, dataset: &Dataset) -> Study {
    let mut next = study.clone();
    next.initial.clone_from(&dataset.manifest.state.0);
    next
}

/// Two starts 1e-8 apart, on the attractor: chaos is that they part. With lambda_1 ~ 0.09 (physics.md 1.2) the distance
/// grows by about e^18 in this time; a factor of 1000 leaves room for a slow stretch.
#[test]
fn fig5b_forgets_its_start() {
    let mut study = preset("fig5b", |study| (study.run.t_end, study.run.rtol) = (1.0, 1e-12));
    study = restart(&study, &run(&study));
    (study.run.transient, study.run.t_end) = (0.0, 200.0);
    let mut near = study.clone();
    near.set_initial("v1", study.initial[0].1 + 1e-8).unwrap();
    let (one, other) = (run(&study), run(&near));
    let names = tensor().coordinates(&[]).iter().map(|c| c.name);
    let apart = |row: usize| -> f64 {
        let differences = names.clone().map(|name| column(&one, name)[row] - column(&other, name)[row]);
        differences.map(|d| d * d).sum::<f64>().sqrt()
    };
    assert!((apart(0) / 1e-8 - 1.0).abs() < 1e-6, "{:e}", apart(0));
    let furthest = (0..one.trajectory.rows()).map(apart).fold(0.0, f64::max);
    println!("1e-8 grew to {furthest:.1e} within t = 200");
    assert!(furthest > 1e3 * 1e-8, "{furthest:e}");
    assert!(column(&one, "speed").iter().all(|&speed| speed < 10.0));
}
