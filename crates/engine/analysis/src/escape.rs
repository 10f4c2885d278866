//! Escape times over many initial states: how many stay how long, and at what rate the last ones leave.

use crate::{Error, Estimate, Result, checks, sort_by_number};
use motiform_dynamics::distributions::NORMAL_95;

/// Fewest escapes that give a rate: below, the normal interval of the estimate is no guide.
const LEAST_ESCAPES: usize = 10;

/// One run: how long it was watched, and whether it escaped then.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stay {
    /// Time of the escape, or of the end of the run.
    pub time: f64,
    /// `true` if the run escaped; if not, its stay is longer than `time` (it is censored).
    pub escaped: bool,
}

/// A step of a [`survival`] curve: the values hold from `time` up to the next step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurvivalStep {
    /// A time at which runs escaped.
    pub time: f64,
    /// S, the share that stays longer than `time`.
    pub share: f64,
    /// Lower end of its 95 % interval.
    pub lower: f64,
    /// Upper end of its 95 % interval.
    pub upper: f64,
    /// Runs still watched just before `time`.
    pub at_risk: usize,
    /// Runs that escaped at `time`.
    pub escaped: usize,
}

/// The share of runs that have not escaped, as a function of time; 1 before the first step.
///
/// S(t) = product over escape times t_i <= t of (1 - d_i/n_i): d_i escapes among the n_i runs still watched just before
/// t_i. A run whose watch ends at t_i is still among them.
///
/// The 95 % interval at each time is that of ln(-ln S): S^exp(-+ 1.96 s / ln S) with Greenwood's
/// s^2 = sum d_i / (n_i (n_i - d_i)). It stays within 0..1. Where all have escaped (S = 0) it is undefined: there it goes
/// from 0 to the upper end of the step before (1 if there is none).
///
/// Source: Kaplan and Meier (1958), J. Am. Stat. Assoc. 53, 457; Greenwood (1926); Kalbfleisch and Prentice (2002), The
/// Statistical Analysis of Failure Time Data.
///
/// # Errors    [`Error::TooFew`] without runs, [`Error::NotFinite`]; [`Error::OutOfRange`] for a negative time
/// # Checked by  tests/all/escape.rs: Freireich's leukaemia trial, coverage for exponential times with censoring
pub fn survival(stays: &[Stay]) -> Result<Vec<SurvivalStep>> {
    let sorted = sorted(stays)?;
    let (mut steps, mut share, mut greenwood, mut last_upper) = (Vec::new(), 1.0, 0.0, 1.0);
    let mut first = 0;
    while first < sorted.len() {
        let (time, at_risk) = (sorted[first].time, sorted.len() - first);
        let ties = sorted[first..].iter().take_while(|stay| stay.time == time);
        let (count, escaped) = ties.fold((0, 0), |(n, d), stay| (n + 1, d + usize::from(stay.escaped)));
        first += count;
        if escaped == 0 {
            continue;
        }
        let (n, d) = (at_risk as f64, escaped as f64);
        share *= 1.0 - d / n;
        greenwood += d / (n * (n - d));
        let (lower, upper) = if escaped == at_risk { (0.0, last_upper) } else { band(share, greenwood) };
        last_upper = upper;
        steps.push(SurvivalStep { time, share, lower, upper, at_risk, escaped });
    }
    Ok(steps)
}

/// S^exp(+-z s/|ln S|), lower end first.
fn band(share: f64, greenwood: f64) -> (f64, f64) {
    let log = libm::log(share);
    let width = NORMAL_95 * greenwood.sqrt() / log.abs();
    let end = |exponent: f64| libm::exp(log * libm::exp(exponent));
    (end(width), end(-width))
}

/// The rate of an exponential tail of escape times.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EscapeRate {
    /// Rate with its 95 % error, inverse model time.
    pub rate: Estimate,
    /// Escapes after `t_from`.
    pub escapes: usize,
    /// Time watched after `t_from`, summed over the runs.
    pub watched: f64,
}

/// Escape rate of the runs that stay longer than `t_from`, by maximum likelihood with censoring.
///
/// rate = d / W,   error = 1.96 rate / sqrt(d):   d escapes after `t_from`, W = sum of max(time - t_from, 0)
///
/// A chaotic saddle loses its runs at a constant rate once they have come close to it: choose `t_from` after the first
/// fast losses, and see that the rate does not change when `t_from` grows.
///
/// Source: Cox and Oakes (1984), Analysis of Survival Data; for saddles Kantz and Grassberger (1985), Physica
/// D 17, 75.
///
/// # Errors    [`Error::TooFew`] below 10 escapes after `t_from`, [`Error::NotFinite`]; [`Error::OutOfRange`] for a
/// negative time
/// # Not       a test that the tail is exponential
/// # Checked by  tests/all/escape.rs: coverage with and without censoring, an offset
pub fn escape_rate(stays: &[Stay], t_from: f64) -> Result<EscapeRate> {
    checks::argument("t_from", t_from, t_from >= 0.0, "of at least 0")?;
    let sorted = sorted(stays)?;
    let late = sorted.iter().filter(|stay| stay.time > t_from);
    let (mut escapes, mut watched) = (0, 0.0);
    for stay in late {
        escapes += usize::from(stay.escaped);
        watched += stay.time - t_from;
    }
    checks::at_least("an escape rate, in escapes after t_from,", LEAST_ESCAPES, escapes)?;
    let value = escapes as f64 / watched;
    let rate = Estimate { value, error: NORMAL_95 * value / (escapes as f64).sqrt() };
    Ok(EscapeRate { rate, escapes, watched })
}

/// The 95 % limits of the rate of a Poisson process that showed so many events while it was watched for so long (summed over
/// runs), for any number of events: 0 to 3.69 / watched for none.
///
/// P(N >= n; lower watched) = 2.5 %,   P(N <= n; upper watched) = 2.5 %,   lower = 0 for n = 0
///
/// Exact: they cover the rate at least as often as they say.
///
/// Source: Garwood (1936), Biometrika 28, 437.
///
/// # Errors    [`Error::OutOfRange`] for a time that is not above 0
/// # Checked by  tests/all/escape.rs: published limits
pub fn escape_limits(events: usize, watched: f64) -> Result<(f64, f64)> {
    checks::argument("watched", watched, watched > 0.0, "above 0")?;
    let n = events as f64;
    let end = n + 10.0 * (n + 1.0).sqrt() + 10.0;
    let lower = if events == 0 { 0.0 } else { crossing(end, |mean| at_most(events - 1, mean) < 0.975) };
    let upper = crossing(end, |mean| at_most(events, mean) < 0.025);
    Ok((lower / watched, upper / watched))
}

/// P(N <= n) for a Poisson variable of this mean.
fn at_most(n: usize, mean: f64) -> f64 {
    let log = libm::log(mean);
    (0..=n).map(|k| libm::exp(k as f64 * log - mean - libm::lgamma(k as f64 + 1.0))).sum()
}

/// The place where `beyond` changes from false to true between 0 and `end`, to a part in 2^60.
fn crossing(end: f64, beyond: impl Fn(f64) -> bool) -> f64 {
    let (mut below, mut above) = (0.0, end);
    for _ in 0..60 {
        let middle = 0.5 * (below + above);
        if beyond(middle) {
            above = middle;
        } else {
            below = middle;
        }
    }
    0.5 * (below + above)
}

/// The stays in the order of time: sums do not depend on the order of the runs.
fn sorted(stays: &[Stay]) -> Result<Vec<Stay>> {
    checks::at_least("a survival curve, in runs,", 1, stays.len())?;
    for (index, stay) in stays.iter().enumerate() {
        if !stay.time.is_finite() {
            return Err(Error::NotFinite { index, value: stay.time });
        }
        checks::argument("escape time", stay.time, stay.time >= 0.0, "of at least 0")?;
    }
    let mut sorted = stays.to_vec();
    sort_by_number(&mut sorted, |a| a.time);
    Ok(sorted)
}
