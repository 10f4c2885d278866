//! The number of starts that blow up, the times when they do, and their rate of escape from chaos.

use super::Samples;
use super::population::Population;
use crate::analyse;
use motiform_analysis::{Lyapunov, Regime, Share, Stay, Verdict, escape_limits};
use motiform_dynamics::Watch;
use motiform_dynamics::drive::drive;
use motiform_dynamics::sample::ascending;
use motiform_dynamics::{Outcome, Request, StopOnly};
use motiform_kernels::Kernel;
use motiform_study::{Error, RunPlan};
use serde::Serialize;

/// Maximum number of chaotic starts that are followed: enough for a rate, and fast.
const FOLLOWED: usize = 32;

/// The results for starts that blow up, or are chaotic and may do so.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Escapes {
    /// Starts that blew up during classification, or within the first look.
    pub at_once: usize,
    /// Chaotic starts that were followed further.
    pub followed: usize,
    /// Number of these that blew up.
    pub lost: usize,
    /// Chaotic starts that were not followed.
    pub left_out: usize,
    /// The time to which chaotic starts were followed.
    pub until: f64,
    /// Time of the first blow-up (model time since the start).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub first: Option<f64>,
    /// Median time of the blow-ups.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub median: Option<f64>,
    /// Time of the last one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub last: Option<f64>,
    /// The rate at which orbits leave the chaotic set; absent if no chaos was observed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rate: Option<EscapeLimits>,
}

/// An escape rate with its exact 95 % limits (inverse model time).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct EscapeLimits {
    /// Escapes per observation time.
    pub value: f64,
    /// Lower limit; 0 if there was no escape.
    pub lower: f64,
    /// Upper limit.
    pub upper: f64,
    /// Escapes that count: those after the first look of the model, when orbits are near the chaotic set.
    pub escapes: usize,
    /// Observation time, summed over the orbits.
    pub watched: f64,
}

impl Escapes {
    /// The results for starts with these verdicts. Chaotic ones are followed to the end of the budget, up to 32 of them, where that
    /// is cheap (models that run in lanes; others count for the time of their verdict). `Ok(None)` if nothing blew up and nothing is
    /// chaotic, and if the watch stopped it.
    ///
    /// # Errors
    /// Input that only the numerics can reject.
    pub fn of_verdicts(
        plan: &RunPlan,
        samples: Samples,
        verdicts: &[Verdict],
        budget: f64,
        watch: &dyn Watch,
    ) -> Result<Option<Self>, Error> {
        let until = analyse::settings(plan, budget)?.budget;
        let is = |regime| move |entry: &(usize, &Verdict)| entry.1.regime == regime;
        let all = || verdicts.iter().enumerate();
        let gone: Vec<f64> =
            all().filter(is(Regime::BlowUp)).map(|(_, v)| v.escape_time.unwrap_or(v.time)).collect();
        let chaotic: Vec<usize> = all().filter(is(Regime::Chaotic)).map(|(sample, _)| sample).collect();
        let population = Population::new(plan, samples, watch)?;
        let look = plan.look()?;
        if Kernel::of(population.model.as_ref()).is_none() {
            let seen = |&sample: &usize| Stay { time: verdicts[sample].time, escaped: false };
            let stays: Vec<Stay> = chaotic.iter().map(seen).collect();
            let until = stays.iter().map(|stay| stay.time).fold(0.0, f64::max);
            return Ok(Self::new(&gone, &stays, 0, until, look));
        }
        let asked: Vec<usize> = chaotic.iter().copied().take(FOLLOWED).collect();
        let left_out = chaotic.len() - asked.len();
        let stays = follow(plan, &population.among(asked), until)?;
        Ok(stays.and_then(|stays| Self::new(&gone, &stays, left_out, until, look)))
    }

    /// The results for orbits whose exponents were computed: those that blew up, and those along which neighbouring orbits separate
    /// exponentially.
    ///
    /// # Errors
    /// An unknown model.
    pub fn of_orbits(plan: &RunPlan, orbits: &[Lyapunov]) -> Result<Option<Self>, Error> {
        let chaotic =
            |orbit: &&Lyapunov| orbit.separates() || matches!(orbit.outcome, Outcome::Escaped { .. });
        let look = plan.look()?;
        let all = orbits.iter().filter(chaotic).filter_map(|orbit| stay(&orbit.outcome));
        // What leaves within the first look was never near chaos.
        let (at_once, stays): (Vec<Stay>, Vec<Stay>) =
            all.partition(|stay| stay.escaped && stay.time <= look);
        let gone: Vec<f64> = at_once.iter().map(|stay| stay.time).collect();
        let until = orbits.iter().map(|orbit| orbit.transient + orbit.time).fold(0.0, f64::max);
        Ok(Self::new(&gone, &stays, 0, until, look))
    }

    fn new(gone: &[f64], stays: &[Stay], left_out: usize, until: f64, look: f64) -> Option<Self> {
        if gone.is_empty() && stays.is_empty() {
            return None;
        }
        let lost = stays.iter().filter(|stay| stay.escaped);
        let mut times: Vec<f64> = lost.clone().map(|stay| stay.time).chain(gone.iter().copied()).collect();
        ascending(&mut times);
        Some(Self {
            at_once: gone.len(),
            followed: stays.len(),
            lost: lost.count(),
            left_out,
            until,
            first: times.first().copied(),
            median: times.get((times.len().max(1) - 1) / 2).copied(),
            last: times.last().copied(),
            rate: rate(gone, stays, look),
        })
    }

    /// All that blew up.
    pub fn escaped(&self) -> usize {
        self.at_once + self.lost
    }

    /// Returns `true` if chaos was observed to end: then it is transient, at least for some starts.
    pub fn chaos_ends(&self) -> bool {
        self.lost > 0
    }

    /// The number of starts, out of `of`, that blew up, by when, and what follows for the chaos: one line
    /// each.
    pub fn words(&self, of: usize) -> Vec<String> {
        let mut lines = vec![match (self.first, self.median, self.last) {
            (Some(first), Some(median), Some(last)) => format!(
                "at least {} of {of} starts blow up within {:.0} model time{}: the first at {first:.0}, half of them by {median:.0}, \
                 the last at {last:.0}",
                self.escaped(),
                self.until.max(last),
                Share::new(self.escaped(), of).map_or_else(String::new, |share| format!(
                    " ({:.0} to {:.0} %)",
                    100.0 * share.lower,
                    100.0 * share.upper
                )),
            ),
            _ => format!("none of {of} starts blows up within {:.0} model time", self.until),
        }];
        if self.followed > 0 {
            let others = match self.left_out {
                0 => String::new(),
                count => format!(" ({count} more were not followed)"),
            };
            lines.push(format!(
                "{} chaotic starts were followed to {:.0}{others}: {} of them blew up{}",
                self.followed,
                self.until,
                self.lost,
                if self.chaos_ends() { ", so this chaos is transient" } else { "" }
            ));
        }
        lines.extend(self.rate.map(|rate| rate.words()));
        lines
    }
}

impl EscapeLimits {
    fn words(&self) -> String {
        let Self { value, lower, upper, watched, .. } = self;
        if self.escapes == 0 {
            return format!(
                "rate of blow-up below {upper:.1e} (95 %; none in {watched:.0} model time): chaos blows up after {:.0} and more on \
                 average, if at all; ends in regular motion do not count here",
                1.0 / upper
            );
        }
        format!(
            "rate of blow-up {value:.1e} ({lower:.1e} to {upper:.1e}, 95 %): chaos stays {:.0} on average ({:.0} to {:.0}) before it \
             blows up",
            1.0 / value,
            1.0 / upper,
            1.0 / lower
        )
    }
}

/// The rate after the first look: orbits that leave earlier never came near the chaotic set.
fn rate(gone: &[f64], stays: &[Stay], look: f64) -> Option<EscapeLimits> {
    if stays.is_empty() {
        return None;
    }
    let gone = gone.iter().map(|&time| Stay { time, escaped: true });
    let late: Vec<Stay> = stays.iter().copied().chain(gone).filter(|stay| stay.time > look).collect();
    let escapes = late.iter().filter(|stay| stay.escaped).count();
    let watched: f64 = late.iter().map(|stay| stay.time - look).sum();
    let (lower, upper) = escape_limits(escapes, watched).ok()?;
    Some(EscapeLimits { value: escapes as f64 / watched, lower, upper, escapes, watched })
}

/// The time for which each member of the population remains, up to `until`; `None` if the watch stopped it.
fn follow(plan: &RunPlan, population: &Population<'_>, until: f64) -> Result<Option<Vec<Stay>>, Error> {
    let (method, c) = (plan.method()?, &plan.computation);
    let model = population.model.as_ref();
    population.run(|asked| {
        asked.one_by_one(|start| {
            let mut orbit = method.shape_orbit(model, c.control.into(), 0.0, start)?;
            let request = Request {
                max_steps: c.max_steps,
                escape_norm: c.escape_norm,
                watch: &StopOnly(population.watch),
                ..Request::until(until, start.len())
            };
            Ok(stay(&drive(orbit.as_mut(), &request, &mut ())?))
        });
    })
}

fn stay(outcome: &Outcome) -> Option<Stay> {
    match *outcome {
        Outcome::Interrupted { .. } => None,
        Outcome::Escaped { t, .. } => Some(Stay { time: t, escaped: true }),
        other => Some(Stay { time: other.t(), escaped: false }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stays(times: &[(f64, bool)]) -> Vec<Stay> {
        times.iter().map(|&(time, escaped)| Stay { time, escaped }).collect()
    }

    /// Two leave at once, before the first look; of three that are chaotic two leave after 100 and 300 more, one is still there
    /// after 600: two escapes in a time of 1000.
    #[test]
    fn escapes_are_counted_and_chaos_that_ends_is_transient() {
        let chaos = stays(&[(300.0, true), (500.0, true), (800.0, false)]);
        let found = Escapes::new(&[3.0, 5.0], &chaos, 0, 800.0, 200.0).unwrap();
        assert_eq!((found.escaped(), found.lost, found.at_once), (4, 2, 2));
        assert_eq!((found.first, found.median, found.last), (Some(3.0), Some(5.0), Some(500.0)));
        let rate = found.rate.unwrap();
        assert_eq!((rate.escapes, rate.watched, rate.value), (2, 1000.0, 2e-3));
        assert!((rate.lower - 0.2422e-3).abs() < 1e-7 && (rate.upper - 7.2247e-3).abs() < 1e-7);
        let words = found.words(6).join("\n");
        assert!(words.contains("at least 4 of 6 starts blow up within 800"), "{words}");
        assert!(words.contains("this chaos is transient"), "{words}");
    }

    #[test]
    fn chaos_that_stays_has_an_upper_limit() {
        let found = Escapes::new(&[], &stays(&[(1200.0, false), (1200.0, false)]), 0, 1200.0, 200.0).unwrap();
        let rate = found.rate.unwrap();
        assert_eq!((rate.value, rate.lower), (0.0, 0.0));
        assert!((rate.upper - 3.6889 / 2000.0).abs() < 1e-6);
        let words = found.words(2).join("\n");
        assert!(
            words.starts_with("none of 2 starts blows up within 1200") && !words.contains("transient"),
            "{words}"
        );
    }

    /// An exponent of two and a half errors is no chaos, and neither is a growth by e^8: no orbit is watched for its escape.
    #[test]
    fn orbits_count_as_chaotic_by_the_rule_of_the_classifier() {
        let plan = RunPlan::new(&motiform_study::Study::parse("preset = \"fig5b\"", "text", "test").unwrap())
            .unwrap();
        let orbit = |value, error, time| Lyapunov {
            exponents: vec![motiform_analysis::Estimate { value, error }],
            widened: false,
            neutral: 2,
            silent: Vec::new(),
            history: Vec::new(),
            reduced_speeds: Vec::new(),
            time,
            transient: 100.0,
            outcome: Outcome::Completed { t: 100.0 + time },
            shape: Vec::new(),
        };
        let followed = |all: &[Lyapunov]| Escapes::of_orbits(&plan, all).unwrap().map(|found| found.followed);
        assert_eq!(followed(&[orbit(0.05, 0.02, 1e4), orbit(0.008, 1e-4, 1000.0)]), None);
        assert_eq!(followed(&[orbit(0.07, 0.02, 1e4), orbit(0.012, 1e-4, 1000.0)]), Some(2));
    }

    #[test]
    fn nothing_that_could_escape_is_nothing_to_say() {
        assert_eq!(Escapes::new(&[], &[], 0, 100.0, 200.0), None);
        let direct = Escapes::new(&[4.0], &[], 0, 4.0, 200.0).unwrap();
        assert_eq!((direct.rate, direct.chaos_ends(), direct.words(1).len()), (None, false, 1));
    }
}
