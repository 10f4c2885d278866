//! The likelihood against independent formulas.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{Experiment, diagonal, four, full};
use motiform_inference::{Library, Observation, Parameters, Scales, Settings, Track, likelihood};
use nalgebra::DMatrix;

/// The centre's own noise, that of the contour being 0.004.
const CENTRE: f64 = 0.006;

#[test]
fn gradient_by_differences() {
    let three = || full(0.5, 0.1);
    for (equations, modes, handed, rate) in [
        (three(), 2, false, None),
        (three(), 2, false, Some(1.5)),
        (three(), 3, false, None),
        (three(), 3, true, None),
        (three(), 3, true, Some(0.3)),
        (four(), 4, false, None),
        (four(), 4, true, None),
    ] {
        let mut track = Experiment { frames: 20, ..Experiment::new(equations, 0.05, 11) }.track();
        track.0.remove(8);
        track.0.drain(13..16);
        let library = Library::new(modes, 3).unwrap();
        let settings = Settings { library, handed, ..Settings::default() };
        let n = settings.library.terms.len() * if handed { 2 } else { 1 };
        // so small that no step is divided on one side of a difference alone
        let size = 0.1;
        let coefficients = (0..n).map(|i| size * libm::sin(i as f64 + 1.0)).collect();
        let at = Parameters { coefficients, s: 1.3, eta_v: 0.08, rate, eta_shape: 0.06, centre: CENTRE };
        let logs = n + usize::from(rate.is_some());
        let value = |at: &Parameters| likelihood(&[track.clone()], &settings, at).unwrap();
        let exact = value(&at);
        for i in 0..logs + 4 {
            let moved = |by: f64| {
                let mut at = at.clone();
                match i.checked_sub(logs) {
                    None if i < n => at.coefficients[i] += by,
                    // the coefficient is -k
                    None => at.rate = at.rate.map(|rate| rate - by),
                    Some(0) => at.s *= libm::exp(by),
                    Some(1) => at.eta_v *= libm::exp(by),
                    Some(2) => at.eta_shape *= libm::exp(by),
                    // l = ln sqrt(centre^2/c + 0.01)
                    Some(_) => {
                        let c = Scales::of(std::slice::from_ref(&track), modes).centre;
                        let square = (CENTRE * CENTRE / c + 0.01) * libm::exp(2.0 * by) - 0.01;
                        at.centre = (c * square).sqrt();
                    }
                }
                value(&at).value.unwrap()
            };
            let h = 1e-4;
            let slope = |h: f64| (moved(h) - moved(-h)) / (2.0 * h);
            let difference = (4.0 * slope(h) - slope(2.0 * h)) / 3.0;
            let size = exact.information[i][i].sqrt();
            assert!(
                (difference - exact.gradient[i]).abs() < 1e-6 * size,
                "{handed} {rate:?} {i}: {difference} {exact:?}"
            );
        }
    }
}

/// Log-density of a Gaussian vector.
fn gaussian(deviations: &[f64], covariance: DMatrix<f64>) -> f64 {
    let n = deviations.len();
    let cholesky = covariance.cholesky().unwrap();
    let y = nalgebra::DVector::from_column_slice(deviations);
    let determinant: f64 = (0..n).map(|i| 2.0 * libm::log(cholesky.l_dirty()[(i, i)])).sum();
    -0.5 * (y.dot(&cholesky.solve(&y)) + determinant + n as f64 * libm::log(std::f64::consts::TAU))
}

/// Relaxation at rate k under noise: covariance of deviations from the mean at two times after a start of variance `p`.
fn relaxing(k: f64, eta: f64, p: f64, (t, u): (f64, f64)) -> f64 {
    let decayed = libm::exp(-k * (t + u));
    p * decayed + eta * eta / (2.0 * k) * (libm::exp(-k * (t - u).abs()) - decayed)
}

/// The integral of such a process: `int_0^min (1 - e^(-k (t - w))) (1 - e^(-k (u - w)))/k^2 dw` for the noise.
fn integrated(k: f64, eta: f64, (p, start): (f64, f64), (t, u): (f64, f64)) -> f64 {
    let grown = |t: f64| (1.0 - libm::exp(-k * t)) / k;
    let end = t.min(u);
    let tail = |t: f64| (libm::exp(-k * (t - end)) - libm::exp(-k * t)) / k;
    let both = (libm::exp(-k * (t + u - 2.0 * end)) - libm::exp(-k * (t + u))) / (2.0 * k);
    start + p * grown(t) * grown(u) + eta * eta / (k * k) * (end - tail(t) - tail(u) + both)
}

/// Linear equations: all observations together are one Gaussian vector, whose mean and covariance have closed forms.
#[test]
fn linear_equations_exactly() {
    let mut normal = motiform_dynamics::Normal::new(77, 0);
    let times = [0.0, 0.1, 0.2, 0.35, 0.4, 0.5, 0.8, 0.9, 1.0, 1.1];
    let errors = [0.05, 0.06, 0.04, 0.03, 0.05, 0.02, 0.03, 0.04];
    let frame = |&t: &f64| Observation {
        t,
        y: errors
            .iter()
            .enumerate()
            .map(|(i, e)| 0.3 * libm::cos(t + i as f64) + e * normal.next())
            .collect(),
        covariance: diagonal(&errors),
    };
    let track = Track(times.iter().map(frame).collect());
    for (modes, rate) in [(2, None), (3, None), (4, None), (2, Some(2.0)), (3, Some(30.0))] {
        let (found, expected) = linear(&track, &times, &errors[..2 * modes], rate);
        println!("{modes} {rate:?} {found} {expected}");
        let close = (found - expected).abs() < 1e-5 * expected.abs().max(1.0);
        assert!(close, "{modes} {rate:?} {found} {expected}");
    }
}

/// The path `x'' = -k x' + w` of a relaxing velocity under noise with a memory, `w' = -rate w + eta W'`: covariance of deviations from the
/// mean at two times, after a start of `w` of variance `p`. The response of x to a kick of w is `g`.
fn driven([k, rate]: [f64; 2], eta: f64, p: f64, (t, u): (f64, f64)) -> f64 {
    let grown = |k: f64, t: f64| (1.0 - libm::exp(-k * t)) / k;
    let g = |t: f64| (grown(k, t) - grown(rate, t)) / (rate - k);
    let (end, panels) = (t.min(u), 400);
    let h = end / f64::from(panels);
    let weight = |i: i32| if i == 0 || i == panels { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
    let at = |i: i32| weight(i) * g(t - f64::from(i) * h) * g(u - f64::from(i) * h);
    p * g(t) * g(u) + eta * eta * h / 3.0 * (0..=panels).map(at).sum::<f64>()
}

/// Log-likelihood of relaxing modes, and its closed form.
fn linear(track: &Track, times: &[f64], errors: &[f64], memory: Option<f64>) -> (f64, f64) {
    let modes = errors.len() / 2;
    let names = ["z1: z1", "z2: z2", "z3: z3", "z4: z4"];
    let library = Library::new(modes, 1).unwrap().select(&names[..modes]).unwrap();
    let settings = Settings { library, ..Settings::default() };
    let (k, s, eta) = ([0.7, 1.1, 0.4, 0.9], 1.3, [0.5, 0.4]);
    let coefficients = k[..modes].iter().map(|k| -k).collect();
    let centre = 0.07;
    let at = Parameters { coefficients, s, eta_v: eta[0], rate: memory, eta_shape: eta[1], centre };
    let found = likelihood(std::slice::from_ref(track), &settings, &at).unwrap().value.unwrap();
    let scales = Scales::of(std::slice::from_ref(track), modes);
    let n = times.len() - 1;
    let mut expected = 0.0;
    for i in 0..errors.len() {
        let rate = k[i / 2];
        let (first, second) = (&track.0[0], &track.0[1]);
        let jitter = if i < 2 { centre * centre } else { 0.0 };
        let noise = s * s * errors[i] * errors[i] + jitter;
        // the start: docs of the filter, natural units
        let (speed, dt) = (scales.amplitudes[0], (second.t - first.t) / scales.time);
        let v = (second.y[i] - first.y[i]) / (second.t - first.t);
        let p = 8.0 * errors[i] * errors[i] / libm::pow(second.t - first.t, 2.0)
            + speed * speed * ((dt * dt).min(1.0) + 0.01);
        let mean = |t: f64| match i {
            0 | 1 => first.y[i] + v * (1.0 - libm::exp(-rate * t)) / rate,
            _ => first.y[i] * libm::exp(-rate * t),
        };
        let covariance = DMatrix::from_fn(n, n, |a, b| {
            let at = (times[a + 1], times[b + 1]);
            let own = if a == b { noise } else { 0.0 };
            own + match i {
                0 | 1 => match memory {
                    None => integrated(rate, eta[0], (p, noise), at),
                    // the start of w: 1 in natural units
                    Some(memory) => {
                        let w = s * speed / scales.time;
                        integrated(rate, 0.0, (p, noise), at) + driven([rate, memory], eta[0], w * w, at)
                    }
                },
                _ => relaxing(rate, eta[1], noise, at),
            }
        });
        let deviations: Vec<f64> = (1..=n).map(|a| track.0[a].y[i] - mean(times[a])).collect();
        expected += gaussian(&deviations, covariance);
    }
    (found, expected)
}

/// A rate is one more unknown, and the field has four.
#[test]
fn a_memory_beside_four_modes_is_refused() {
    let track = Experiment { frames: 20, ..Experiment::new(four(), 0.05, 11) }.track();
    let settings = Settings { library: Library::new(4, 1).unwrap(), ..Settings::default() };
    let coefficients = vec![0.1; settings.library.terms.len()];
    let at = Parameters { coefficients, s: 1.0, eta_v: 0.1, rate: Some(1.0), eta_shape: 0.1, centre: 0.0 };
    let refused = likelihood(&[track], &settings, &at).unwrap_err().to_string();
    assert!(refused.contains("rate") && refused.contains("at most three modes"), "{refused}");
}
