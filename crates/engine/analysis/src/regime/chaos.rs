//! Do neighbouring orbits separate exponentially? The largest exponent, pooled over looks, and what the returns say.

use super::case::Case;
use super::growth::{Growth, Pooled, pooled};
use super::look::Look;
use super::returns;
use super::settings::Settings;
use super::verdict::{Attractor, Regime, Verdict};
use super::words::lasting;
use crate::lyapunov::{GROWN, Lyapunov, LyapunovSettings, SECULAR, lyapunov, separates};
use crate::{Estimate, Result, escape_limits};
use motiform_dynamics::digits::value_and_error;

/// K of the 0-1 test below this speaks for order.
const ORDER: f64 = 0.3;

/// The factor on the required errors and growth of an exponent where a witness sees order.
const DOUBT: f64 = 1.3;

/// The largest exponent over `span`, after a fifth of it for the vector to turn its way.
pub(super) fn exponent(case: Case<'_>, shape: &[f64], span: f64) -> Result<Lyapunov> {
    lyapunov(case.body, shape, &exponent_settings(case.settings, span), case.watch)
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

/// The evidence on chaos from the returns of a look: witnesses beside the exponent.
#[derive(Clone, Copy, Debug)]
pub(super) struct Witness {
    /// K of the 0-1 test on the sizes at the minima; absent for few returns.
    pub(super) zero_one: Option<f64>,
    /// Dimension of the set of returns; absent for few returns.
    pub(super) dimension: Option<f64>,
    /// `true` if early and late returns fill the same set; absent for few returns.
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

    /// Returns `true` if the returns drift or shrink, and the 0-1 test sees order.
    pub(super) fn shrinks_orderly(&self) -> bool {
        self.stationary == Some(false) && self.sees_order()
    }

    /// Returns `true` if the 0-1 test sees order. It may be right, or blind to weak chaos in narrow bands.
    fn sees_order(&self) -> bool {
        self.zero_one.is_some_and(|k| k < ORDER)
    }
}

/// Chaos: the exponent of at least two runs in a row, pooled, exceeds three times its 95 % error and stands for growth beyond
/// any power of time; the last run alone is positive beyond its error. Where the 0-1 test sees order, more is asked for, but no
/// witness overrules the exponent. `None` where it is less.
///
/// One run alone may see a transient, and the error of its exponent knows nothing of what comes after.
///
/// # Errors
/// A time that is not above 0.
pub(super) fn chaotic(
    runs: &[Growth],
    run: &Lyapunov,
    witness: &Witness,
    time: f64,
) -> Result<Option<Verdict>> {
    let (Some(last), Some(all)) = (runs.last().map(|run| run.estimate), pooled(runs)) else {
        return Ok(None);
    };
    let asked = if witness.sees_order() { DOUBT } else { 1.0 };
    let Estimate { value, error } = all.estimate;
    let grows = separates(all.estimate, all.time, all.runs, asked);
    // the last run alone, with its own tangent vector, says the same
    let lasts = last.value > last.error && last.value * run.time > SECULAR;
    if all.runs < 2 || !grows || !lasts {
        return Ok(None);
    }
    let lasted = time - all.since;
    let (_, fastest_escape) = escape_limits(0, lasted)?;
    let second = witness.zero_one.map_or(String::new(), |k| format!("; 0-1 test {k:.2}"));
    let why = format!(
        "lambda_1 = {} over a time of {} in {} runs, {} in the last{second}; no escape in a time of {}: if this is \
         a transient, its mean life is above {} (95 %)",
        stated(all.estimate),
        lasting(all.time),
        all.runs,
        stated(last),
        lasting(lasted),
        lasting(1.0 / fastest_escape)
    );
    let mut verdict = Verdict::new(Regime::Chaotic, Attractor::Chaotic, why, time);
    verdict.margin = Some(value / error.max(f64::MIN_POSITIVE));
    verdict.lasted = Some(lasted);
    verdict.exponents.clone_from(&run.exponents);
    if let Some(first) = verdict.exponents.first_mut() {
        *first = all.estimate;
    }
    Ok(Some(verdict))
}

/// An exponent with its error.
pub(super) fn stated(Estimate { value, error }: Estimate) -> String {
    value_and_error(value, error, 2).join(" +- ")
}

/// An exponent above this many of its errors is worth more time.
const NEARLY: f64 = 2.0;

/// Returns `true` if the pooled exponent of at least two runs is above twice its error: too much for order,
/// and maybe too little for chaos.
pub(super) fn is_near(runs: &[Growth]) -> bool {
    let near = |all: &Pooled| all.runs > 1 && all.estimate.value > NEARLY * all.estimate.error;
    pooled(runs).filter(near).is_some()
}

/// Returns `true` if as much time again as the latest runs took would decide: each of them is long enough for
/// a growth beyond a power of time.
pub(super) fn is_long_enough(runs: &[Growth]) -> bool {
    let long = |all: Pooled| all.estimate.value * all.time > SECULAR * all.runs as f64;
    pooled(runs).is_some_and(long)
}

/// A torus of shapes: returns on a curve that early and late ones fill alike, and an exponent that is zero within its error, or of a growth
/// that may be a power of time: on the tori of Hamiltonian equations neighbouring orbits separate in proportion to it.
///
/// That it is zero and not small is said by the 0-1 test, or by the run itself: where the distance of neighbouring orbits has not
/// grown by more than the number of returns, error included, it grows like a power of time at most. (The 0-1 test may fail
/// on a torus: where the number of minima per turn changes, the returns are an exchange of intervals, which wanders.)
///
/// A set that shrinks is no torus: close to a bifurcation the returns approach a periodic orbit as a power of
/// time, along a curve. This sees what changes within a look by more than the distance of its returns;
/// [`super::lasting`] sees less.
pub(super) fn torus(run: &Lyapunov, witness: &Witness, time: f64) -> Option<Verdict> {
    let first = *run.clone().bounded().exponents.first()?;
    let Estimate { value, error } = *run.exponents.first()?;
    let secular = value.abs() * run.time < SECULAR;
    // rates that fall like 1/t have no error of their own
    let error = if error.is_infinite() && secular { value.abs() } else { error };
    let (k, dimension) = (witness.zero_one?, witness.dimension?);
    let curve = (0.8..1.2).contains(&dimension) && witness.stationary?;
    if error.is_infinite() || value > 2.0 * error || value * run.time > GROWN || !curve {
        return None;
    }
    let most = libm::log(witness.returns as f64);
    let growth = (value.abs() + error) * run.time;
    if k > ORDER && growth > most {
        return None;
    }
    let bounded = Estimate { value, error: if first.has_error() { first.error } else { error } };
    let exponent = stated(bounded);
    let why = format!(
        "the returns lie on a closed curve (dimension {dimension:.2}), lambda_1 = {exponent}, 0-1 test {k:.2}: a torus of shapes"
    );
    let mut verdict = Verdict::new(Regime::QuasiPeriodic, Attractor::Torus, why, time);
    verdict.margin = Some((ORDER / k.abs().max(0.03)).max(most / growth.max(0.1)));
    verdict.exponents = vec![bounded];
    Some(verdict)
}

/// The evidence that is missing for a decision, in words.
pub(super) fn missing(runs: &[Growth], witness: &Witness) -> String {
    let Some(Pooled { estimate, .. }) = pooled(runs) else {
        return "no exponent".to_owned();
    };
    let exponent = match estimate.has_error() {
        true => stated(estimate),
        false => format!("{:.1e} without an error", estimate.value),
    };
    let k = witness.zero_one.map_or_else(|| "no 0-1 test".to_owned(), |k| format!("0-1 test {k:.2}"));
    let drifts = if witness.stationary == Some(false) { ", the returns drift or shrink" } else { "" };
    format!(
        "lambda_1 = {exponent} and {k} decide neither chaos nor order{drifts}, no stable recurrence was found"
    )
}
