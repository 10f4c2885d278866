//! The error of a mean covers the truth as often as it says, up to correlation times of 1/50 of the series; beyond, there is none.

use crate::samples::draws;
use motiform_analysis::{Error, series_mean, short_series_mean};
use motiform_dynamics::Normal;
use std::f64::consts::PI;

const SAMPLES: usize = 2000;

fn series_count() -> u64 {
    draws(1000, 4000)
}

/// AR(1) series x' = a x + sqrt(1 - a^2) xi, a = exp(-1/tau), around 3: stationary from the start.
fn series(tau: f64, stream: u64) -> Vec<f64> {
    series_of(SAMPLES, tau, stream)
}

fn series_of(samples: usize, tau: f64, stream: u64) -> Vec<f64> {
    let a = if tau > 0.0 { (-1.0 / tau).exp() } else { 0.0 };
    let mut normal = Normal::new(1963, stream);
    let mut x = normal.next();
    (0..samples)
        .map(|_| {
            x = a * x + (1.0 - a * a).sqrt() * normal.next();
            3.0 + x
        })
        .collect()
}

/// The share of series that have an error, the share of those whose interval covers the mean, and its mean half width against
/// that of the known spectrum, 1.96 sqrt((1 + a)/(1 - a) / n).
fn coverage(tau: f64) -> (f64, f64, f64) {
    let (mut known, mut covered, mut width) = (0.0, 0.0, 0.0);
    for stream in 0..series_count() {
        let seen = series_mean(&series(tau, stream)).expect("an estimate");
        if seen.has_error() {
            known += 1.0;
            covered += f64::from(u8::from(seen.covers(3.0)));
            width += seen.error;
        }
    }
    let a = if tau > 0.0 { (-1.0 / tau).exp() } else { 0.0 };
    let exact = 1.96 * ((1.0 + a) / (1.0 - a) / SAMPLES as f64).sqrt();
    (known / series_count() as f64, covered / known, width / known / exact)
}

#[test]
fn white_noise_is_covered_as_often_as_stated() {
    let (known, covered, width) = coverage(0.0);
    println!("white noise: {known} {covered} {width}");
    assert_eq!(known, 1.0);
    assert!((0.93..=0.985).contains(&covered), "{covered}");
    assert!((0.95..1.15).contains(&width), "{width}");
}

/// As often as stated, and not by being wide: twice the binomial scatter of 4000 series is 0.7 %, of 1000 series 1.4 %.
#[test]
fn correlated_series_are_covered_up_to_a_fiftieth_of_their_length() {
    for tau in [1.0, 4.0, 10.0, 20.0, 40.0] {
        let (known, covered, width) = coverage(tau);
        println!("correlation time {tau} of {SAMPLES}: {known} {covered} {width}");
        // of 4000 series .936 to .943 are
        let share = draws(0.91..=0.99, 0.93..=0.985);
        assert!(share.contains(&covered), "correlation time {tau}: {covered}");
        assert!((0.95..1.3).contains(&width), "correlation time {tau}: {width}");
        assert!(known > 0.9, "correlation time {tau}: {known}");
    }
}

/// Short records have an error whatever their correlation time, and not only those that look uncorrelated by chance: of the series of 100
/// samples and correlation time 12 [`series_mean`] keeps 7 %, and covers .57 of these.
#[test]
fn means_of_short_series_are_covered_whatever_their_correlation_time() {
    let shares = [
        (16, 0.3, 0.945),
        (60, 0.5, 0.925),
        (60, 5.0, 0.925),
        (100, 2.0, 0.93),
        (100, 12.0, 0.925),
        (300, 20.0, 0.935),
    ];
    for (samples, tau, least) in shares {
        let count = draws(1000, 4000);
        let seen = |stream| short_series_mean(&series_of(samples, tau, stream)).expect("an estimate");
        let errors: Vec<_> = (0..count).map(seen).collect();
        assert!(errors.iter().all(motiform_analysis::Estimate::has_error), "{samples} {tau}");
        let covered = errors.iter().filter(|mean| mean.covers(3.0)).count() as f64 / count as f64;
        println!("{samples} samples, correlation time {tau}: {covered}");
        // of 4000 series .94 to .965; twice the binomial scatter of 1000 is .014
        assert!((least..0.98).contains(&covered), "{samples} samples, correlation time {tau}: {covered}");
    }
    assert!(matches!(short_series_mean(&[1.0; 15]), Err(Error::TooFew { least: 16, got: 15, .. })));
}

/// A correlation time as long as the series cannot be told from a trend.
#[test]
fn most_series_that_are_too_short_have_no_error() {
    let (known, _, _) = coverage(2000.0);
    println!("with an error: {known}");
    assert!(known < 0.05, "{known}");
    for (what, shape) in [
        ("line", (|x| x) as fn(f64) -> f64),
        ("arc", |x| (2.0 * x).sin()),
        ("turn", |x| (2.0 * PI * x).cos()),
    ] {
        let smooth: Vec<f64> = (0..SAMPLES).map(|i| shape(i as f64 / SAMPLES as f64)).collect();
        assert!(!series_mean(&smooth).expect("an estimate").has_error(), "{what}");
    }
}

/// 64 samples +1, -1, +1, ...: the pairs of correlations are all 1/64, so tau is 1 and there are 64 / 4 = 16 cosines. Their sums
/// are 1/cos(pi j / 128) for odd j and 0 for even ones.
#[test]
fn a_series_computed_by_hand() {
    let series: Vec<f64> = (0..64).map(|i| if i % 2 == 0 { 1.0 } else { -1.0 }).collect();
    let seen = series_mean(&series).expect("an estimate");
    let squares: f64 = (1..16).step_by(2).map(|j| (PI * f64::from(j) / 128.0).cos().powi(-2)).sum();
    let error = 2.119_905_299_221 * (2.0 / 16.0 * squares).sqrt() / 64.0;
    assert_eq!(seen.value, 0.0);
    assert!((seen.error - error).abs() < 1e-12 * error, "{} {error}", seen.error);
}

/// Differences of a bounded series: the mean is off by its ends, and the error bounds that. It is small: not more than five
/// times what the ends usually differ by, over n.
#[test]
fn growth_that_is_bounded_has_an_error_like_its_ends() {
    let series = series_count();
    for tau in [0.0, 1.0, 4.0] {
        let (mut width, mut covered) = (0.0, 0);
        for stream in 0..series {
            let b = self::series(tau, stream);
            let steps: Vec<f64> = b.windows(2).map(|pair| pair[1] - pair[0]).collect();
            let seen = series_mean(&steps).expect("an estimate");
            covered += u64::from(seen.covers(0.0));
            width += seen.error * steps.len() as f64 / series as f64;
        }
        println!("{tau}: {covered} of {series}, half width times n: {width}");
        assert!(covered >= series - series / 1000, "{tau}: {covered}");
        assert!(width < 5.0 * 2.0_f64.sqrt(), "{tau}: {width}");
    }
}

#[test]
fn a_constant_has_no_error() {
    for value in [0.1, -1e300, 0.0] {
        for samples in [64, 1000, 1234] {
            let seen = series_mean(&vec![value; samples]).expect("an estimate");
            assert_eq!((seen.value, seen.error), (value, 0.0));
        }
    }
}

#[test]
fn bad_input_is_refused() {
    assert!(matches!(series_mean(&[1.0; 63]), Err(Error::TooFew { least: 64, got: 63, .. })));
    let mut series = vec![1.0; 100];
    series[17] = f64::NAN;
    assert!(matches!(series_mean(&series), Err(Error::NotFinite { index: 17, .. })));
    series[17] = 1e308;
    series[18] = -1e308;
    assert!(matches!(series_mean(&series), Err(Error::Overflow { .. })));
}
