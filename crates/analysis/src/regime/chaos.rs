//! Do neighbours part exponentially? The largest exponent, and what the returns say.

use super::look::Look;
use super::returns;
use super::settings::Settings;
use super::verdict::{Attractor, Regime, Verdict};
use crate::lyapunov::{Lyapunov, LyapunovSettings, lyapunov};
use crate::{Estimate, Result};
use motiform_dynamics::{Equivariant, Sink};

/// Growth by less than this (natural logarithm) over a whole run may be a power of time.
const GROWN: f64 = 10.0;

/// K of the 0-1 test below this speaks for order.
const ORDER: f64 = 0.3;

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
    /// Number of returns.
    pub(super) returns: usize,
}

impl Witness {
    pub(super) fn of(look: &Look) -> Self {
        let minima = look.minima();
        Self {
            zero_one: returns::chaos(&minima),
            dimension: returns::dimension(&minima),
            returns: minima.len(),
        }
    }
}

/// Whether neighbours part: lambda_1 above twice its 95 % error, and growth beyond any power of time.
pub(super) fn parts(run: &Lyapunov) -> Option<Estimate> {
    let first = *run.exponents.first()?;
    let grows = first.value > 2.0 * first.error && first.value * run.time >= GROWN;
    grows.then_some(first)
}

/// Chaos: neighbours part in two looks, one after the other, the second twice as long; in three where the 0-1 test sees
/// order (it may be right, or blind to weak chaos in narrow bands). `None` for fewer.
///
/// One look alone may see a transient, and the error of its exponent knows nothing of what comes after.
pub(super) fn chaotic(seen: &[Estimate], run: &Lyapunov, witness: &Witness, time: f64) -> Option<Verdict> {
    let needed = if witness.zero_one.is_some_and(|k| k < ORDER) { 3 } else { 2 };
    let [.., before, now] = seen else { return None };
    if seen.len() < needed {
        return None;
    }
    let Estimate { value, error } = *now;
    let second = witness.zero_one.map_or(String::new(), |k| format!("; 0-1 test {k:.2}"));
    let why = format!(
        "lambda_1 = {value:.4} +- {error:.4} over a time of {:.0}, {:.4} +- {:.4} over the time before{second}",
        run.time, before.value, before.error
    );
    let mut verdict = Verdict::new(Regime::Chaotic, Attractor::Chaotic, why, time);
    verdict.margin = Some(value / error.max(f64::MIN_POSITIVE));
    verdict.exponents.clone_from(&run.exponents);
    Some(verdict)
}

/// A torus of shapes: returns on a curve, and an exponent that is zero within its error.
///
/// That it is zero and not small is said by the 0-1 test, or by the run itself: where neighbours have not parted by more
/// than the number of returns, error included, their distance grows like a power of time at most. (The 0-1 test may fail
/// on a torus: where the number of minima per turn changes, the returns are an exchange of intervals, which wanders.)
pub(super) fn torus(run: &Lyapunov, witness: &Witness, time: f64) -> Option<Verdict> {
    let Estimate { value, error } = *run.exponents.first()?;
    let (k, dimension) = (witness.zero_one?, witness.dimension?);
    let curve = (0.8..1.2).contains(&dimension);
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
pub(super) fn missing(run: &Lyapunov, witness: &Witness) -> String {
    let Some(Estimate { value, error }) = run.exponents.first() else {
        return "no exponent".to_owned();
    };
    let k = witness.zero_one.map_or_else(|| "no 0-1 test".to_owned(), |k| format!("0-1 test {k:.2}"));
    format!(
        "lambda_1 = {value:.1e} +- {error:.1e} and {k} decide neither chaos nor order, no recurrence was found"
    )
}
