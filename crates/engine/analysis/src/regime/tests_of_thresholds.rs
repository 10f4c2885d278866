//! The thresholds of chaos, tori and stays from both sides. Evidence is made by hand, just inside and just outside; that the
//! classifier gathers it rightly is asked in tests/.

use super::chaos::{Witness, chaotic, torus};
use super::growth::{Growth, in_motion};
use super::stay::Stay;
use crate::series_mean::mean_over;
use crate::{Estimate, Lyapunov};
use motiform_dynamics::Outcome;

const INTERVALS: usize = 640;

/// Noise of mean zero, whose error scales with its size.
fn noise(count: usize) -> Vec<f64> {
    let raw: Vec<f64> = (0..count).map(|i| (1.3 * i as f64 + 0.7 * (i * i % 97) as f64).sin()).collect();
    let mean = raw.iter().sum::<f64>() / count as f64;
    raw.into_iter().map(|x| x - mean).collect()
}

/// A run over `time` whose exponent is `value`, in `count` equal intervals with growth rates `value + size noise`.
fn run(value: f64, size: f64, time: f64) -> Lyapunov {
    let step = time / INTERVALS as f64;
    let rates: Vec<f64> = noise(INTERVALS).into_iter().map(|x| value + size * x).collect();
    let error = mean_over(&rates, &vec![step; INTERVALS]).map_or(0.0, |mean| mean.error);
    Lyapunov {
        exponents: vec![Estimate { value, error }],
        widened: false,
        neutral: 0,
        silent: Vec::new(),
        history: rates.iter().zip(1..).map(|(&rate, i)| (step * f64::from(i), vec![rate])).collect(),
        reduced_speeds: vec![1.0; INTERVALS],
        time,
        transient: 0.0,
        outcome: Outcome::Completed { t: time },
        shape: vec![0.0],
    }
}

fn witness(zero_one: f64, dimension: f64, stationary: bool) -> Witness {
    Witness {
        zero_one: Some(zero_one),
        dimension: Some(dimension),
        stationary: Some(stationary),
        returns: 1000,
    }
}

/// The error of two such runs, pooled, for noise of size 1.
fn pooled_error() -> f64 {
    let rates = [noise(INTERVALS), noise(INTERVALS)].concat();
    mean_over(&rates, &vec![1.0; 2 * INTERVALS]).map_or(0.0, |mean| mean.error)
}

/// Returns `true` if two runs in a row, pooled, are chaos: `ratio` is the exponent over its error, `growth`
/// the logarithm of the growth in both.
fn is_chaos(ratio: f64, growth: f64, zero_one: f64) -> bool {
    let (value, time) = (0.01, 0.5 * growth / 0.01);
    let one = run(value, value / (ratio * pooled_error()), time);
    let runs: Vec<Growth> = [time, 2.0 * time].into_iter().filter_map(|end| Growth::of(&one, end)).collect();
    matches!(chaotic(&runs, &one, &witness(zero_one, 1.5, true), 2.0 * time), Ok(Some(_)))
}

/// lambda_1 above three of its errors; a 0-1 test that sees order (K < 0.3) asks for 1.3 times as much and does not overrule.
#[test]
fn chaos_needs_more_than_its_error_and_more_where_a_witness_doubts() {
    for (zero_one, least) in [(0.9, 3.0), (0.31, 3.0), (0.29, 3.9), (-0.1, 3.9)] {
        assert!(is_chaos(1.01 * least, 100.0, zero_one), "{zero_one}");
        assert!(!is_chaos(0.99 * least, 100.0, zero_one), "{zero_one}");
    }
}

/// Growth by e^10 is beyond a power of time; a witness for order asks for e^13.
#[test]
fn chaos_needs_growth_beyond_a_power_of_time() {
    for (zero_one, least) in [(0.9, 10.0), (0.1, 13.0)] {
        assert!(is_chaos(100.0, 1.01 * least, zero_one), "{zero_one}");
        assert!(!is_chaos(100.0, 0.99 * least, zero_one), "{zero_one}");
    }
}

/// One run alone may see a transient; runs that disagree are not pooled; the last must be positive by itself.
#[test]
fn chaos_needs_two_runs_that_agree() {
    let verdict = |runs: &[Lyapunov]| {
        let ends = (1..).map(|i| 1e3 * f64::from(i));
        let growth: Vec<Growth> =
            runs.iter().zip(ends).filter_map(|(run, end)| Growth::of(run, end)).collect();
        chaotic(&growth, runs.last()?, &witness(0.9, 1.5, true), 1e3 * runs.len() as f64).ok().flatten()
    };
    let strong = run(0.1, 0.01, 1e3);
    assert!(verdict(std::slice::from_ref(&strong)).is_none());
    assert!(verdict(&[strong.clone(), strong.clone()]).is_some());
    assert!(verdict(&[strong.clone(), run(0.0, 0.01, 1e3)]).is_none());
    assert!(verdict(&[run(0.9, 0.01, 1e3), strong]).is_none());
}

/// Returns on a curve: dimension 0.8 to 1.2.
#[test]
fn a_torus_has_returns_of_dimension_one() {
    let still = run(0.0, 1e-6, 1e3);
    let is_torus = |dimension| torus(&still, &witness(0.0, dimension, true), 1e3).is_some();
    assert!([0.8, 0.81, 1.0, 1.19].into_iter().all(is_torus));
    assert!(![0.5, 0.79, 1.2, 1.21, 2.0].into_iter().any(is_torus));
}

/// A set that shrinks or drifts is no torus, whatever its dimension; nor is one that too few returns were seen of.
#[test]
fn a_torus_stays_as_it_is() {
    let still = run(0.0, 1e-6, 1e3);
    let seen = witness(0.0, 1.0, true);
    assert!(torus(&still, &seen, 1e3).is_some());
    assert!(torus(&still, &witness(0.0, 1.0, false), 1e3).is_none());
    for less in [
        Witness { stationary: None, ..seen },
        Witness { dimension: None, ..seen },
        Witness { zero_one: None, ..seen },
    ] {
        assert!(torus(&still, &less, 1e3).is_none());
    }
}

/// An exponent beyond twice its error is not zero. Where the 0-1 test does not see order (K > 0.3), the
/// distance of neighbouring orbits may not have grown by more than the number of returns (here e^6.9), error
/// included.
#[test]
fn a_torus_has_an_exponent_of_zero() {
    let unit = {
        let rates = noise(INTERVALS);
        mean_over(&rates, &vec![1.0; INTERVALS]).map_or(0.0, |mean| mean.error)
    };
    let is_torus = |value: f64, error: f64, zero_one: f64| {
        torus(&run(value, error / unit, 1e3), &witness(zero_one, 1.0, true), 1e3).is_some()
    };
    assert!(is_torus(0.0019, 0.001, 0.0) && !is_torus(0.0021, 0.001, 0.0));
    assert!(is_torus(0.0, 0.0068, 0.9) && !is_torus(0.0, 0.0070, 0.9));
    assert!(is_torus(0.0, 0.0070, 0.29) && !is_torus(0.0, 0.0070, 0.31));
}

/// An orbit stays for good if the smallest deviation that a double can hold, e^-1500 of the shape's size, would have grown to that
/// size meanwhile; an orbit that moves begins a new stay.
#[test]
fn a_stay_lasts_once_every_deviation_would_have_shown() {
    let growth = 0.1;
    assert!(!Stay::default().goes_on(14_990.0, true, growth));
    assert!(Stay::default().goes_on(15_010.0, true, growth));
    let mut stay = Stay::default();
    assert!(!stay.goes_on(10_000.0, true, growth));
    assert!(!stay.goes_on(10_000.0, false, growth));
    assert!(!stay.goes_on(10_000.0, true, growth));
    assert!(stay.goes_on(5_010.0, true, growth));
}

/// A run that rests for 40 % of the time, ten times, and whose tangent vector becomes shorter by `e^-fall` in one rest and longer again.
fn resting(fall: f64) -> Lyapunov {
    let (time, rests) = (640.0, 10);
    let mut all = run(0.0, 0.0, time);
    let period = INTERVALS / rests;
    for (i, entry) in all.history.iter_mut().enumerate() {
        let part = i % period;
        let rate = fall / 8.0;
        entry.1[0] = if part < 8 {
            -rate
        } else if part < 16 {
            rate
        } else {
            0.0
        };
        all.reduced_speeds[i] = if part < 2 * period / 5 { 1e-3 } else { 1.0 };
    }
    all
}

/// In a run that rests, an exponent that is left of falls by more than e^-12 is no measure of chaos; without rests it is.
#[test]
fn an_exponent_that_is_left_of_larger_numbers_is_not_used() {
    assert!(in_motion(&resting(11.9), 0.01, 1.0).is_ok());
    assert!(
        in_motion(&resting(12.1), 0.01, 1.0).is_err_and(|none| none.cancels && none.why.contains("e^-12"))
    );
    let mut awake = resting(12.1);
    awake.reduced_speeds.fill(1.0);
    assert!(in_motion(&awake, 0.01, 1.0).is_ok());
}
