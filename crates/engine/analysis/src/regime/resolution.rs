//! The resolution of a verdict: the change of an answer in a finer model.

use super::case::Case;
use super::classify::classify;
use super::settings::Settings;
use super::verdict::{Attractor, Regime, Verdict};
use super::{chaos, recurrence::Recurrence, words};
use crate::Estimate;
use crate::equilibrium::{RelativeEquilibrium, Saddle};
use crate::periodic::PeriodicOrbit;
use motiform_dynamics::{Equivariant, Watch};
use serde::{Deserialize, Serialize};

/// The same motion with more modes and a tighter tolerance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Resolution {
    /// The parameter that was changed.
    pub parameter: String,
    /// Its other value.
    pub value: f64,
    /// The largest relative change of speed, turning rate and period; of a cycle that of the rates at its
    /// saddle; of chaos that of speed and largest exponent, averages over a time.
    pub change: f64,
    /// Of chaos and tori the largest exponent there, averaged over a shorter time (inverse model time).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub exponent: Option<Estimate>,
}

/// Looks at the motion in the finer model where Newton's method does not find it.
const LOOKS: f64 = 4.0;

/// Looks over which an exponent is averaged in the finer model.
const RUN: f64 = 4.0;

/// Exponents that differ by more than this many times the sum of their errors are not those of one motion: as
/// for runs that are pooled ([`super::growth`]).
const APART: f64 = 2.0;

impl Verdict {
    /// This verdict with its resolution: what Newton's method finds from `shape` on this motion, given in the representation of `finer`, a
    /// model of the same body in which `parameter` has this value. Undetermined where it is another motion
    /// there, or none. Chaos and tori are run on there for a while.
    ///
    /// # Errors
    /// Input that the numerics refuse.
    pub fn resolved_by(
        mut self,
        finer: &dyn Equivariant,
        shape: &[f64],
        parameter: &str,
        value: f64,
        settings: &Settings,
        watch: &dyn Watch,
    ) -> crate::Result<Self> {
        let case = Case { body: finer, settings, watch };
        let found = match (self.attractor, self.period) {
            (Attractor::Equilibrium, _) => RelativeEquilibrium::find(finer, shape)
                .map(|found| words::equilibrium(finer, &found, 0.0, 0.0)),
            (Attractor::Periodic, Some(_)) => self.repeats(case, shape)?,
            (Attractor::Heteroclinic, _) => return Ok(self.at_saddle(finer, shape, parameter, value)),
            (Attractor::Chaotic | Attractor::Torus, _) => {
                return self.averaged(case, shape, parameter, value);
            }
            _ => return Ok(self),
        };
        let same = |other: &Self| other.attractor == self.attractor && other.regime == self.regime;
        let other = match found.map(Self::or_undetermined).filter(same) {
            Some(other) => Some(other),
            // Newton's method may fail from a shape that is not quite there
            None => {
                classify(finer, shape, &Settings { budget: LOOKS * settings.first_look, ..*settings }, watch)?
            }
        };
        match other.filter(|other| other.regime != Regime::Undetermined) {
            _ if watch.stopped() => {}
            None => {}
            Some(other) if same(&other) => {
                let change = self.change(&other);
                self.resolution =
                    Some(Resolution { parameter: parameter.to_owned(), value, change, exponent: None });
            }
            Some(other) => return Ok(self.unresolved(parameter, value, &format!("it is {}", other.regime))),
        }
        Ok(self)
    }

    /// The verdict on a cycle with its resolution: the rates at the saddle beside `shape` in the finer model.
    /// Undetermined where a cycle does not attract by them.
    fn at_saddle(mut self, finer: &dyn Equivariant, shape: &[f64], parameter: &str, value: f64) -> Self {
        let found = RelativeEquilibrium::find(finer, shape);
        let (Some(own), Some(found)) = (self.saddle, found) else { return self };
        let Some(other) = found.saddle(finer).filter(Saddle::attracts) else {
            return self.unresolved(parameter, value, "the rests are at no saddle by which a cycle attracts");
        };
        let off = |x: f64, y: f64| (x - y).abs() / x.abs().max(y.abs());
        let change = off(own.out, other.out).max(off(own.inward, other.inward));
        self.resolution = Some(Resolution { parameter: parameter.to_owned(), value, change, exponent: None });
        self
    }

    /// The verdict on chaos or a torus with its resolution: the largest exponent of a run in the finer model.
    /// Undetermined where the two differ by more than twice the sum of their errors; without a resolution
    /// where the run has no exponent.
    fn averaged(mut self, case: Case<'_>, shape: &[f64], parameter: &str, value: f64) -> crate::Result<Self> {
        let first_look = case.settings.first_look;
        let run = chaos::exponent(case, shape, RUN * first_look)?.bounded();
        let (own, found) = (self.exponents.first().copied(), run.exponents.first().copied());
        let (Some(own), Some(found)) = (own, found) else { return Ok(self) };
        if !run.outcome.is_complete() || !found.has_error() {
            return Ok(self);
        }
        let off = found.value - own.value;
        if off.abs() > APART * (found.error + own.error) {
            let what = format!("lambda_1 = {}", chaos::stated(found));
            return Ok(self.unresolved(parameter, value, &what));
        }
        let mut other = self.clone();
        words::along(&mut other, case, &run.shape, first_look)?;
        let growth = if self.regime == Regime::Chaotic { (off / own.value).abs() } else { 0.0 };
        let change = self.change(&other).max(growth);
        self.resolution =
            Some(Resolution { parameter: parameter.to_owned(), value, change, exponent: Some(found) });
        Ok(self)
    }

    /// Undetermined, for what is found in the finer model.
    fn unresolved(mut self, parameter: &str, value: f64, what: &str) -> Self {
        self.why = format!("{}; but with {parameter} = {value} {what}: not resolved", self.why);
        (self.regime, self.attractor) = (Regime::Undetermined, Attractor::Unknown);
        (self.form, self.margin) = (None, None);
        self
    }

    /// The largest relative difference of the numbers of two verdicts on one motion.
    fn change(&self, other: &Self) -> f64 {
        let speed = |verdict: &Self| verdict.speed.map(|speed| speed.mean);
        // a body that does not repeat turns to either side: its mean turning rate is what is left of larger numbers
        let repeats = self.period.is_some() || self.attractor == Attractor::Equilibrium;
        let turning = |verdict: &Self| verdict.turning_rate.filter(|_| repeats);
        let pairs =
            [(speed(self), speed(other)), (turning(self), turning(other)), (self.period, other.period)];
        let change = |(x, y): (Option<f64>, Option<f64>)| {
            let (x, y) = (x?.abs(), y?.abs());
            (x.max(y) > 0.0).then(|| (x - y).abs() / x.max(y))
        };
        pairs.into_iter().filter_map(change).fold(0.0, f64::max)
    }

    /// The verdict on the periodic orbit that Newton's method finds from `shape`, if it is stable.
    fn repeats(&self, case: Case<'_>, shape: &[f64]) -> crate::Result<Option<Self>> {
        let found = self.orbit(case.body, shape, &case.settings.flow(), case.watch);
        let Some(found) = found.filter(PeriodicOrbit::is_stable) else { return Ok(None) };
        let PeriodicOrbit { time, angle, mirrored, .. } = found;
        let recurrence = Recurrence { returns: 1, mirrored, time, angle };
        words::periodic(case, &found, &recurrence, 0.0).map(Some)
    }
}
