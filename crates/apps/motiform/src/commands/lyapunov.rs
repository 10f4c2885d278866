//! `motiform lyapunov`.

use crate::args::LyapunovOptions;
use crate::commands::subject;
use crate::output::{End, say, warn};
use crate::progress::Progress;
use motiform_dynamics::Outcome;
use motiform_lab::analyse::{self, Spans};
use motiform_lab::answers::{Exponents, MeanExponents};
use motiform_lab::pool::all_cores;
use motiform_lab::saddle::saddle as find_saddle;
use motiform_lab::samples::{self, Escapes, Samples, Starts};
use motiform_study::{Plan, Random};

/// Default number of exponents.
const COUNT: usize = 6;

const BEFORE_AN_ESCAPE: &str = "for the exponent of chaos before an escape, use --saddle 200";

pub(crate) fn run(options: &LyapunovOptions) -> anyhow::Result<End> {
    let study = subject::motion(&options.motion)?;
    let runs =
        options.saddle.map(|runs| study.starts(1).map(|random| (usize::from(runs), random))).transpose()?;
    let (plan, samples) = subject::plan(study, &options.many)?;
    if let Some((runs, random)) = runs {
        return saddle(options, &plan, runs, random);
    }
    let dim = plan.computation.initial.0.len() - 2;
    let count = options.count.map_or(COUNT.min(dim), usize::from);
    if let Some(samples) = samples {
        return many(options, &plan, samples, count);
    }
    let look = plan.look()?;
    let total = options.transient.unwrap_or(4.0 * look) + options.t_end.unwrap_or(20.0 * look);
    let watch = Progress::new(total, "model time");
    let found = watch.over(|watch| analyse::lyapunov(&plan, count, spans(options), watch))?;
    say(&Exponents::new(&plan, &found)?, options.motion.json)?;
    if found.exponents.is_empty() && matches!(found.outcome, Outcome::Escaped { .. }) {
        warn(BEFORE_AN_ESCAPE);
    }
    Ok(if found.without_error().is_some() { End::NotAsAsked } else { End::from(&found.outcome) })
}

fn spans(options: &LyapunovOptions) -> Spans {
    Spans { transient: options.transient, t_end: options.t_end }
}

/// `--samples`: the exponents of many orbits.
fn many(options: &LyapunovOptions, plan: &Plan, samples: Samples, count: usize) -> anyhow::Result<End> {
    let watch = Progress::new(samples.count as f64, "orbits");
    let found = watch.over(|watch| samples::lyapunov(plan, samples, count, spans(options), watch));
    let Some(found) = found? else { return Ok(End::Interrupted) };
    let (starts, escapes) = (Starts::of(&samples), Escapes::of_orbits(plan, &found.orbits)?);
    let answer = MeanExponents::new(plan, &found, &starts, escapes.as_ref());
    say(&answer, options.motion.json)?;
    if found.orbits.iter().any(|orbit| !orbit.outcome.is_complete()) {
        warn(BEFORE_AN_ESCAPE);
    }
    if !found.agree {
        warn("`motiform classify --samples` names the motions to which the orbits lead");
    }
    Ok(if answer.is_whole() { End::Done } else { End::NotAsAsked })
}

/// `--saddle`: the exponent of transient chaos.
fn saddle(options: &LyapunovOptions, plan: &Plan, runs: usize, random: Random) -> anyhow::Result<End> {
    let watch = Progress::new(runs as f64, "runs");
    let found = watch.over(|watch| find_saddle(plan, runs, random, spans(options), all_cores(), watch));
    let Some(found) = found? else { return Ok(End::Interrupted) };
    say(&found, options.motion.json)?;
    Ok(if found.is_one() { End::Done } else { End::NotAsAsked })
}
