//! A persistent random walk held against what is known without it.

use crate::slow::Beyond;
use crate::{Answer, Measured, Walk, four_digits};

/// Difference of two values, in their half widths together, from which on they are not one number.
pub(crate) const APART: f64 = 1.25;

/// A relative difference that is none: what the fit's own accuracy is.
const ROUND: f64 = 0.003;

/// The measured quantities that a persistent random walk must agree with.
#[derive(Debug, Clone, Copy)]
pub struct Seen<'a> {
    /// Root-mean-square speed: S.
    pub speed: &'a Measured,
    /// Diffusion coefficient: D.
    pub diffusion: &'a Answer,
    /// Correlation time of the velocity: P.
    pub time: &'a Answer,
}

/// A value with an interval that reaches beyond another value of the same number, by a part of the half width of that: twice their
/// difference over the own half width, and all of it at most.
///
/// A curve that is only near the form has numbers that are off by more than their scatter; the other value rests on no form, and has an
/// error of its own. Values that differ by chance hardly change.
fn toward(found: Measured, other: Measured) -> Measured {
    let Some([low, high]) = found.interval else { return found };
    let off = other.value - found.value;
    let end =
        |own: f64, end: f64| other.value + (2.0 * off / (own - found.value)).min(1.0) * (end - other.value);
    let [below, above] = other.interval.unwrap_or([other.value; 2]);
    let interval =
        if off > 0.0 { [low, high.max(end(high, above))] } else { [low.min(end(low, below)), high] };
    Measured { interval: Some(interval), ..found }
}

impl Walk {
    /// The walk, or no numbers where S is not the root-mean-square speed, D not the diffusion coefficient or
    /// P not the correlation time of the velocity: they differ by more than 1.25 of their half widths together. Smaller differences are in
    /// the intervals of the walk, so that no two intervals of one number are apart.
    ///
    /// A curve may be near the form with other numbers than those of the motion: translational noise raises
    /// its start, which the fit takes for speed; a motion that turns is slow to diffuse.
    ///
    /// # Checked by  tests/all/diffusion.rs: active Brownian motion with translational noise
    #[must_use]
    pub fn held_against(self, seen: &Seen<'_>) -> Self {
        let known = |answer: &Answer| answer.known();
        let pairs = [
            ("speed", known(&self.speed), Some(*seen.speed), "root-mean-square speed"),
            (
                "diffusion coefficient",
                known(&self.diffusion),
                known(seen.diffusion),
                "slope of the displacements",
            ),
            (
                "persistence time",
                known(&self.persistence),
                known(seen.time),
                "correlation time of the velocity",
            ),
        ];
        let apart = pairs.into_iter().find_map(|(name, walk, other, what)| {
            let (walk, other) = (walk?, other?);
            let half = libm::hypot(walk.half_width(), other.half_width());
            ((walk.value - other.value).abs() > APART * half + ROUND * other.value)
                .then(|| (name, four_digits(walk.value), what, four_digits(other.value)))
        });
        let Some((name, value, what, other)) = apart else { return self.reaching(seen) };
        let reason = format!(
            "a persistent random walk does not describe the motion (its {name} {value} is not the {what} {other})"
        );
        Self { curve: self.curve, deviation: self.deviation, ..Self::unknown(&reason) }
    }

    /// The walk with intervals that reach the other measured values of its numbers, and what these may be.
    fn reaching(self, seen: &Seen<'_>) -> Self {
        let reach = |walk: Answer, other: Option<Measured>| match (walk.known(), other) {
            (Some(found), Some(other)) => Answer::Known(toward(found, other)),
            _ => walk,
        };
        Self {
            speed: reach(self.speed, Some(*seen.speed)),
            diffusion: reach(self.diffusion, seen.diffusion.known()),
            persistence: reach(self.persistence, seen.time.known()),
            ..self
        }
    }

    /// The walk with the part of its coefficient that slower quantities of the same bodies may add beyond the window; no numbers where the
    /// slow part is why the coefficient of the displacements is not known: a persistent random walk has one time.
    #[must_use]
    pub(crate) fn beside(self, slow: Option<&Beyond>, displacements: &Answer) -> Self {
        let Some(slow) = slow else { return self };
        match displacements.reason() {
            Some(reason) if [slow.reason(), slow.bound()].iter().any(|other| other == reason) => {
                Self { curve: self.curve, deviation: self.deviation, ..Self::unknown(reason) }
            }
            Some(_) => self,
            None => {
                let wider = |answer: Answer| match answer.known() {
                    Some(found) => answer.at_least(found.half_width() + slow.part * found.value),
                    None => answer,
                };
                Self { persistence: wider(self.persistence), diffusion: wider(self.diffusion), ..self }
            }
        }
    }

    /// The walk, or no numbers where all bodies together have a mean velocity.
    #[must_use]
    pub(crate) fn carried(self, is_carried: bool) -> Self {
        if !is_carried {
            return self;
        }
        let reason = "all bodies together have a mean velocity, and no random walk has one";
        Self { curve: self.curve, deviation: self.deviation, ..Self::unknown(reason) }
    }
}
