//! Transient chaos: the exponent of the chaotic saddle, and the rate at which orbits leave it.

use crate::analyse;
use crate::pool::spread;
use motiform_analysis::{
    Estimate, Lyapunov, LyapunovSettings, Stay, SurvivalStep, escape_rate, lyapunov, survival,
};
use motiform_dynamics::Outcome;
use motiform_dynamics::distributions::student_quantile;
use motiform_dynamics::{StopOnly, Watch};
use motiform_study::{Error, Plan, Random};
use serde::Serialize;

/// The fraction of a first look that is excluded before an escape: there the orbit is escaping and no longer chaotic.
const WAY_OUT: f64 = 0.25;

/// The properties of a chaotic saddle from many runs with random starts.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Saddle {
    /// Largest exponent on the saddle (inverse model time), with its 95 % error from the spread over the runs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exponent: Option<Estimate>,
    /// The reason why there is none.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub missing: String,
    /// Escape rate kappa (inverse model time) of the exponential tail, with its 95 % error.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rate: Option<Estimate>,
    /// Runs.
    pub runs: usize,
    /// Runs that escaped.
    pub escaped: usize,
    /// Maximum observation time of each.
    pub t_end: f64,
    /// The share that remains, over time.
    #[serde(skip)]
    pub survival: Vec<SurvivalStep>,
}

/// The chaotic saddle of a plan's parameters: `samples` runs of `t_end` at most (default: ten looks of the model) from
/// random starts, growth counted from `transient` (default: half a look) to a quarter of a look before the escape.
///
/// lambda_1 = sum of growth / sum of time over all stretches; its error is that of a ratio of sums over independent runs.
/// `None` if the watch stopped it.
///
/// # Errors
/// Input that only the numerics can reject.
///
/// # Not     if a nonchaotic attractor attracts some of the runs: their stretches count as well (see `escaped`)
pub fn saddle(
    plan: &Plan,
    samples: usize,
    (transient, t_end): (Option<f64>, Option<f64>),
    threads: usize,
    watch: &dyn Watch,
) -> Result<Option<Saddle>, Error> {
    let (info, look, c) = (plan.info()?, plan.look()?, &plan.computation);
    let model = analyse::model(plan)?;
    let settings = LyapunovSettings {
        count: 1,
        method: plan.method()?,
        control: c.control.into(),
        transient: transient.unwrap_or(0.5 * look),
        span: t_end.unwrap_or(10.0 * look),
        escape_norm: c.escape_norm,
        max_steps: c.max_steps,
    };
    let one = |sample: usize| {
        let start = Random::SMALL.shape(info, model.as_ref(), c.seed, sample as u64 + 1);
        let found = lyapunov(model.as_ref(), &start, &settings, &StopOnly(watch))?;
        Ok((!matches!(found.outcome, Outcome::Interrupted { .. })).then_some(found))
    };
    let runs = spread(samples, threads, watch, |jobs| jobs.each(one))?;
    runs.map(|runs| summarise(&runs, &settings, WAY_OUT * look)).transpose()
}

fn summarise(runs: &[Lyapunov], settings: &LyapunovSettings, way_out: f64) -> Result<Saddle, Error> {
    let stay = |run: &Lyapunov| match run.outcome {
        Outcome::Escaped { t, .. } => Stay { time: t, escaped: true },
        other => Stay { time: other.t(), escaped: false },
    };
    let stays: Vec<Stay> = runs.iter().map(stay).collect();
    let stretches: Vec<(f64, f64)> = runs
        .iter()
        .zip(&stays)
        .map(|(run, stay)| {
            stretch(run, if stay.escaped { stay.time - way_out } else { f64::INFINITY }, settings)
        })
        .collect();
    let exponent = ratio(&stretches);
    let missing =
        if exponent.is_some() { "" } else { "too few runs stayed long enough; give a shorter transient" };
    Ok(Saddle {
        exponent,
        missing: missing.to_owned(),
        rate: escape_rate(&stays, settings.transient).ok().map(|found| found.rate),
        runs: runs.len(),
        escaped: stays.iter().filter(|stay| stay.escaped).count(),
        t_end: settings.transient + settings.span,
        survival: survival(&stays)?,
    })
}

/// Growth and duration of a run's chaotic stretch.
fn stretch(run: &Lyapunov, until: f64, settings: &LyapunovSettings) -> (f64, f64) {
    let mut before = settings.transient;
    let (mut growth, mut time) = (0.0, 0.0);
    for (t, rates) in run.history.iter().take_while(|entry| entry.0 <= until) {
        growth += rates[0] * (t - before);
        time += t - before;
        before = *t;
    }
    (growth, time)
}

/// `sum g / sum d` with its 95 % error, from at least eight runs.
fn ratio(stretches: &[(f64, f64)]) -> Option<Estimate> {
    let used: Vec<(f64, f64)> = stretches.iter().copied().filter(|stretch| stretch.1 > 0.0).collect();
    let time: f64 = used.iter().map(|stretch| stretch.1).sum();
    let value = used.iter().map(|stretch| stretch.0).sum::<f64>() / time;
    let squares: f64 = used.iter().map(|(g, d)| (g - value * d) * (g - value * d)).sum();
    let n = used.len() as f64;
    let error = student_quantile(used.len().max(2) - 1) * (squares * n / (n - 1.0)).sqrt() / time;
    (used.len() >= 8 && value.is_finite()).then_some(Estimate { value, error })
}
