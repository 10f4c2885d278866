//! An oscillating correlation as what it is: a frequency and a decay.

use crate::damped::{Damped, deviation, fit};
use crate::estimate::Estimate;
use crate::plateau::Curves;
use crate::{Answer, in_unit};
use serde::Serialize;
use std::f64::consts::TAU;

/// Largest deviation of a damped cosine from the correlation, as a part of it (root mean squares).
const MISFIT: f64 = 0.1;

/// A correlation oscillates where it goes down to this value, by more than its error.
const NEGATIVE: f64 = -0.05;

/// The phase that harmonics and the ends of a record may shift over the longest lag (radians): no frequency is known better.
const PHASE: f64 = 0.01;

/// Part of the amplitude that is lost over the lags, below which nothing is.
const UNDIMINISHED: f64 = 1e-3;

/// Shortest period in samples: with fewer, a slower one cannot be told from a faster one.
const SHORTEST: f64 = 5.0;

/// A damped oscillation of a correlation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Oscillation {
    /// Cycles per model time.
    pub frequency: Answer,
    /// Time in which the amplitude falls to 1/e.
    pub decay: Answer,
    /// Frequency, and rate of decay, of the damped cosine that is nearest, whether or not it describes the correlation.
    pub nearest: [f64; 2],
    /// Deviation of the damped cosine from the correlation, as a part of it (root mean squares), less what is chance.
    pub deviation: f64,
}

/// The damped cosine `e^{-lambda tau} (a cos omega tau + b sin omega tau)` that is nearest to rho(tau) over
/// lags up to `last`, by least squares; `None` where rho does not oscillate: it does not go below -0.05 by
/// more than its error, or forgets within a radian (omega < lambda).
///
/// Intervals: by leaving out groups and fitting again, on logarithms. No frequency is known better than to a
/// hundredth of a radian over these lags. Unknown are both where the damped cosine deviates by more than 10 %, and the decay where the
/// amplitude does not fall to 1/e within these lags. Both are unknown for the reason `coarse`, if given: what is forgotten between samples
/// is not seen, and without it the rest is another one.
///
/// # Checked by  tests/all/oscillation.rs: chiral active Brownian motion, circle, exponential; coverage in crate measure
pub(crate) fn oscillation(curves: &Curves, last: usize, coarse: Option<String>) -> Option<Oscillation> {
    let all = ratios(&curves.values[0], last);
    let lowest = lowest(&all)?;
    if all[lowest] + curves.ratio(lowest).half_width() > NEGATIVE {
        return None;
    }
    let best = fit(&all, &starts(lowest))?;
    if best.omega < best.lambda {
        return None;
    }
    let squares: f64 = all.iter().map(|rho| rho * rho).sum();
    let errors: f64 = (1..=last).map(|lag| 0.25 * curves.ratio(lag).half_width().powi(2)).sum();
    let misfit = deviation(&all, &best);
    let deviation = (misfit * misfit - errors / squares).max(0.0).sqrt();
    let [frequency, decay] = match coarse.or_else(|| refusal(&best, deviation)) {
        Some(reason) => [Answer::unknown(&reason), Answer::unknown(reason)],
        None => measured(curves, last, &best, misfit),
    };
    let nearest = [best.omega / (TAU * curves.dt), best.lambda / curves.dt];
    Some(Oscillation { frequency, decay, nearest, deviation })
}

/// rho of a curve up to a lag.
fn ratios(curve: &[f64], last: usize) -> Vec<f64> {
    curve[..=last].iter().map(|c| c / curve[0]).collect()
}

/// The reason why the nearest damped cosine does not describe the correlation, if it does not.
fn refusal(best: &Damped, deviation: f64) -> Option<String> {
    if deviation > MISFIT {
        return Some(format!("not as one damped cosine (deviation {:.0} %)", 100.0 * deviation));
    }
    let coarse = "sampled too coarsely: a period has fewer than 5 samples; record more often";
    (best.omega * SHORTEST > TAU).then(|| coarse.to_owned())
}

/// Frequency and decay with their intervals: what every other sample changes, and what is changed without the first decay time, is in
/// them as far as it is more than chance (as in [`Estimate`]). A correlation of more than one part has the slowest one alone at late lags.
///
/// A misfit of the part d, what is chance in it included, may be one of the decay: another rate of decay, by the factor 1 + 2 d, deviates
/// by d from the nearest cosine of this one (times have the standard deviation 1/(2 lambda) under the weight e^{-2 lambda tau}).
fn measured(curves: &Curves, last: usize, best: &Damped, misfit: f64) -> [Answer; 2] {
    let [fine, coarse] = [1, 2].map(|step| fits(curves, last, best, 0, step));
    let first = (1.0 / best.lambda).min(last as f64 / 3.0) as usize;
    let late = fits(curves, last, best, first, 1);
    let of = |value: &dyn Fn(&Damped) -> f64| {
        let values = |found: &[Option<Damped>]| -> Vec<f64> {
            found.iter().map(|found| found.as_ref().map_or(f64::NAN, value)).collect()
        };
        let others = vec![values(&coarse), values(&late)];
        Estimate { values: values(&fine), others, coarser: None, room: f64::INFINITY, slow: None }.answer("")
    };
    let resolution = PHASE / (TAU * last as f64 * curves.dt);
    let frequency = of(&|found| found.omega / (TAU * curves.dt)).at_least(resolution);
    if best.lambda * last as f64 > 1.0 {
        return [frequency, of(&|found| curves.dt / found.lambda).or_by_the_factor(1.0 + 2.0 * misfit)];
    }
    let lags = in_unit(last as f64 * curves.dt, &curves.unit);
    let reason = match best.lambda * (last as f64) < UNDIMINISHED {
        true => format!("not reached: the oscillation goes on undiminished up to the longest lag {lags}"),
        false => format!("not reached: the oscillation goes on at the longest lag {lags}; record longer"),
    };
    [frequency, Answer::unknown(reason)]
}

/// The nearest damped cosine of all groups and without each, from a lag on and from every `step`-th sample; per sample of the first one.
fn fits(curves: &Curves, last: usize, best: &Damped, from: usize, step: usize) -> Vec<Option<Damped>> {
    let times = step as f64;
    let start = best.at(from as f64);
    let start = Damped { lambda: times * start.lambda, omega: times * start.omega, ..start };
    let of = |curve: &Vec<f64>| {
        let every: Vec<f64> = ratios(curve, last).into_iter().skip(from).step_by(step).collect();
        let found = fit(&every, &[start])?;
        Some(Damped { lambda: found.lambda / times, omega: found.omega / times, ..found })
    };
    curves.values.iter().map(of).collect()
}

/// The lag of the lowest value.
fn lowest(values: &[f64]) -> Option<usize> {
    (1..values.len()).min_by(|a, b| values[*a].total_cmp(&values[*b]))
}

/// Half a period is about the lag of the minimum.
fn starts(lowest: usize) -> Vec<Damped> {
    let omega = 0.5 * TAU / lowest as f64;
    let of = |faster: f64| {
        [0.05, 0.3, 1.0].map(|damping| Damped {
            lambda: damping * omega,
            omega: faster * omega,
            a: 1.0,
            b: 0.0,
        })
    };
    [0.7, 1.0, 1.4].into_iter().flat_map(of).collect()
}
