//! The law that mean lives follow.

use super::laws::spread;
use super::{ExponentialLife, LifeCount, Memory, PowerLawLife};
use crate::{Result, checks};
use motiform_dynamics::digits::value_and_error;
use serde::Serialize;

/// A difference of Akaike's criteria that decides: e^3, about 20, in likelihood, beyond the price of parameters.
///
/// Source: Burnham and Anderson (2002), Model Selection and Multimodel Inference, ch. 2.6: above 4 'considerably less', above 10
/// 'essentially no' support.
const DECISIVE: f64 = 6.0;

/// A law under which the counts have a smaller probability does not hold.
const IMPROBABLE: f64 = 1e-3;

/// The distribution of the test that lives are exponential is known down to this probability.
const SMALLEST: f64 = 1e-12;

/// Fewest events, values that were watched, and values with events.
const LEAST: (usize, usize, usize) = (20, 4, 3);

/// The law that mean lives follow, with both fits as far as they were made.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "answer", rename_all = "kebab-case")]
#[allow(missing_docs, reason = "laws, by their names")]
pub enum LifeLaws {
    /// The power law is far more likely: chaos becomes transient in a crisis.
    PowerLaw {
        power: PowerLawLife,
        exponential: ExponentialLife,
        /// Akaike's criterion of the other law minus that of this one.
        advantage: f64,
    },
    /// The exponential law is far more likely: no crisis within the range, nor near it.
    Exponential {
        exponential: ExponentialLife,
        power: PowerLawLife,
        /// Akaike's criterion of the other law minus that of this one.
        advantage: f64,
    },
    /// Neither is far more likely than the other.
    CannotBeToldApart {
        exponential: ExponentialLife,
        power: PowerLawLife,
        /// Akaike's criterion of the exponential law minus that of the power law.
        difference: f64,
    },
    /// Both laws are improbable.
    Neither { exponential: ExponentialLife, power: PowerLawLife },
    /// The lives at one value are not exponential: their ends have no rate, and no law of a mean life tells of a crisis.
    NotExponential(Memory),
    /// There are too few events or values for a comparison.
    TooFew {
        /// Events over all values.
        events: usize,
        /// Values of the parameter that were watched.
        values: usize,
        /// Those with events.
        with_events: usize,
        /// The numbers needed.
        needed: (usize, usize, usize),
    },
}

/// Compares two laws of the mean life tau against a parameter p: a crisis, tau = C |p - pc|^-gamma on one side of pc and infinite on the
/// other, and none, tau = C exp(-k p).
///
/// Counts are Poisson variables of mean watched / tau(p). Each law is fitted by maximum likelihood; the smaller Akaike criterion
/// (2 parameters - 2 ln L) wins if it is smaller by 6 or more. pc lies within the range of the values or beyond it by
/// the range's length at most: from further away a power law looks exponential. A law under which such counts have a probability below
/// 1e-3 (deviance, chi-square) does not hold; if both are, the answer is `Neither`. Values that were not watched do not count.
///
/// Source: Grebogi, Ott, Yorke (1986), Phys. Rev. Lett. 57, 1284 (power law of crises); Holford (1980), Biometrics 36, 299 (censored
/// exponential lives as Poisson counts); Akaike (1974), IEEE Trans. Autom. Control 19, 716.
///
/// # Errors    [`crate::Error::OutOfRange`] for values that are not finite, or negative times
/// # Checked by  tests/all/lifetime.rs: both laws, data that cannot decide, a law that is neither, intervals
pub fn compare_life_laws(counts: &[LifeCount]) -> Result<LifeLaws> {
    for count in counts {
        checks::argument("parameter", count.parameter, true, "that is finite")?;
        checks::argument("watched", count.watched, count.watched >= 0.0, "of at least 0")?;
    }
    let counts: Vec<LifeCount> = counts.iter().copied().filter(|count| count.watched > 0.0).collect();
    let (events, values) = (counts.iter().map(|count| count.events).sum(), counts.len());
    let with_events = counts.iter().filter(|count| count.events > 0).count();
    if events < LEAST.0 || values < LEAST.1 || with_events < LEAST.2 || spread(&counts) <= 0.0 {
        return Ok(LifeLaws::TooFew { events, values, with_events, needed: LEAST });
    }
    Ok(decide(ExponentialLife::fit(&counts), PowerLawLife::fit(&counts)))
}

fn decide(exponential: ExponentialLife, power: PowerLawLife) -> LifeLaws {
    let difference = exponential.goodness.aic() - power.goodness.aic();
    let improbable = |probability: f64| probability < IMPROBABLE;
    if improbable(exponential.goodness.probability()) && improbable(power.goodness.probability()) {
        LifeLaws::Neither { exponential, power }
    } else if difference >= DECISIVE {
        LifeLaws::PowerLaw { power, exponential, advantage: difference }
    } else if difference <= -DECISIVE {
        LifeLaws::Exponential { exponential, power, advantage: -difference }
    } else {
        LifeLaws::CannotBeToldApart { exponential, power, difference }
    }
}

impl LifeLaws {
    /// The answer, or none where the lives themselves are not exponential, with a probability below 1e-3: both laws are those of a set that
    /// loses its orbits at a constant rate.
    #[must_use]
    pub fn held_against(self, memory: Option<Memory>) -> Self {
        match (self, memory) {
            (Self::TooFew { events, values, with_events, needed }, _) => {
                Self::TooFew { events, values, with_events, needed }
            }
            (_, Some(memory)) if memory.probability < IMPROBABLE => Self::NotExponential(memory),
            (laws, _) => laws,
        }
    }

    /// Both fits, the exponential law first; `None` if there are too few events.
    pub fn fits(&self) -> Option<(&ExponentialLife, &PowerLawLife)> {
        match self {
            Self::PowerLaw { power, exponential, .. }
            | Self::Exponential { exponential, power, .. }
            | Self::CannotBeToldApart { exponential, power, .. }
            | Self::Neither { exponential, power } => Some((exponential, power)),
            Self::TooFew { .. } | Self::NotExponential(_) => None,
        }
    }

    /// The answer in a sentence, with times of the model.
    pub fn words(&self) -> String {
        self.words_in(1.0, "")
    }

    /// The answer in a sentence, with times in a unit: its name, and how many of it a time unit of the model is.
    pub fn words_in(&self, factor: f64, unit: &str) -> String {
        let time =
            |time: f64| format!("{:.3e}{}{unit}", factor * time, if unit.is_empty() { "" } else { " " });
        match self {
            Self::PowerLaw { power, advantage, .. } => {
                format!(
                    "a power law, so a crisis if the motion before is chaotic (its largest exponent on the saddle is above 0): {} \
                     (AIC better by {advantage:.1})",
                    power.words(&time)
                )
            }
            Self::Exponential { exponential, advantage, .. } => format!(
                "an exponential law, so no crisis within the range or near it: {} (AIC better by {advantage:.1})",
                exponential.words(&time)
            ),
            Self::CannotBeToldApart { exponential, power, difference } => format!(
                "the laws cannot be told apart (AIC of the exponential law minus that of the power law {difference:+.1}; \
                 {DECISIVE} would decide): {}; or {}",
                exponential.words(&time),
                power.words(&time)
            ),
            Self::Neither { exponential, power } => format!(
                "neither law holds (probabilities {:.0e} and {:.0e}): {}; {}",
                exponential.goodness.probability(),
                power.goodness.probability(),
                exponential.words(&time),
                power.words(&time)
            ),
            Self::NotExponential(Memory { probability, events, place }) => format!(
                "none: the lives are not exponential (p = {:.0e}, {events} ends of lives), but end {} often as time goes on, \
                 so that they have no rate and there is no law of a crisis, and the limits of the mean lives do not hold",
                probability.max(SMALLEST),
                if *place < 0.5 { "less and less" } else { "more and more" }
            ),
            Self::TooFew { events, values, with_events, needed } => format!(
                "too few events to compare laws: {events} at {with_events} of {values} values; it needs {}, at {} of at least {} values",
                needed.0, needed.2, needed.1
            ),
        }
    }
}

impl ExponentialLife {
    fn words(&self, time: &dyn Fn(f64) -> String) -> String {
        let Self { k, at, life, .. } = self;
        let rate = value_and_error(k.value, k.error, 2).join(" +- ");
        format!("tau = {} exp(-k (p - {at:.5})), k = {rate}", time(life.value))
    }
}

impl PowerLawLife {
    fn words(&self, time: &dyn Fn(f64) -> String) -> String {
        let Self { critical, exponent, coefficient, above, .. } = self;
        let end = |end: Option<f64>| end.map_or("no limit".to_owned(), |end| format!("{end:.5}"));
        let side = if *above { "p - pc" } else { "pc - p" };
        let gamma = match exponent.error.is_finite() {
            true => value_and_error(exponent.value, exponent.error, 2).join(" +- "),
            false => format!("{:.3} +- unknown", exponent.value),
        };
        let coefficient = time(*coefficient);
        if critical.at_end {
            let nearest = end(if *above { critical.upper } else { critical.lower });
            return format!(
                "tau = {coefficient} ({side})^-gamma with pc = {:.5}, the end of the range that was searched: pc is not determined \
                 ({nearest} or further away), nor is gamma ({:.3} there)",
                critical.value, exponent.value
            );
        }
        format!(
            "tau = {coefficient} ({side})^-gamma, pc = {:.5} ({} to {}), gamma = {gamma}",
            critical.value,
            end(critical.lower),
            end(critical.upper),
        )
    }
}
