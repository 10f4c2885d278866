//! Do neighbouring orbits separate exponentially? The largest exponent, pooled over looks, and what the returns say.

use super::look::Look;
use super::returns;
use super::settings::Settings;
use super::verdict::{Attractor, Regime, Verdict};
use crate::lyapunov::{Lyapunov, LyapunovSettings, lyapunov};
use crate::series_mean::mean_over;
use crate::{Estimate, Result};
use motiform_dynamics::{Equivariant, Sink};

/// Growth by less than this (natural logarithm) over all runs may be a power of time.
const GROWN: f64 = 10.0;

/// Chaos needs a pooled exponent above this many of its 95 % errors.
const ERRORS: f64 = 3.0;

/// K of the 0-1 test below this speaks for order.
const ORDER: f64 = 0.3;

/// What a witness for order asks of an exponent: so many times the errors and the growth.
const DOUBT: f64 = 1.3;

/// A mean life shorter than this part of the observed time would have ended it with a probability of 95 %: `1 / ln 20`.
const SHORTEST_LIFE: f64 = 0.334;

/// The largest exponent over `span`, after a fifth of it for the vector to turn its way.
pub(super) fn exponent<B: Equivariant + ?Sized>(
    body: &B,
    shape: &[f64],
    span: f64,
    settings: &Settings,
    stop: &mut dyn Sink,
) -> Result<Lyapunov> {
    lyapunov(body, shape, &exponent_settings(settings, span), stop)
}

/// The settings of that run.
pub(super) fn exponent_settings(settings: &Settings, span: f64) -> LyapunovSettings {
    LyapunovSettings {
        count: 1,
        method: settings.method,
        control: settings.control,
        transient: 0.2 * span,
        span,
        escape_norm: settings.escape_norm,
        max_steps: settings.max_steps,
    }
}

/// What the returns of a look say about chaos: witnesses beside the exponent.
#[derive(Clone, Copy, Debug)]
pub(super) struct Witness {
    /// K of the 0-1 test on the sizes at the minima; absent for few returns.
    pub(super) zero_one: Option<f64>,
    /// Dimension of the set of returns; absent for few returns.
    pub(super) dimension: Option<f64>,
    /// Whether early and late returns fill the same set; absent for few returns.
    pub(super) stationary: Option<bool>,
    /// Number of returns.
    pub(super) returns: usize,
}

impl Witness {
    pub(super) fn of(look: &Look) -> Self {
        let minima = look.minima();
        Self {
            zero_one: returns::chaos(&minima),
            dimension: returns::dimension(&minima),
            stationary: returns::stationary(&minima),
            returns: minima.len(),
        }
    }

    /// Whether the 0-1 test sees order. It may be right, or blind to weak chaos in narrow bands.
    fn sees_order(&self) -> bool {
        self.zero_one.is_some_and(|k| k < ORDER)
    }
}

/// Rests that take more than this part of a run count,
const RESTING: f64 = 0.3;

/// and then there must be as many of them: an exponent over a few rests at saddles is that of the saddles.
const LEAST_RESTS: usize = 8;

/// The number of rests in a run that consists of few of them and of little else; `None` for every other run.
pub(super) fn few_rests(run: &Lyapunov, slow: f64) -> Option<usize> {
    let fastest = run.reduced_speeds.iter().copied().fold(0.0, f64::max);
    let rests: Vec<bool> = run.reduced_speeds.iter().map(|&speed| speed < slow * fastest).collect();
    let share = rests.iter().filter(|&&rest| rest).count() as f64 / rests.len() as f64;
    let ends = rests.windows(2).filter(|pair| pair[0] && !pair[1]).count();
    (share > RESTING && ends < LEAST_RESTS).then_some(ends)
}

/// How the tangent vector grew in one run.
#[derive(Clone, Debug)]
pub(super) struct Growth {
    /// Growth rates of the intervals, and their durations.
    rates: Vec<f64>,
    durations: Vec<f64>,
    /// Their mean.
    estimate: Estimate,
    /// Model time of the search when the run began and ended.
    span: (f64, f64),
}

impl Growth {
    /// The growth of the first vector of a run that ended at time `end` of the search; `None` without an exponent.
    pub(super) fn of(run: &Lyapunov, end: f64) -> Option<Self> {
        let estimate = *run.exponents.first()?;
        let last = run.history.last()?.0;
        let begun = std::iter::once(last - run.time).chain(run.history.iter().map(|entry| entry.0));
        let durations = run.history.iter().zip(begun).map(|(entry, begun)| entry.0 - begun).collect();
        let rates = run.history.iter().map(|entry| entry.1[0]).collect();
        Some(Self { rates, durations, estimate, span: (end - run.time - run.transient, end) })
    }

    fn time(&self) -> f64 {
        self.durations.iter().sum()
    }
}

/// The exponent of several runs in a row.
#[derive(Clone, Copy, Debug)]
struct Pooled {
    estimate: Estimate,
    /// Time averaged over.
    time: f64,
    /// Number of runs.
    runs: usize,
    /// Time of the search at which the first of them began.
    since: f64,
}

/// The pooled exponent of the latest runs that agree with each other: one orbit may pass a transient first.
fn pooled(runs: &[Growth]) -> Option<Pooled> {
    let (last, earlier) = runs.split_last()?;
    let mut rates = last.rates.clone();
    let mut durations = last.durations.clone();
    let mut all = Pooled { estimate: last.estimate, time: last.time(), runs: 1, since: last.span.0 };
    for run in earlier.iter().rev() {
        let apart = (run.estimate.value - all.estimate.value).abs();
        if apart > 2.0 * (run.estimate.error + all.estimate.error) {
            break;
        }
        rates.splice(0..0, run.rates.iter().copied());
        durations.splice(0..0, run.durations.iter().copied());
        let Ok(mean) = mean_over(&rates, &durations) else { break };
        let error = mean.error.max(1e-12);
        all = Pooled {
            estimate: Estimate { value: mean.value, error },
            time: all.time + run.time(),
            runs: all.runs + 1,
            since: run.span.0,
        };
    }
    Some(all)
}

/// Chaos: the exponent of at least two runs in a row, pooled, exceeds three times its 95 % error and stands for growth beyond
/// any power of time; the last run alone is positive beyond its error. Where the 0-1 test sees order, more is asked for, but no
/// witness overrules the exponent. `None` where it is less.
///
/// One run alone may see a transient, and the error of its exponent knows nothing of what comes after.
pub(super) fn chaotic(runs: &[Growth], run: &Lyapunov, witness: &Witness, time: f64) -> Option<Verdict> {
    let last = runs.last()?.estimate;
    let all = pooled(runs)?;
    let asked = if witness.sees_order() { DOUBT } else { 1.0 };
    let Estimate { value, error } = all.estimate;
    let grows = value > asked * ERRORS * error && value * all.time >= asked * GROWN;
    if all.runs < 2 || !grows || last.value <= last.error {
        return None;
    }
    let lasted = time - all.since;
    let second = witness.zero_one.map_or(String::new(), |k| format!("; 0-1 test {k:.2}"));
    let why = format!(
        "lambda_1 = {value:.4} +- {error:.4} over a time of {:.0} in {} runs, {:.4} +- {:.4} in the last{second}; no escape in a \
         time of {lasted:.0}: if this is a transient, its mean life is above {:.0} (95 %)",
        all.time,
        all.runs,
        last.value,
        last.error,
        SHORTEST_LIFE * lasted
    );
    let mut verdict = Verdict::new(Regime::Chaotic, Attractor::Chaotic, why, time);
    verdict.margin = Some(value / error.max(f64::MIN_POSITIVE));
    verdict.lasted = Some(lasted);
    verdict.exponents.clone_from(&run.exponents);
    if let Some(first) = verdict.exponents.first_mut() {
        *first = all.estimate;
    }
    Some(verdict)
}

/// A torus of shapes: returns on a curve that early and late ones fill alike, and an exponent that is zero within its error.
///
/// That it is zero and not small is said by the 0-1 test, or by the run itself: where neighbours have not parted by more
/// than the number of returns, error included, their distance grows like a power of time at most. (The 0-1 test may fail
/// on a torus: where the number of minima per turn changes, the returns are an exchange of intervals, which wanders.)
///
/// A set that shrinks is no torus: close to a bifurcation the returns approach a periodic orbit as a power of time, along a curve.
pub(super) fn torus(run: &Lyapunov, witness: &Witness, time: f64) -> Option<Verdict> {
    let Estimate { value, error } = *run.exponents.first().filter(|first| first.has_error())?;
    let (k, dimension) = (witness.zero_one?, witness.dimension?);
    let curve = (0.8..1.2).contains(&dimension) && witness.stationary?;
    if value > 2.0 * error || value * run.time > GROWN || !curve {
        return None;
    }
    let most = (witness.returns as f64).ln();
    let growth = (value.abs() + error) * run.time;
    if k > ORDER && growth > most {
        return None;
    }
    let why = format!(
        "the returns lie on a closed curve (dimension {dimension:.2}), lambda_1 = {value:.1e} +- {error:.1e}, 0-1 test {k:.2}: a torus of shapes"
    );
    let mut verdict = Verdict::new(Regime::QuasiPeriodic, Attractor::Torus, why, time);
    verdict.margin = Some((ORDER / k.abs().max(0.03)).max(most / growth.max(0.1)));
    verdict.exponents.clone_from(&run.exponents);
    Some(verdict)
}

/// What keeps the evidence from deciding.
pub(super) fn missing(runs: &[Growth], witness: &Witness) -> String {
    let Some(Pooled { estimate, .. }) = pooled(runs) else {
        return "no exponent".to_owned();
    };
    let Estimate { value, error } = estimate;
    let error = if estimate.has_error() { format!("+- {error:.1e}") } else { "without an error".to_owned() };
    let k = witness.zero_one.map_or_else(|| "no 0-1 test".to_owned(), |k| format!("0-1 test {k:.2}"));
    let drifts = if witness.stationary == Some(false) { ", the returns drift or shrink" } else { "" };
    format!(
        "lambda_1 = {value:.1e} {error} and {k} decide neither chaos nor order{drifts}, no stable recurrence was found"
    )
}
