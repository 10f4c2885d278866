//! How tangent vectors grew: runs in which the shape moved, and the exponent of several of them.

use crate::Estimate;
use crate::lyapunov::{Lyapunov, durations, rates};
use crate::series_mean::mean_over;

/// Rests that take more than this part of a run count,
const RESTING: f64 = 0.3;

/// and then there must be as many of them: an exponent over a few rests at saddles is that of the saddles.
const LEAST_RESTS: usize = 8;

/// A run without the rests that it began and ended in, or the reason why its exponent is that of a saddle: at a saddle neighbouring
/// orbits separate at its own rate, and that is no chaos, however long it lasts. Slower than `slow` of the fastest is rest; `fastest` is
/// the fastest change of the shape before the run.
pub(super) fn in_motion(run: &Lyapunov, slow: f64, fastest: f64) -> Result<Lyapunov, String> {
    let moved = run.reduced_speeds.iter().any(|&speed| speed >= slow * fastest);
    let Some(run) = moved.then(|| run.moving(slow)).flatten() else {
        return Err("the orbit rested at a saddle while the exponent was measured".to_owned());
    };
    let fastest = run.reduced_speeds.iter().copied().fold(0.0, f64::max);
    let rests: Vec<bool> = run.reduced_speeds.iter().map(|&speed| speed < slow * fastest).collect();
    let share = rests.iter().filter(|&&rest| rest).count() as f64 / rests.len() as f64;
    let ends = rests.windows(2).filter(|pair| pair[0] && !pair[1]).count();
    if share > RESTING && ends < LEAST_RESTS {
        return Err(format!("the orbit spent {:.0} % of the time in {ends} rests at saddles", 100.0 * share));
    }
    Ok(run)
}

/// How the tangent vector grew in one run.
#[derive(Clone, Debug)]
pub(super) struct Growth {
    /// Growth rates of the intervals, and their durations.
    rates: Vec<f64>,
    durations: Vec<f64>,
    /// Their mean.
    pub(super) estimate: Estimate,
    /// Model time of the search when the run began.
    start: f64,
}

impl Growth {
    /// The growth of the first vector of a run that ended at time `end` of the search; `None` without an exponent.
    pub(super) fn of(run: &Lyapunov, end: f64) -> Option<Self> {
        let estimate = *run.exponents.first()?;
        let begun = run.history.last()?.0 - run.time;
        Some(Self {
            rates: rates(&run.history, 0),
            durations: durations(&run.history, begun),
            estimate,
            start: end - run.time - run.transient,
        })
    }

    fn time(&self) -> f64 {
        self.durations.iter().sum()
    }
}

/// The exponent of several runs in a row.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pooled {
    pub(super) estimate: Estimate,
    /// Time averaged over.
    pub(super) time: f64,
    /// Number of runs.
    pub(super) runs: usize,
    /// Time of the search at which the first of them began.
    pub(super) since: f64,
}

/// The pooled exponent of the latest runs that agree with each other: an orbit may pass a transient first.
pub(super) fn pooled(runs: &[Growth]) -> Option<Pooled> {
    let (last, earlier) = runs.split_last()?;
    let mut rates = last.rates.clone();
    let mut durations = last.durations.clone();
    let mut all = Pooled { estimate: last.estimate, time: last.time(), runs: 1, since: last.start };
    for run in earlier.iter().rev() {
        let apart = (run.estimate.value - all.estimate.value).abs();
        if apart > 2.0 * (run.estimate.error + all.estimate.error) {
            break;
        }
        rates.splice(0..0, run.rates.iter().copied());
        durations.splice(0..0, run.durations.iter().copied());
        let Ok(mean) = mean_over(&rates, &durations) else { break };
        all = Pooled {
            estimate: Estimate { value: mean.value, error: mean.error.max(1e-12) },
            time: all.time + run.time(),
            runs: all.runs + 1,
            since: run.start,
        };
    }
    Some(all)
}
