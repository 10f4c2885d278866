//! Transient chaos: the exponent of the chaotic saddle, and the rate at which orbits leave it.

use crate::analyse::{self, Spans};
use crate::captured::{LAST_LOOKS, captured, is_regular, slow, way};
use crate::pool::spread;
use motiform_analysis::{
    Estimate, Lyapunov, LyapunovSettings, Stay, SurvivalStep, classify, escape_rate, lyapunov, survival,
};
use motiform_dynamics::digits::four_digits;
use motiform_dynamics::distributions::student_quantile;
use motiform_dynamics::{Model, Outcome, StopOnly, Watch};
use motiform_study::plan::check;
use motiform_study::{Error, Plan, Random, Scales};
use serde::Serialize;

/// The fraction of a first look that is excluded before an escape: there the orbit is escaping and no longer chaotic.
const WAY_OUT: f64 = 0.25;

/// The properties of a chaotic saddle from many runs with random starts.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Saddle {
    /// Largest exponent of the chaos (inverse model time), with its 95 % error from the spread over the runs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exponent: Option<Estimate>,
    /// The reason why there is no exponent of a chaotic saddle: none of the runs left the chaos, or none was chaotic.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub missing: String,
    /// Escape rate kappa (inverse model time) of the exponential tail, with its 95 % error.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rate: Option<Estimate>,
    /// Runs.
    pub runs: usize,
    /// Runs that escaped.
    pub escaped: usize,
    /// Runs that came to rest at a stable steady motion: they have left, too.
    pub captured: usize,
    /// Runs that moved regularly at the end, not steadily, since an unknown time: they do not count.
    pub regular: usize,
    /// Maximum observation time of each.
    pub t_end: f64,
    /// The share that remains, over time.
    #[serde(skip)]
    pub survival: Vec<SurvivalStep>,
}

impl Saddle {
    /// Returns `true` if the exponent is that of a chaotic saddle: it is above its error, and runs leave.
    pub fn is_one(&self) -> bool {
        self.exponent.is_some() && self.missing.is_empty()
    }
}

/// The end of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
enum End {
    BlewUp,
    /// Close to a stable steady motion, since this time; it takes the other to come there from far away.
    Captured(f64, f64),
    Regular,
    Stayed,
}

/// The chaotic saddle of a plan's parameters: `samples` runs of `t_end` at most (default: ten looks of the model) from starts drawn by
/// `random`, growth counted from `transient` (default: half a look) to a quarter of a look before a blow-up. Where runs are captured by a
/// stable steady motion, twice the longest way into it is left out before each capture, and before the end of runs that are not captured:
/// they may be on the way. Runs that move regularly at the end do not count. Both ends are those of
/// [`crate::lifetimes::lifetimes`].
///
/// lambda_1 = sum of growth / sum of time over all stretches; its error is that of a ratio of sums over independent runs. Where it is not
/// above its error, or no run leaves, there is no chaotic saddle, and `missing` says what there is.
/// `None` if the watch stopped it.
///
/// # Errors
/// Fewer than two runs; times that are none, or longer than the longest one ([`motiform_study::Scales::longest`]).
///
/// # Checked by  tests/all/saddle.rs: Lorenz's equations below and above the chaos
pub fn saddle(
    plan: &Plan,
    samples: usize,
    random: Random,
    spans: Spans,
    threads: usize,
    watch: &dyn Watch,
) -> Result<Option<Saddle>, Error> {
    check("runs", samples as f64, samples > 1, "give at least 2")?;
    let (info, look, c) = (plan.info()?, plan.look()?, &plan.computation);
    let model = analyse::model(plan)?;
    let [transient, t_end] =
        [spans.transient.unwrap_or(0.5 * look), spans.t_end.unwrap_or(10.0 * look)].map(Some);
    let settings = analyse::lyapunov_settings(plan, 1, Spans { transient, t_end })?;
    let values = c.parameters.values();
    let budget = LAST_LOOKS * look;
    let last =
        analyse::settings_of(info, &values, settings.method, c.control, c.escape_norm, c.max_steps, budget);
    let size = Scales::typical(info, &values)?;
    let one = |sample: usize| {
        let start = random.shape(info, model.as_ref(), c.seed, sample as u64 + 1);
        let found = lyapunov(model.as_ref(), &start, &settings, &StopOnly(watch))?;
        let end = match found.outcome {
            Outcome::Interrupted { .. } => return Ok(None),
            Outcome::Escaped { .. } => Some(End::BlewUp),
            Outcome::Completed { .. } => since(model.as_ref(), &found, size),
            _ => Some(End::Stayed),
        };
        if let Some(end) = end {
            return Ok(Some((found, end)));
        }
        let verdict = classify(model.as_ref(), &found.shape, &last, &StopOnly(watch))?;
        let end = verdict.map(|verdict| if is_regular(&verdict) { End::Regular } else { End::Stayed });
        Ok(end.map(|end| (found, end)))
    };
    let runs = spread(samples, threads, watch, |jobs| jobs.each(one))?;
    runs.map(|runs| summarise(&runs, &settings, WAY_OUT * look)).transpose()
}

/// The capture of a completed run, since the last interval after which the shape changed faster than at the distance of a capture.
fn since(model: &dyn Model, run: &Lyapunov, size: f64) -> Option<End> {
    let steady = captured(model, &run.shape, size)?;
    let slow = slow(&steady, size);
    let last = run.reduced_speeds.iter().rposition(|speed| *speed > slow);
    Some(End::Captured(last.map_or(run.transient, |place| run.history[place].0), way(-steady.growth())))
}

fn summarise(runs: &[(Lyapunov, End)], settings: &LyapunovSettings, way_out: f64) -> Result<Saddle, Error> {
    let count = |is: fn(&End) -> bool| runs.iter().filter(|(_, end)| is(end)).count();
    let counted = || runs.iter().filter(|(_, end)| *end != End::Regular);
    let stay = |(run, end): &(Lyapunov, End)| match end {
        End::Captured(since, _) => Stay { time: *since, escaped: true },
        end => Stay { time: run.outcome.t(), escaped: *end == End::BlewUp },
    };
    let stays: Vec<Stay> = counted().map(stay).collect();
    // a spiral into a steady motion takes up to twice the time of the linear one, and some runs end within theirs
    let ways = runs.iter().map(|(_, end)| if let End::Captured(_, way) = end { 2.0 * way } else { 0.0 });
    let way = ways.fold(0.0, f64::max);
    let until = |(run, end): &(Lyapunov, End)| match end {
        End::BlewUp => run.outcome.t() - way_out,
        End::Captured(since, _) => since - way,
        _ => run.outcome.t() - way,
    };
    let stretches: Vec<(f64, f64)> = counted().map(|run| stretch(&run.0, until(run), settings)).collect();
    let exponent = ratio(&stretches);
    let chaotic = exponent.filter(|found| found.value > found.error);
    let left = stays.iter().any(|stay| stay.escaped);
    let delay = settings.transient.max(way);
    let rate = chaotic.and_then(|_| escape_rate(&stays, delay).ok()).map(|found| found.rate);
    Ok(Saddle {
        exponent: chaotic,
        missing: missing(exponent, left, way, &runs.iter().map(|run| &run.0).collect::<Vec<_>>()),
        rate,
        runs: runs.len(),
        escaped: count(|end| *end == End::BlewUp),
        captured: count(|end| matches!(end, End::Captured(..))),
        regular: count(|end| *end == End::Regular),
        t_end: settings.transient + settings.span,
        survival: if stays.is_empty() { Vec::new() } else { survival(&stays)? },
    })
}

/// The reason why the exponent is that of no chaotic saddle; nothing where it is.
fn missing(exponent: Option<Estimate>, left: bool, way: f64, runs: &[&Lyapunov]) -> String {
    let with = |found: Estimate| format!("{:.5} +- {:.1e}", found.value, found.error);
    match exponent {
        Some(found) if found.value > found.error && left => String::new(),
        Some(found) if found.value > found.error => {
            "no chaotic saddle is seen: no run left, so that the exponent is that of a chaotic \
                                                     attractor, or of a saddle whose lives are longer"
                .to_owned()
        }
        Some(found) => {
            format!(
                "no chaotic saddle: the largest exponent {} of the runs before they left is not above its error",
                with(found)
            )
        }
        None => {
            let all: Vec<(f64, f64)> = runs
                .iter()
                .filter_map(|run| Some((run.exponents.first()?.value * run.time, run.time)))
                .collect();
            let ends = ratio(&all).map_or(String::new(), |found| {
                format!(
                    "; the largest exponent of the runs that lasted is {}, that of what they end in",
                    with(found)
                )
            });
            let before = match way > 0.0 {
                true => format!(
                    " and before the last {} model time, the way into the steady motion",
                    four_digits(way)
                ),
                false => String::new(),
            };
            format!(
                "no chaotic saddle is seen: fewer than eight runs were chaotic after the transient{before}{ends}"
            )
        }
    }
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
