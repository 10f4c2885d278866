//! Welch's method against Parseval's theorem, sines of known amplitude, white noise and SciPy.

use motiform_analysis::{Error, welch};
use proptest::prelude::*;
use serde::Deserialize;
use std::f64::consts::TAU;

/// Uniform in [-1/2, 1/2), exact in double precision: x_(n+1) = 1664525 x_n + 1013904223 mod 2^32, over 2^32.
/// Source: Numerical Recipes, 2nd ed., sec. 7.1 ("quick and dirty").
fn noise(seed: u32, count: usize) -> Vec<f64> {
    let step = |x: &u32| Some(x.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
    let states = std::iter::successors(Some(seed), step).skip(1);
    states.take(count).map(|x| f64::from(x) / 4_294_967_296.0 - 0.5).collect()
}

#[derive(Deserialize)]
struct Reference {
    case: Vec<Case>,
}

/// A spectrum that SciPy computed.
#[derive(Deserialize)]
struct Case {
    seed: u32,
    samples: usize,
    dt: f64,
    segment: usize,
    frequencies: Vec<f64>,
    power: Vec<f64>,
}

#[test]
fn agrees_with_scipy() {
    let text = include_str!("../../../../../reference/welch.toml");
    let reference: Reference = toml::from_str(text).expect("the reference file");
    assert_eq!(reference.case.len(), 4);
    for case in reference.case {
        let seen = welch(&noise(case.seed, case.samples), case.dt, case.segment).expect("a spectrum");
        let close = |got: &[f64], want: &[f64]| {
            assert_eq!(got.len(), want.len());
            for (k, (g, w)) in got.iter().zip(want).enumerate() {
                assert!((g - w).abs() <= 1e-12 * w.abs(), "segment {}, k = {k}: {g} {w}", case.segment);
            }
        };
        close(&seen.frequencies, &case.frequencies);
        close(&seen.power, &case.power);
    }
}

proptest! {
    /// One segment: the integral is exactly the variance weighted by the squared window.
    #[test]
    fn parseval(seed: u32, segment in 4..200usize, dt in 1e-3..1e3f64) {
        let x = noise(seed, segment);
        let mean = x.iter().sum::<f64>() / segment as f64;
        let weight = |j: usize| (0.5 - 0.5 * (TAU * j as f64 / segment as f64).cos()).powi(2);
        let above: f64 = x.iter().enumerate().map(|(j, v)| weight(j) * (v - mean).powi(2)).sum();
        let variance = above / (0..segment).map(weight).sum::<f64>();
        let spectrum = welch(&x, dt, segment).expect("a spectrum");
        let total = spectrum.variance_between(0.0, f64::INFINITY);
        // rounding of two sums of 200 terms and of a transform: 1e-12 leaves two digits
        prop_assert!((total - variance).abs() <= 1e-12 * variance.max(1e-3), "{} {}", total, variance);
    }
}

#[test]
fn a_sine_carries_half_its_squared_amplitude() {
    let (amplitude, dt, segment, cycles) = (3.0, 0.05, 400, 25.0);
    let frequency = cycles / (400.0 * dt);
    let x: Vec<f64> =
        (0..2000).map(|j| 7.0 + amplitude * (TAU * frequency * dt * f64::from(j) + 0.3).sin()).collect();
    let spectrum = welch(&x, dt, segment).expect("a spectrum");
    assert_eq!(spectrum.segments, 9);
    let largest = (0..spectrum.power.len()).max_by(|a, b| spectrum.power[*a].total_cmp(&spectrum.power[*b]));
    assert_eq!(largest, Some(25));
    // the Hann window spreads whole cycles over three lines and no further
    let (df, half) = (spectrum.spacing(), amplitude * amplitude / 2.0);
    let peak = spectrum.variance_between(frequency - 1.5 * df, frequency + 1.5 * df);
    assert!((peak - half).abs() < 1e-11 * half, "{peak}");
    assert!((spectrum.variance_between(0.0, f64::INFINITY) - half).abs() < 1e-11 * half);
}

#[test]
fn white_noise_is_flat_and_its_integral_is_the_variance() {
    let (dt, count) = (0.25, 200_000);
    let spectrum = welch(&noise(2026, count), dt, 256).expect("a spectrum");
    let variance = 1.0 / 12.0; // uniform
    // standard error of a variance: sqrt(kurtosis - 1) / sqrt(n) = 0.9/447 = 0.2 %; five of them
    assert!((spectrum.variance_between(0.0, f64::INFINITY) / variance - 1.0).abs() < 0.01);
    // each line: 1/sqrt(1561 segments) = 2.5 %, a little more by overlap; six of them
    for p in &spectrum.power[2..128] {
        assert!((p / (2.0 * dt * variance) - 1.0).abs() < 0.18, "{p}");
    }
}

#[test]
fn a_constant_has_no_power() {
    let spectrum = welch(&[2.5; 64], 1.0, 16).expect("a spectrum");
    assert!(spectrum.power.iter().all(|p| *p == 0.0));
    assert_eq!((spectrum.power.len(), spectrum.segments), (9, 7));
}

#[test]
fn bad_input_is_refused_with_the_remedy() {
    let message = |x: &[f64], dt, segment| welch(x, dt, segment).expect_err("an error").to_string();
    assert_eq!(
        message(&[1.0; 9], 1.0, 10),
        "9 samples do not fill a segment of 10; sample a longer run, or shorten the segment"
    );
    assert_eq!(
        message(&[1.0, 2.0, f64::NAN, 0.0], 1.0, 4),
        "sample number 2 is NaN; cut the samples before it, or where the quantity is undefined"
    );
    for dt in [0.0, -0.1, f64::NAN, f64::INFINITY] {
        assert!(message(&[1.0; 9], dt, 4).contains("give the positive model time between two samples"));
    }
    assert!(message(&[1.0; 9], 1.0, 3).ends_with("choose at least 4"));
    assert!(matches!(welch(&[], 1.0, 4), Err(Error::TooShort { samples: 0, segment: 4 })));
    let huge: Vec<f64> = noise(1, 64).iter().map(|x| x * 1e200).collect();
    assert!(message(&huge, 1.0, 16).contains("cut the run where it escapes"));
}
