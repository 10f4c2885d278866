//! How far an answer moves in a finer model: the resolution of a verdict.

use super::classify::classify;
use super::form::Form;
use super::settings::Settings;
use super::verdict::{Attractor, Regime, Verdict};
use super::{recurrence::Recurrence, words};
use crate::equilibrium::RelativeEquilibrium;
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
    /// The largest relative change of speed, turning rate and period; of a cycle that of the rates at its saddle.
    pub change: f64,
}

/// Looks at the motion in the finer model where Newton's method does not find it.
const LOOKS: f64 = 4.0;

impl Verdict {
    /// This verdict with its resolution: what Newton's method finds from `shape` on this motion, given in the representation of `finer`, a
    /// model of the same body in which `parameter` has this value. Undetermined where it is another motion there, or none. Chaos and tori
    /// are left as they are: they would have to be run again.
    ///
    /// # Errors
    /// What the numerics refuse.
    pub fn resolved_by<B: Equivariant + ?Sized>(
        mut self,
        finer: &B,
        shape: &[f64],
        (parameter, value): (&str, f64),
        settings: &Settings,
        watch: &dyn Watch,
    ) -> crate::Result<Self> {
        let found = match (self.attractor, self.period) {
            (Attractor::Equilibrium, _) => RelativeEquilibrium::find(finer, shape)
                .map(|found| words::equilibrium(finer, &found, 0.0, 0.0)),
            (Attractor::Periodic, Some(period)) => orbit(finer, shape, (period, self.form), settings, watch)?,
            (Attractor::Heteroclinic, _) => return Ok(self.at_saddle(finer, shape, (parameter, value))),
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
                self.resolution = Some(Resolution { parameter: parameter.to_owned(), value, change });
            }
            Some(other) => return Ok(self.unresolved((parameter, value), &format!("it is {}", other.regime))),
        }
        Ok(self)
    }

    /// The verdict on a cycle with its resolution: the rates at the saddle beside `shape` in the finer model. Undetermined where a cycle does not
    /// attract by them.
    fn at_saddle<B: Equivariant + ?Sized>(mut self, finer: &B, shape: &[f64], changed: (&str, f64)) -> Self {
        let found = RelativeEquilibrium::find(finer, shape);
        let (Some(own), Some(found)) = (self.saddle, found) else { return self };
        let Some(other) = found.saddle(finer).filter(|other| other.out + other.inward < -other.error) else {
            return self.unresolved(changed, "the rests are at no saddle by which a cycle attracts");
        };
        let off = |x: f64, y: f64| (x - y).abs() / x.abs().max(y.abs());
        let change = off(own.out, other.out).max(off(own.inward, other.inward));
        self.resolution = Some(Resolution { parameter: changed.0.to_owned(), value: changed.1, change });
        self
    }

    /// Undetermined, for what is found in the finer model.
    fn unresolved(mut self, (parameter, value): (&str, f64), what: &str) -> Self {
        self.why = format!("{}; but with {parameter} = {value} {what}: not resolved", self.why);
        (self.regime, self.attractor) = (Regime::Undetermined, Attractor::Unknown);
        (self.form, self.margin) = (None, None);
        self
    }

    /// The largest relative difference of the numbers of two verdicts on one motion.
    fn change(&self, other: &Self) -> f64 {
        let speed = |verdict: &Self| verdict.speed.map(|speed| speed.mean);
        let pairs = [
            (speed(self), speed(other)),
            (self.turning_rate, other.turning_rate),
            (self.period, other.period),
        ];
        let change = |(x, y): (Option<f64>, Option<f64>)| {
            let (x, y) = (x?.abs(), y?.abs());
            (x.max(y) > 0.0).then(|| (x - y).abs() / x.max(y))
        };
        pairs.into_iter().filter_map(change).fold(0.0, f64::max)
    }
}

/// The verdict on the periodic orbit that Newton's method finds from `shape`, if it is stable.
fn orbit<B: Equivariant + ?Sized>(
    body: &B,
    shape: &[f64],
    (period, form): (f64, Option<Form>),
    settings: &Settings,
    watch: &dyn Watch,
) -> crate::Result<Option<Verdict>> {
    let mirrored = form == Some(Form::MirrorZigzag);
    let time = if mirrored { 0.5 * period } else { period };
    let found = PeriodicOrbit::near(body, shape, (time, mirrored), &settings.flow(), watch);
    let Some(found) = found.filter(PeriodicOrbit::is_stable) else { return Ok(None) };
    let recurrence = Recurrence { returns: 1, mirrored, time, angle: found.angle };
    words::periodic(body, &found, &recurrence, settings, 0.0, watch).map(Some)
}
