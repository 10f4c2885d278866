//! Rests of series whose rests are known.

use motiform_analysis::{Error, Rest, rests};

/// |t - 4 n| for the nearest n: 0 at multiples of 4, 2 half way between.
fn sawtooth(t: f64) -> f64 {
    (t - 4.0 * (t / 4.0).round()).abs()
}

#[test]
fn a_sawtooth_rests_half_the_time() {
    let times: Vec<f64> = (0..=80).map(|j| 0.25 * f64::from(j)).collect();
    let sizes: Vec<f64> = times.iter().map(|t| sawtooth(*t)).collect();
    let seen = rests(&times, &sizes, 0.5).expect("rests");
    // below 1 within distance 1 of 0, 4, ..., 20; those at 0 and 20 are incomplete
    let want: Vec<Rest> = (1..5).map(|n| Rest { start: 4.0 * f64::from(n) - 1.0, duration: 2.0 }).collect();
    assert_eq!((seen.threshold, &seen.rests), (1.0, &want));
    assert_eq!(seen.ratios(), [1.0; 3]);
    assert!(seen.growth().is_empty());
}

#[test]
fn thresholds_between_samples_are_met_on_the_line() {
    let seen = rests(&[0.0, 1.0, 2.0, 4.0], &[4.0, 0.0, 0.0, 4.0], 0.25).expect("rests");
    assert_eq!(seen.rests, [Rest { start: 0.75, duration: 1.75 }]);
}

#[test]
fn growing_rests_have_their_ratio() {
    // pulses of width 0.2 with gaps that grow by 1.5
    let pulses: Vec<f64> = (0..10)
        .scan(0.0, |t, n| {
            *t += 1.5_f64.powi(n);
            Some(*t)
        })
        .collect();
    let times: Vec<f64> = (0..120_000).map(|j| 1e-3 * f64::from(j)).collect();
    let near = |t: f64| pulses.iter().map(|p| (t - p).abs()).fold(f64::INFINITY, f64::min);
    let sizes: Vec<f64> = times.iter().map(|t| (1.0 - near(*t) / 0.1).max(0.0)).collect();
    let seen = rests(&times, &sizes, 0.5).expect("rests");
    assert_eq!(seen.rests.len(), 9);
    for (n, rest) in (1..10).zip(&seen.rests) {
        // a gap less one pulse at half height (0.1); maxima are met to a sample
        assert!((rest.duration - (1.5_f64.powi(n) - 0.1)).abs() < 3e-3, "{rest:?}");
    }
    assert!((seen.ratios()[7] - 1.5).abs() < 1e-2);
    assert!(seen.growth().iter().skip(2).all(|growth| (growth - 1.5).abs() < 1e-2), "{:?}", seen.growth());
}

#[test]
fn bad_input_is_refused() {
    let times = [0.0, 1.0, 2.0, 3.0];
    let sizes = [0.0, 1.0, 0.0, 1.0];
    assert!(matches!(rests(&times, &sizes[..3], 0.5), Err(Error::Shape { expected: 4, got: 3, .. })));
    assert!(matches!(rests(&times[..2], &sizes[..2], 0.5), Err(Error::TooFew { .. })));
    assert!(matches!(rests(&[0.0, 2.0, 2.0, 3.0], &sizes, 0.5), Err(Error::Order { index: 2, .. })));
    assert!(matches!(rests(&times, &[0.0, 1.0, -1.0, 2.0], 0.5), Err(Error::OutOfRange { .. })));
    assert!(matches!(rests(&times, &[f64::NAN; 4], 0.5), Err(Error::NotFinite { .. })));
    assert!(matches!(rests(&times, &[1.0; 4], 0.5), Err(Error::Constant { .. })));
    for fraction in [0.0, 1.0, f64::NAN] {
        assert!(matches!(rests(&times, &sizes, fraction), Err(Error::OutOfRange { .. })));
    }
}
