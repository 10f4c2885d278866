//! The error of batch means covers the truth as often as it says, up to correlation times of 1/50 of the series.

use motiform_analysis::{Error, batch_means};
use motiform_dynamics::Normal;

const SAMPLES: usize = 2000;
const SERIES: u64 = 1000;

/// Share of AR(1) series x' = a x + sqrt(1 - a^2) xi + mean (1 - a), a = exp(-1/tau), whose interval covers the mean.
fn coverage(tau: f64) -> f64 {
    let (mean, a) = (3.0, if tau > 0.0 { (-1.0 / tau).exp() } else { 0.0 });
    let mut covered = 0.0;
    for stream in 0..SERIES {
        let mut normal = Normal::new(1963, stream);
        let mut x = normal.next(); // stationary from the start
        let series: Vec<f64> = (0..SAMPLES)
            .map(|_| {
                x = a * x + (1.0 - a * a).sqrt() * normal.next();
                mean + x
            })
            .collect();
        covered += f64::from(u8::from(batch_means(&series).expect("an estimate").covers(mean)));
    }
    covered / SERIES as f64
}

#[test]
fn white_noise_is_covered_as_often_as_stated() {
    let seen = coverage(0.0);
    println!("white noise: {seen}");
    assert!((0.93..=0.985).contains(&seen), "{seen}");
}

#[test]
fn correlated_series_are_covered_up_to_a_fiftieth_of_their_length() {
    for tau in [1.0, 4.0, 10.0, 20.0, 40.0] {
        let seen = coverage(tau);
        println!("correlation time {tau} of {SAMPLES}: {seen}");
        assert!(seen >= 0.93, "correlation time {tau}: {seen}");
    }
}

/// 64 samples in which the batches of 8 have the means 0 and 1 in turn: k = 8 has the width
/// t_7 sqrt(8 (1/2)^2 / (8 7)) = 2.3646 sqrt(1/28), larger than those of 16 and 32.
#[test]
fn a_series_computed_by_hand() {
    let series: Vec<f64> = (0..64).map(|j| f64::from((j / 8) % 2)).collect();
    let seen = batch_means(&series).expect("an estimate");
    assert_eq!(seen.value, 0.5);
    assert!((seen.error - 2.364_624_251_592_784 / 28.0_f64.sqrt()).abs() < 1e-15, "{}", seen.error);
}

#[test]
fn a_constant_has_no_error() {
    for value in [0.1, -1e300, 0.0] {
        for samples in [64, 1000, 1234] {
            let seen = batch_means(&vec![value; samples]).expect("an estimate");
            assert_eq!((seen.value, seen.error), (value, 0.0));
        }
    }
}

#[test]
fn bad_input_is_refused() {
    assert!(matches!(batch_means(&[1.0; 63]), Err(Error::TooFew { least: 64, got: 63, .. })));
    let mut series = vec![1.0; 100];
    series[17] = f64::NAN;
    assert!(matches!(batch_means(&series), Err(Error::NotFinite { index: 17, .. })));
    series[17] = 1e308;
    series[18] = -1e308;
    assert!(matches!(batch_means(&series), Err(Error::Overflow { .. })));
}
