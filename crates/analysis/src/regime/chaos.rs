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
    let request = LyapunovSettings {
        count: 1,
        method: settings.method,
        control: settings.control,
        transient: 0.2 * span,
        span,
        escape_norm: settings.escape_norm,
        max_steps: settings.max_steps,
    };
    lyapunov(body, shape, &request, stop)
}

/// What the returns of a look say about chaos: witnesses beside the exponent.
#[derive(Clone, Copy, Debug)]
pub(super) struct Witness {
    /// K of the 0-1 test on the sizes at the minima; absent for few returns.
    pub(super) zero_one: Option<f64>,
    /// Dimension of the set of returns; absent for few returns.
    pub(super) dimension: Option<f64>,
}

impl Witness {
    pub(super) fn of(look: &Look) -> Self {
        let minima = look.minima();
        Self { zero_one: returns::chaos(&minima), dimension: returns::dimension(&minima) }
    }
}

/// Whether neighbours part: lambda_1 above twice its 95 % error, growth beyond any power of time, and no veto of the 0-1
/// test. The look that the test was asked about ends where the run begins: where it saw order, the growth was a transient.
pub(super) fn parts(run: &Lyapunov, witness: &Witness) -> Option<Estimate> {
    let first = *run.exponents.first()?;
    let grows = first.value > 2.0 * first.error && first.value * run.time >= GROWN;
    let ordered = witness.zero_one.is_some_and(|k| k < ORDER);
    (grows && !ordered).then_some(first)
}

/// Chaos: neighbours part in two looks, one after the other, the second twice as long. One look alone may see a long
/// transient, and its error knows nothing of what comes after.
pub(super) fn chaotic(
    before: Estimate,
    now: Estimate,
    run: &Lyapunov,
    witness: &Witness,
    time: f64,
) -> Verdict {
    let Estimate { value, error } = now;
    let second = witness.zero_one.map_or(String::new(), |k| format!("; 0-1 test {k:.2}"));
    let why = format!(
        "lambda_1 = {value:.4} +- {error:.4} over {:.0}, after {:.4} +- {:.4} in the look before{second}",
        run.time, before.value, before.error
    );
    let mut verdict = Verdict::new(Regime::Chaotic, Attractor::Chaotic, why, time);
    verdict.margin = Some(value / error.max(f64::MIN_POSITIVE));
    verdict.exponents.clone_from(&run.exponents);
    verdict
}

/// A torus of shapes: returns on a curve, and an exponent that is zero within its error and small against what one
/// return would need.
pub(super) fn torus(run: &Lyapunov, witness: &Witness, time: f64) -> Option<Verdict> {
    let Estimate { value, error } = *run.exponents.first()?;
    let (k, dimension) = (witness.zero_one?, witness.dimension?);
    let curve = (0.8..1.2).contains(&dimension);
    if value > 2.0 * error || value * run.time > GROWN || !curve || k > ORDER {
        return None;
    }
    let why = format!(
        "the returns lie on a closed curve (dimension {dimension:.2}), lambda_1 = {value:.1e} +- {error:.1e}, 0-1 test {k:.2}: a torus of shapes"
    );
    let mut verdict = Verdict::new(Regime::QuasiPeriodic, Attractor::Torus, why, time);
    verdict.margin = Some(ORDER / k.abs().max(0.03));
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
