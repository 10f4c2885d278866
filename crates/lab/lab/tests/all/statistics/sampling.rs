//! Simulated bodies that are sampled too coarsely, or from the beginning on: against exact values.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_lab::statistics::simulated;
use motiform_statistics::{Answer, Measured, Settings, Statistics};
use motiform_study::Study;

fn seen(text: &str, bodies: usize) -> Statistics {
    let study = Study::parse(text, "text", "test").unwrap();
    simulated(&study, bodies, &Settings::default(), 2, &()).unwrap().statistics
}

fn holds(found: Measured, exact: f64) -> bool {
    (found.value - exact).abs() <= 1.6 * found.half_width()
}

/// Velocities that turn with the period 1.013 and forget in 20.
fn turning(dt: f64) -> Statistics {
    seen(
        &format!(
            "[model.amplitudes]\nmodes = [1]\n[model.amplitudes.equations]\nz1 = \"-(0.05 + 6.2*i)*z1\"\n\
             [model.amplitudes.noise]\nz1 = \"0.4\"\n[run]\ntransient = 100\nt_end = 400\ndt_out = {dt}"
        ),
        40,
    )
}

/// Once a period, they look like a slow walk: D 8.5 for 0.00208, frequency 0.013 for 0.987.
#[test]
fn what_turns_once_between_samples_has_no_times() {
    for dt in [0.5, 1.0, 1.02] {
        let found = turning(dt);
        let velocity = &found.autocorrelations[0];
        let told = velocity.time.reason().unwrap();
        assert!(told.contains("record at least every 0.08 (dt_out)"), "{told}");
        let frequency = velocity.oscillation.as_ref().map(|found| &found.frequency);
        assert!(frequency.is_none_or(|frequency| frequency.known().is_none()));
        assert!(found.diffusion.green_kubo.known().is_none());
        assert!(found.spectra.iter().all(|found| found.quantity.name() != "velocity"));
    }
    let found = turning(0.05);
    let frequency = found.autocorrelations[0].oscillation.as_ref().unwrap().frequency.known().unwrap();
    assert!(holds(frequency, 6.2 / std::f64::consts::TAU), "{frequency:?}");
}

/// Speed of a chaotic body without noise: its stays above and below the median, whatever the time between samples.
#[test]
fn stays_of_a_smooth_motion_are_those_of_finer_samples() {
    let stays = |dt: f64| -> [Answer; 2] {
        let found = seen(&format!("preset = \"fig5b\"\n[run]\nt_end = 2000\ndt_out = {dt}"), 20).residence;
        [found.above, found.below].map(|side| side.time.unwrap().mean)
    };
    let fine = stays(0.1).map(|answer| answer.known().unwrap());
    for dt in [1.0, 2.0] {
        for (fine, coarse) in fine.iter().zip(stays(dt)) {
            let coarse = coarse.known().unwrap();
            assert!((coarse.value / fine.value - 1.0).abs() < 0.01, "{dt}: {coarse:?} {fine:?}");
        }
    }
    assert!(stays(4.0).iter().all(|answer| answer.known().is_none()));
}

/// Stationary density of the speed: v exp(-2 (v^4/4 - v^2/2)/eta^2).
fn mean_speed(eta: f64) -> f64 {
    let weight = |v: f64| v * (-(0.5 * v.powi(4) - v * v) / (eta * eta) - 0.5 / (eta * eta)).exp();
    let moment =
        |power: i32| (1..4000).map(|k| 5e-4 * f64::from(k)).map(|v| v.powi(power) * weight(v)).sum::<f64>();
    moment(1) / moment(0)
}

/// The preset starts near rest: its transient leaves that out; without it the record is not stationary, in any unit.
#[test]
fn a_start_at_rest_is_left_out_or_said() {
    let preset = "preset = \"noisy-heading\"\n[run]\nt_end = 400\ndt_out = 0.5";
    let found = seen(preset, 60);
    assert_eq!(found.not_stationary, None);
    assert!(holds(found.mean_speed, mean_speed(0.2)), "{:?} {}", found.mean_speed, mean_speed(0.2));
    let from_rest = seen(&format!("{preset}\ntransient = 0"), 60);
    assert!(from_rest.not_stationary.unwrap().contains("(transient)"));
    let small = "[model.amplitudes]\nmodes = [1]\n[model.amplitudes.equations]\nz1 = \"-0.02*z1\"\n\
                 [model.amplitudes.noise]\nz1 = \"1e-6\"\n[run]\nt_end = 10000\ndt_out = 5";
    assert!(seen(small, 20).not_stationary.is_some());
    assert_eq!(seen(&format!("{small}\ntransient = 1000"), 20).not_stationary, None);
}

/// The speed |x + c| of x' = -k x + s dW/dt far from 0, with these values as defaults of the equations, or set beside others.
fn walker(k: f64, set: bool, (t_end, dt): (f64, f64)) -> Statistics {
    let value = |given: f64, default: f64| match set {
        true => format!("{{ value = {given:?}, default = {default:?} }}"),
        false => format!("{given:?}"),
    };
    let [k, s, c] =
        [(k, 1.0), (k, 1.0), (20.0 * k.sqrt(), 20.0)].map(|(given, default)| value(given, default));
    seen(
        &format!(
            "[model.amplitudes]\nmodes = [2]\nsymmetry = \"none\"\nvelocity = \"re(z2) + c\"\n[model.amplitudes.parameters]\n\
             k = {k}\ns = {s}\nc = {c}\n[model.amplitudes.equations]\nz2 = \"-k*z2\"\n[model.amplitudes.noise]\nz2 = \"s\"\n\
             [run]\ntransient = {}\nt_end = {t_end}\ndt_out = {dt}",
            0.1 * t_end
        ),
        24,
    )
}

/// A Gaussian process with the correlation exp(-k t) that is looked at every dt stays on one side for dt pi / arccos(exp(-k dt)).
#[test]
fn stays_under_noise_are_those_of_the_samples_however_the_rates_are_given() {
    for (k, times) in [(1.0, (20.0, 0.001)), (1.0, (60.0, 0.05)), (1e4, (6e-3, 5e-6)), (1e-4, (6e5, 500.0))] {
        for set in [false, true] {
            let found = walker(k, set, times).residence;
            let exact = times.1 * std::f64::consts::PI / (-k * times.1).exp().acos();
            for side in [found.above, found.below] {
                let mean = side.time.unwrap().mean.known().unwrap();
                assert!(holds(mean, exact), "k {k}, dt {}, set {set}: {mean:?}, exact {exact}", times.1);
            }
        }
    }
}
