//! `motiform lyapunov`.

use crate::args::{LyapunovOptions, all_cores};
use crate::commands::subject;
use crate::output::{End, estimate, print};
use crate::progress::Progress;
use motiform_analysis::{Estimate, Lyapunov};
use motiform_dynamics::Outcome;
use motiform_lab::saddle::{Saddle, saddle as find_saddle};
use motiform_lab::samples::{self, Escapes, Exponents, Samples, Starts};
use motiform_lab::{analyse, naming};
use motiform_study::{Error, Plan};
use serde_json::json;
use std::fmt::Write;

/// Default number of exponents.
const COUNT: usize = 6;

pub(crate) fn run(options: &LyapunovOptions) -> anyhow::Result<End> {
    let (plan, samples) = subject::plan(subject::motion(&options.motion)?, &options.many)?;
    let info = plan.info()?;
    for (key, value) in [("t_end", options.t_end), ("transient", options.transient)] {
        if let Some(value) = value.filter(|&value| value < 0.0 || key == "t_end" && value == 0.0) {
            return Err(Error::Setting {
                key,
                value: value.to_string(),
                remedy: "give a time above 0 (the transient may be 0)",
            }
            .into());
        }
    }
    if let Some(samples) = options.saddle {
        return saddle(options, &plan, usize::from(samples));
    }
    let dim = plan.computation.initial.0.len() - 2;
    let count = options.count.map_or(COUNT.min(dim), usize::from);
    if let Some(samples) = samples {
        return many(options, &plan, samples, count);
    }
    let total = options.transient.unwrap_or(4.0 * info.look) + options.t_end.unwrap_or(20.0 * info.look);
    let watch = Progress::new(total, "model time");
    let found = analyse::lyapunov(&plan, count, (options.transient, options.t_end), &watch);
    watch.finish();
    let found = found?;
    print(&if options.motion.json { json(&plan, &found)? } else { summary(&plan, &found)? })?;
    Ok(if found.without_error().is_some() { End::NotAsAsked } else { End::from(&found.outcome) })
}

fn json(plan: &Plan, found: &Lyapunov) -> anyhow::Result<String> {
    let mut object = json!({
        "model": plan.computation.model,
        "parameters": plan.computation.parameters,
        "control": plan.computation.control,
        "exponents": found.exponents,
        "zeros": found.zeros(),
        "neutral": found.neutral,
        "time": found.time,
        "transient": found.transient,
        "outcome": found.outcome,
    });
    if let Some(dimension) = found.dimension() {
        object["dimension"] = serde_json::to_value(dimension)?;
    }
    if let Some(why) = found.without_error() {
        object["without_error"] = why.into();
    }
    if let Some((motion, growth)) = naming::unstable_under(plan, found)? {
        object["unstable"] = json!({ "motion": motion, "growth": growth });
    }
    Ok(serde_json::to_string(&object)?)
}

fn summary(plan: &Plan, found: &Lyapunov) -> anyhow::Result<String> {
    let mut text = String::new();
    if found.exponents.is_empty() {
        write!(text, "no exponents: the run {}", found.outcome)?;
        if matches!(found.outcome, Outcome::Escaped { .. }) {
            write!(text, "\nFor the exponent of the chaos before the escape, use --saddle 200")?;
        }
        return Ok(text);
    }
    for (i, exponent) in found.exponents.iter().enumerate() {
        writeln!(text, "lambda_{}   {}", i + 1, estimate(exponent, 11, 6))?;
    }
    if let Some(why) = found.without_error() {
        writeln!(text, "no error   {why}")?;
    }
    let zeros = found.zeros();
    let worst = zeros.iter().map(|zero| zero.value.abs()).fold(0.0, f64::max);
    if found.neutral > 0 && found.exponents.len() > found.neutral {
        let (known, fine) = (
            zeros.iter().all(Estimate::has_error),
            zeros.iter().all(|zero| zero.value.abs() <= 3.0 * zero.error),
        );
        let verdict = match (known, fine) {
            (false, _) => "which is inconclusive: run longer",
            (true, true) => "within their errors (bounds, which decrease like 1/time)",
            (true, false) => "outside their errors: run longer",
        };
        writeln!(
            text,
            "self-check {} exponents must be 0: at most {worst:.1e} off, {verdict}",
            found.neutral
        )?;
    }
    if let Some(dimension) = found.dimension() {
        writeln!(
            text,
            "dimension  {} (Kaplan-Yorke; of all shapes, rotated copies included)",
            estimate(&dimension, 0, 4)
        )?;
    }
    if let Some((motion, growth)) = naming::unstable_under(plan, found)? {
        writeln!(
            text,
            "unstable   the run stays on {motion} motion, growth rate {growth:.2e}: its start has an exact symmetry, and these are the \
             exponents of that motion; a typical start leaves it"
        )?;
    }
    let digits = if found.time < 10.0 { 4 } else { 0 };
    let c = &plan.computation;
    write!(
        text,
        "averaged over {:.digits$} model time after {:.0} ({}, {})",
        found.time, found.transient, c.stepper, c.control
    )?;
    Ok(text)
}

/// `--samples`: the exponents of many orbits.
fn many(options: &LyapunovOptions, plan: &Plan, samples: Samples, count: usize) -> anyhow::Result<End> {
    let watch = Progress::new(samples.count as f64, "orbits");
    let found = samples::lyapunov(plan, samples, count, (options.transient, options.t_end), &watch);
    watch.finish();
    let Some(found) = found? else { return Ok(End::Interrupted) };
    let lasted = found.orbits.iter().filter(|orbit| orbit.outcome.is_complete()).count();
    let escapes = Escapes::of_orbits(plan, &found.orbits)?;
    let starts = Starts::of(&samples);
    let text = if options.motion.json {
        let orbit = |orbit: &Lyapunov| json!({ "exponents": orbit.exponents, "outcome": orbit.outcome });
        let mut object = json!({
            "model": plan.computation.model,
            "parameters": plan.computation.parameters,
            "control": plan.computation.control,
            "exponents": found.means,
            "agree": found.agree,
            "lasted": lasted,
            "starts": starts,
            "orbits": found.orbits.iter().map(orbit).collect::<Vec<_>>(),
        });
        if let Some(escapes) = &escapes {
            object["escapes"] = serde_json::to_value(escapes)?;
        }
        if let Some(why) = found.without_error() {
            object["without_error"] = why.into();
        }
        serde_json::to_string(&object)?
    } else {
        many_summary(&found, lasted, &starts, escapes.as_ref())?
    };
    print(&text)?;
    Ok(if lasted == found.orbits.len() && found.agree && found.without_error().is_none() {
        End::Done
    } else {
        End::NotAsAsked
    })
}

fn many_summary(
    found: &Exponents,
    lasted: usize,
    starts: &Starts,
    escapes: Option<&Escapes>,
) -> anyhow::Result<String> {
    let mut text = String::new();
    for (i, exponent) in found.means.iter().enumerate() {
        writeln!(text, "lambda_{}   {}", i + 1, estimate(exponent, 11, 6))?;
    }
    if let Some(why) = found.without_error() {
        writeln!(text, "no error   {why}")?;
    }
    write!(text, "means over {lasted} of {} orbits; {}", found.orbits.len(), starts.sentence())?;
    if lasted < found.orbits.len() {
        write!(text, "; the others ended early: for chaos before an escape, use --saddle 200")?;
    }
    for line in escapes.into_iter().flat_map(|escapes| escapes.words(found.orbits.len())) {
        write!(text, "\nescape     {line}")?;
    }
    if !found.agree {
        write!(
            text,
            "\nThe orbits do not agree: they lead to different motions (`motiform classify --samples`)"
        )?;
    }
    Ok(text)
}

/// `--saddle`: the exponent of transient chaos.
fn saddle(options: &LyapunovOptions, plan: &Plan, samples: usize) -> anyhow::Result<End> {
    let watch = Progress::new(samples as f64, "runs");
    let threads = all_cores();
    let found = find_saddle(plan, samples, (options.transient, options.t_end), threads, &watch);
    watch.finish();
    let Some(found) = found? else { return Ok(End::Interrupted) };
    print(&if options.motion.json { serde_json::to_string(&found)? } else { saddle_summary(&found)? })?;
    Ok(if found.exponent.is_some() { End::Done } else { End::NotAsAsked })
}

fn saddle_summary(found: &Saddle) -> anyhow::Result<String> {
    let mut text = String::new();
    match found.exponent {
        Some(exponent) => writeln!(
            text,
            "lambda_1 of the chaotic saddle   {:.5} +- {:.1e}",
            exponent.value, exponent.error
        )?,
        None => writeln!(text, "no exponent: {}", found.missing)?,
    }
    match found.rate {
        Some(rate) => writeln!(
            text,
            "escape rate                      {:.3e} +- {:.1e} (mean lifetime {:.0})",
            rate.value,
            rate.error,
            1.0 / rate.value
        )?,
        None => writeln!(text, "escape rate                      none: fewer than ten escapes")?,
    }
    write!(text, "{} of {} runs escaped within {:.0} model time", found.escaped, found.runs, found.t_end)?;
    Ok(text)
}
