//! Analyses of many initial states: which motions exist, and do the orbits agree?

mod escapes;
mod population;
mod shares;

use crate::analyse::{self, Body, Spans};
pub use escapes::{EscapeLimits, Escapes};
use motiform_analysis::lyapunov::power_of_time;
use motiform_analysis::regime::{Course, Settings, Verdict, classifies_in_lanes};
use motiform_analysis::{Estimate, Lyapunov, LyapunovSettings};
use motiform_dynamics::Watch;
use motiform_dynamics::distributions::NORMAL_95;
use motiform_dynamics::{Outcome, StopOnly, in_words};
use motiform_kernels::{Kernel, Row, classify_rows, exponents_of_body, has_exponents};
use motiform_study::plan::check;
use motiform_study::{Error, Random, RunPlan};
use population::{Asked, Population};
use serde::Serialize;
pub use shares::{Basins, MotionShare, Starts};
use std::collections::BTreeMap;

/// The initial states: that of the plan, then random ones.
#[derive(Clone, Copy, Debug)]
pub struct Samples {
    /// Their number.
    pub count: usize,
    /// The distribution of the random ones: that of the plan's own, unless that one was given.
    pub random: Random,
    /// `true` if the plan's own initial state was given and not drawn.
    pub given: bool,
    /// Threads.
    pub threads: usize,
}

impl Samples {
    fn check(&self) -> Result<(), Error> {
        check("samples", self.count as f64, self.count > 0, "give at least 1")?;
        self.random.check()
    }
}

/// The motions that the samples lead to, in their order; `None` if the watch stopped it. Verdicts are those of
/// [`analyse::classify`] for each initial state.
///
/// # Errors
/// Input that only the numerics can reject.
pub fn classify(
    plan: &RunPlan,
    samples: Samples,
    budget: f64,
    watch: &dyn Watch,
) -> Result<Option<Vec<Verdict>>, Error> {
    samples.check()?;
    let settings = analyse::settings(plan, budget)?;
    let population = Population::new(plan, samples, watch)?;
    let kernel = Kernel::of(population.model.as_ref()).filter(|_| classifies_in_lanes(&settings));
    let (info, values) = (plan.info()?, plan.computation.parameters.values());
    let body = Body { info, values, model: population.model.as_ref() };
    population.run(|asked| match kernel {
        Some(kernel) => classify_in_lanes(plan, kernel, &settings, asked),
        None => asked.one_by_one(|start| body.classify(start, &settings, &StopOnly(watch))),
    })
}

fn classify_in_lanes(
    plan: &RunPlan,
    kernel: Kernel,
    settings: &Settings,
    asked: &Asked<'_, '_, '_, Verdict>,
) {
    let mut next = || {
        let (key, start) = asked.next()?;
        let body = plan.body().ok()?;
        Some(Row { key, body, start })
    };
    let mut done = |key, found: motiform_analysis::Result<Option<Verdict>>| {
        asked.jobs.done(key, found.map_err(Error::from));
    };
    classify_rows(kernel, settings, &mut next, &mut done, &StopOnly(asked.population.watch));
}

/// Exponents of many orbits.
#[derive(Clone, Debug, PartialEq)]
pub struct Exponents {
    /// The result of each orbit, in the order of the samples.
    pub orbits: Vec<Lyapunov>,
    /// The means over the orbits that lasted, largest first; empty if none did. The error is the larger of those from the
    /// orbits' own errors and from their spread.
    pub means: Vec<Estimate>,
    /// `true` if the largest exponents of all orbits that lasted agree: if not, there are several attractors,
    /// and the means are not meaningful.
    pub agree: bool,
}

/// The exponents of the samples' orbits; `None` if the watch stopped it. Each is that of [`analyse::lyapunov`] for its
/// initial state.
///
/// # Errors
/// As [`analyse::lyapunov`].
pub fn lyapunov(
    plan: &RunPlan,
    samples: Samples,
    count: usize,
    spans: Spans,
    watch: &dyn Watch,
) -> Result<Option<Exponents>, Error> {
    samples.check()?;
    let settings = analyse::lyapunov_settings(plan, count, spans)?;
    let population = Population::new(plan, samples, watch)?;
    let in_lanes = has_exponents(population.model.as_ref(), &settings);
    let orbits = population.run(|asked| match in_lanes {
        true => exponents_in_lanes(&settings, asked),
        false => asked.one_by_one(|start| {
            let found =
                motiform_analysis::lyapunov(population.model.as_ref(), start, &settings, &StopOnly(watch))?;
            Ok((!matches!(found.outcome, Outcome::Interrupted { .. })).then_some(found))
        }),
    })?;
    Ok(orbits.map(|orbits| summarise(orbits.into_iter().map(Lyapunov::bounded).collect())))
}

impl Exponents {
    /// The reason why the means have no error; `None` if they have one, or there are none.
    pub fn without_error(&self) -> Option<String> {
        self.orbits.iter().find_map(Lyapunov::without_error)
    }
}

fn exponents_in_lanes(settings: &LyapunovSettings, asked: &Asked<'_, '_, '_, Lyapunov>) {
    let mut next = || asked.next();
    let mut done = |key, found: motiform_analysis::Result<Lyapunov>| {
        let lasted =
            |found: Lyapunov| (!matches!(found.outcome, Outcome::Interrupted { .. })).then_some(found);
        asked.jobs.done(key, found.map(lasted).map_err(Error::from));
    };
    let Population { model, watch, .. } = asked.population;
    exponents_of_body(model.as_ref(), settings, &mut next, &mut done, &StopOnly(*watch));
}

/// Largest exponents that differ by more than this many errors do not belong to one attractor.
const APART: f64 = 3.0;

fn summarise(orbits: Vec<Lyapunov>) -> Exponents {
    let lasted: Vec<&[Estimate]> =
        orbits.iter().map(|orbit| &orbit.exponents[..]).filter(|exponents| !exponents.is_empty()).collect();
    let count = lasted.first().map_or(0, |exponents| exponents.len());
    let time = orbits.iter().map(|orbit| orbit.time).fold(0.0, f64::max);
    let means: Vec<Estimate> = (0..count)
        .map(|place| mean(&lasted.iter().map(|exponents| exponents[place]).collect::<Vec<_>>(), time))
        .collect();
    let far = |exponents: &&[Estimate]| {
        let (own, mean) = (exponents[0], means[0]);
        (own.value - mean.value).abs() > APART * libm::hypot(own.error, mean.error)
    };
    let agree = !lasted.iter().any(far);
    Exponents { agree, means, orbits }
}

/// The mean of independent estimates over a time with its 95 % error; growth that may be a power of time has no smaller one in the mean of
/// many.
fn mean(estimates: &[Estimate], time: f64) -> Estimate {
    let n = estimates.len() as f64;
    let value = estimates.iter().map(|estimate| estimate.value).sum::<f64>() / n;
    let own = estimates.iter().map(|estimate| estimate.error * estimate.error).sum::<f64>().sqrt() / n;
    let squares: f64 =
        estimates.iter().map(|estimate| (estimate.value - value) * (estimate.value - value)).sum();
    let spread = if estimates.len() > 1 { NORMAL_95 * (squares / (n - 1.0) / n).sqrt() } else { 0.0 };
    let secular = if value.abs() * time < power_of_time(1) { value.abs() } else { 0.0 };
    Estimate { value, error: own.max(spread).max(secular) }
}

/// A motion as samples are counted: where a model tells left from right, or has a field, each course is a motion of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Named {
    /// The regime.
    pub regime: &'static str,
    /// Its course, if it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub course: Option<Course>,
}

impl Named {
    /// The motion of a verdict.
    pub fn of(verdict: &Verdict) -> Self {
        Self { regime: verdict.regime.name(), course: verdict.course }
    }
}

impl std::fmt::Display for Named {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&in_words(self.regime))?;
        self.course.map_or(Ok(()), |course| write!(f, ", {}", course.words()))
    }
}

/// The number of samples that lead to each motion, the most frequent first.
pub fn motions(verdicts: &[Verdict]) -> Vec<(Named, usize)> {
    let mut counts: BTreeMap<_, (Named, usize)> = BTreeMap::new();
    for verdict in verdicts {
        let course = verdict.course.map(Course::name);
        counts.entry((verdict.regime, course)).or_insert((Named::of(verdict), 0)).1 += 1;
    }
    let mut counts: Vec<_> = counts.into_values().collect();
    counts.sort_by_key(|entry| std::cmp::Reverse(entry.1)); // stable: the order of legends
    counts
}

#[cfg(test)]
mod tests {
    use super::*;
    use motiform_study::Study;

    fn plan(text: &str) -> RunPlan {
        RunPlan::new(&Study::parse(text, "text", "test").unwrap()).unwrap()
    }

    fn samples(count: usize, threads: usize) -> Samples {
        Samples { count, random: 0.1.into(), given: false, threads }
    }

    /// Many together, in lanes and on threads, are each by itself, to the bit.
    #[test]
    fn verdicts_are_those_of_each_initial_state() {
        for text in ["preset = \"fig5b\"", "preset = \"fig5b\"\n[run]\nstepper = \"dopri5\""] {
            let plan = plan(text);
            let found = classify(&plan, samples(5, 2), 0.0, &()).unwrap().unwrap();
            assert_eq!(found, classify(&plan, samples(5, 1), 0.0, &()).unwrap().unwrap());
            assert_eq!(found[0], analyse::classify(&plan, 0.0, &()).unwrap().unwrap());
            let population = Population::new(&plan, samples(5, 1), &()).unwrap();
            let settings = analyse::settings(&plan, 0.0).unwrap();
            let alone = motiform_analysis::classify(
                population.model.as_ref(),
                &population.start(3).unwrap(),
                &settings,
                &(),
            )
            .unwrap();
            assert_eq!(found[3], alone.unwrap());
            assert_eq!(motions(&found)[0], (Named { regime: "chaotic", course: None }, 5));
        }
    }

    #[test]
    fn exponents_are_those_of_each_orbit_and_their_mean_is_sharper() {
        let (plan, spans) =
            (plan("preset = \"fig5b\""), Spans { transient: Some(100.0), t_end: Some(1000.0) });
        let found = lyapunov(&plan, samples(12, 2), 6, spans, &()).unwrap().unwrap();
        assert_eq!(found.orbits[0], analyse::lyapunov(&plan, 6, spans, &()).unwrap());
        let population = Population::new(&plan, samples(12, 1), &()).unwrap();
        let settings = analyse::lyapunov_settings(&plan, 6, spans).unwrap();
        let alone = motiform_analysis::lyapunov(
            population.model.as_ref(),
            &population.start(7).unwrap(),
            &settings,
            &(),
        );
        assert_eq!(found.orbits[7], alone.unwrap().bounded());
        assert!(found.agree && found.means[0].error < 0.6 * found.orbits[0].exponents[0].error);
        let fewer = lyapunov(&plan, samples(3, 2), 2, spans, &()).unwrap().unwrap();
        assert_eq!(
            fewer.orbits[2],
            lyapunov(&plan, samples(3, 1), 2, spans, &()).unwrap().unwrap().orbits[2]
        );
    }

    /// One orbit of another motion among many is seen.
    #[test]
    fn orbits_of_two_attractors_do_not_agree() {
        let estimate = |value, error| Estimate { value, error };
        let one = mean(&[estimate(1.0, 0.3), estimate(1.2, 0.4)], 1e6);
        assert!((one.value - 1.1).abs() < 1e-15 && (one.error - 0.25).abs() < 1e-15);
        let spread = mean(&[estimate(0.0, 1e-3), estimate(1.0, 1e-3)], 1e6);
        assert!((spread.error - NORMAL_95 * 0.5).abs() < 1e-12);
        let orbit = |value| Lyapunov {
            exponents: vec![estimate(value, 0.01)],
            widened: false,
            neutral: 1,
            silent: Vec::new(),
            history: Vec::new(),
            reduced_speeds: Vec::new(),
            time: 1e6,
            transient: 0.0,
            outcome: Outcome::Completed { t: 1e6 },
            shape: Vec::new(),
        };
        assert!(summarise(vec![orbit(0.5), orbit(0.51)]).agree);
        let population = [0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.0].map(orbit).to_vec();
        assert!(!summarise(population).agree);
    }

    struct Stopped;

    impl Watch for Stopped {
        fn stopped(&self) -> bool {
            true
        }
    }

    #[test]
    fn a_stop_is_heard_and_nonsense_refused() {
        let plan = plan("preset = \"fig5b\"");
        assert_eq!(classify(&plan, samples(4, 2), 0.0, &Stopped).unwrap(), None);
        assert_eq!(lyapunov(&plan, samples(4, 2), 6, Spans::default(), &Stopped).unwrap(), None);
        assert!(classify(&plan, samples(0, 1), 0.0, &()).is_err());
        assert!(lyapunov(&plan, samples(4, 1), 7, Spans::default(), &()).is_err());
    }
}
