//! The growth of tangent vectors: runs in which the shape moved, and the exponent of several of them.

use crate::Estimate;
use crate::lyapunov::{Lyapunov, SECULAR, durations, power_of_time, rates, with_unseen};
use crate::series_mean::mean_over;

/// Rests that take more than this part of a run count,
const RESTING: f64 = 0.3;

/// and then there must be as many of them: an exponent over a few rests at saddles is that of the saddles.
const LEAST_RESTS: usize = 8;

/// In a run that rests, an exponent is what is left of larger numbers: neighbouring orbits come closer at
/// each saddle and separate again. Close to a cycle of saddles they do so by more than this (natural
/// logarithm; measured: 15 to 19 there, below 7 in chaos that rests), and the errors of steps decide the
/// difference.
const CANCELS: f64 = 12.0;

/// The reason why a run gives no exponent of the motion.
#[derive(Debug)]
pub(super) struct NoMeasure {
    pub(super) why: String,
    /// `true` if the exponent is the residue that errors of steps leave of larger numbers: a longer run would
    /// not change that.
    pub(super) cancels: bool,
}

/// A run without the rests that it began and ended in, or the reason why its exponent is that of a saddle: at a saddle neighbouring
/// orbits separate at its own rate, and that is no chaos, however long it lasts. Slower than `slow` of the fastest is rest; `fastest` is
/// the fastest change of the shape before the run.
pub(super) fn in_motion(run: &Lyapunov, slow: f64, fastest: f64) -> Result<Lyapunov, NoMeasure> {
    let none = |why: String| NoMeasure { why, cancels: false };
    let moved = run.reduced_speeds.iter().any(|&speed| speed >= slow * fastest);
    let Some(run) = moved.then(|| run.moving(slow)).flatten() else {
        return Err(none(
            "the orbit rested, at a saddle or on a slow part of its cycle, while the exponent was measured"
                .to_owned(),
        ));
    };
    let fastest = run.reduced_speeds.iter().copied().fold(0.0, f64::max);
    let rests: Vec<bool> = run.reduced_speeds.iter().map(|&speed| speed < slow * fastest).collect();
    let share = rests.iter().filter(|&&rest| rest).count() as f64 / rests.len() as f64;
    let ends = rests.windows(2).filter(|pair| pair[0] && !pair[1]).count();
    let fall = deepest_fall(&run);
    if share > RESTING && fall > CANCELS {
        let why = format!(
            "neighbouring orbits come closer by e^-{fall:.0} and separate again in rests at saddles: what \
            is left of it is no measure of chaos"
        );
        return Err(NoMeasure { why, cancels: true });
    }
    if share > RESTING && ends < LEAST_RESTS {
        return Err(none(format!(
            "the orbit spent {:.0} % of the time in {ends} rests at saddles",
            100.0 * share
        )));
    }
    Ok(run)
}

/// The largest fall of the first tangent vector from one time to a later one (natural logarithm of its length).
fn deepest_fall(run: &Lyapunov) -> f64 {
    let Some(last) = run.history.last() else { return 0.0 };
    let spans = durations(&run.history, last.0 - run.time);
    let (mut sum, mut highest, mut fall) = (0.0_f64, 0.0_f64, 0.0_f64);
    for (rate, span) in rates(&run.history, 0).iter().zip(spans) {
        sum += rate * span;
        highest = highest.max(sum);
        fall = fall.max(highest - sum);
    }
    fall
}

/// The growth of the tangent vector in one run.
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
        let found = *run.exponents.first()?;
        let begun = run.history.last()?.0 - run.time;
        let (rates, durations) = (rates(&run.history, 0), durations(&run.history, begun));
        let estimate = with_unseen(found, &rates, &durations, SECULAR);
        Some(Self { rates, durations, estimate, start: end - run.time - run.transient })
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
        let runs = all.runs + 1;
        let mean = Estimate { error: mean.error.max(1e-12), ..mean };
        all = Pooled {
            estimate: with_unseen(mean, &rates, &durations, power_of_time(runs)),
            time: all.time + run.time(),
            runs,
            since: run.start,
        };
    }
    Some(all)
}
