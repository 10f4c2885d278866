//! `motiform classify`.

use crate::args::ClassifyOptions;
use crate::commands::subject;
use crate::output::{End, estimate, print, warn};
use crate::progress::Progress;
use motiform_analysis::regime::Resolution;
use motiform_analysis::{Regime, Verdict};
use motiform_lab::analyse;
use motiform_lab::samples::{self, Basins, Escapes, Named, Samples};
use motiform_study::Plan;
use serde_json::{Value, json};
use std::fmt::Write;

pub(crate) fn run(options: &ClassifyOptions) -> anyhow::Result<End> {
    let mut study = subject::motion(&options.motion)?;
    study.perturb = options.perturb.unwrap_or(study.perturb);
    let (study, perturbation) = study.perturbed()?;
    if let Some(perturbation) = perturbation {
        warn(&format!("{perturbation}; --perturb 0 keeps the exact start"));
    }
    let (plan, samples) = subject::plan(study, &options.many)?;
    let budget = options.budget.unwrap_or(0.0);
    if let Some(samples) = samples {
        return many(options, &plan, samples, budget);
    }
    let watch = Progress::new(analyse::settings(&plan, budget)?.budget, "model time");
    let verdict = analyse::classify(&plan, budget, &watch);
    watch.finish();
    let Some(verdict) = verdict? else { return Ok(End::Interrupted) };
    print(&if options.motion.json { json(&plan, &verdict)? } else { summary(&plan, &verdict)? })?;
    Ok(if verdict.regime == Regime::Undetermined { End::NotAsAsked } else { End::Done })
}

/// `--samples`: the motions that many initial states lead to.
fn many(options: &ClassifyOptions, plan: &Plan, samples: Samples, budget: f64) -> anyhow::Result<End> {
    let watch = Progress::new(samples.count as f64, "initial states");
    let verdicts = samples::classify(plan, samples, budget, &watch);
    watch.finish();
    let Some(verdicts) = verdicts? else { return Ok(End::Interrupted) };
    let watch = Progress::new(samples.count as f64, "chaotic starts");
    let escapes = Escapes::of_verdicts(plan, samples, &verdicts, budget, &watch);
    watch.finish();
    let escapes = escapes?;
    let basins = Basins::new(&samples, &verdicts);
    let motions = samples::motions(&verdicts);
    if options.motion.json {
        let mut counts = serde_json::Map::new();
        for (motion, count) in &motions {
            let so_far = counts.get(motion.regime).and_then(Value::as_u64).unwrap_or(0);
            counts.insert(motion.regime.to_owned(), (so_far + *count as u64).into());
        }
        let mut object = json!({
            "model": plan.computation.model,
            "parameters": plan.computation.parameters,
            "control": plan.computation.control,
            "seed": plan.computation.seed,
            "regimes": counts,
            "starts": basins.starts,
            "shares": basins.shares,
            "samples": verdicts,
        });
        if let Some(escapes) = escapes {
            object["escapes"] = serde_json::to_value(escapes)?;
        }
        print(&serde_json::to_string(&object)?)?;
    } else {
        print(&motions_summary(plan, &verdicts, &motions, (&basins, escapes.as_ref()))?)?;
    }
    let undecided = verdicts.iter().any(|verdict| verdict.regime == Regime::Undetermined);
    Ok(if undecided { End::NotAsAsked } else { End::Done })
}

fn motions_summary(
    plan: &Plan,
    verdicts: &[Verdict],
    motions: &[(Named, usize)],
    (basins, escapes): (&Basins, Option<&Escapes>),
) -> anyhow::Result<String> {
    let mut text = String::new();
    for (motion, count) in motions {
        let first = verdicts.iter().position(|verdict| Named::of(verdict) == *motion).unwrap_or(0);
        let name = motion.to_string();
        writeln!(text, "{name:14} {count} of {}, the first is initial state {first}", verdicts.len())?;
        writeln!(text, "               {}", verdicts[first].why)?;
    }
    if !basins.shares.is_empty() {
        writeln!(text, "shares         {}", basins.words())?;
    }
    for line in escapes.into_iter().flat_map(|escapes| escapes.words(verdicts.len())) {
        writeln!(text, "escape         {line}")?;
    }
    write!(text, "seed           {}", plan.computation.seed)?;
    Ok(text)
}

/// The verdict as an object, with what it is about.
fn json(plan: &Plan, verdict: &Verdict) -> anyhow::Result<String> {
    let computation = &plan.computation;
    let mut object = json!({
        "model": computation.model,
        "parameters": computation.parameters,
        "control": computation.control,
        "seed": computation.seed,
        "initial": computation.initial,
    });
    if let (Value::Object(all), Value::Object(evidence)) = (&mut object, serde_json::to_value(verdict)?) {
        all.extend(evidence);
    }
    Ok(serde_json::to_string(&object)?)
}

fn summary(plan: &Plan, verdict: &Verdict) -> anyhow::Result<String> {
    let course = verdict.course.map_or_else(String::new, |course| format!(", {}", course.words()));
    let mut text = format!("{}{course}\n", verdict.regime);
    writeln!(text, "because        {}", verdict.why)?;
    if let Some(margin) = verdict.margin {
        let sure = if margin < 3.0 { "weak" } else { "clear" };
        let margin = if margin < 1e4 { format!("{margin:.1}") } else { format!("{margin:.0e}") };
        writeln!(text, "margin         {margin} times the uncertainty of the decisive quantity ({sure})")?;
    }
    if let Some(Resolution { parameter, value, change, exponent }) = &verdict.resolution {
        let there =
            exponent.map(|there| format!("lambda_1 is {:.4} +- {:.4} and ", there.value, there.error));
        let what = match (verdict.saddle, exponent) {
            (Some(_), _) => "the rates at the saddle",
            (_, Some(_)) => "mean speed and exponent",
            _ => "speed, turning rate and period",
        };
        writeln!(
            text,
            "resolution     with {parameter} = {value}, {}{what} change by at most {change:.0e} of themselves",
            there.unwrap_or_default()
        )?;
    }
    if let Some(form) = verdict.form {
        writeln!(text, "form           {}", form.name())?;
    }
    if let Some(lasted) = verdict.lasted {
        writeln!(text, "lasted         at least {lasted:.0} model time; chaos may be transient")?;
    }
    if let Some(speed) = verdict.speed {
        writeln!(text, "speed          {:.6} (from {:.6} to {:.6})", speed.mean, speed.min, speed.max)?;
    }
    if let Some(heading) = verdict.heading {
        let what = if verdict.period.is_some() { "of the drift, " } else { "" };
        writeln!(text, "heading        {:.4} degrees ({what}from the x axis)", heading.to_degrees())?;
    }
    let numbers = [
        ("turning rate", verdict.turning_rate, "rad per model time"),
        ("period", verdict.period, "model time"),
        ("net rotation", verdict.net_rotation, "rad per period"),
        ("drift", verdict.drift, "model length per period"),
        ("escape", verdict.escape_time, "model time"),
    ];
    for (name, value, unit) in numbers {
        if let Some(value) = value {
            writeln!(text, "{name:14} {value:.6} {unit}")?;
        }
    }
    if !verdict.legs.is_empty() {
        let turns: Vec<String> =
            verdict.legs.iter().take(8).map(|turn| format!("{:.1}", turn.to_degrees())).collect();
        writeln!(text, "turns          {} degrees, from leg to leg", turns.join(", "))?;
    }
    if let Some(swing) = verdict.swing {
        writeln!(text, "heading swing  {:.1} degrees, peak to peak", swing.to_degrees())?;
    }
    if !verdict.rests.is_empty() {
        let rests: Vec<String> =
            verdict.rests.iter().rev().take(6).rev().map(|rest| format!("{rest:.1}")).collect();
        writeln!(text, "rests          ... {} model time", rests.join(", "))?;
    }
    if !verdict.exponents.is_empty() {
        let exponents: Vec<String> = verdict.exponents.iter().take(6).map(|e| estimate(e, 0, 5)).collect();
        writeln!(text, "exponents      {}", exponents.join(", "))?;
    }
    if let Some(saddle) = verdict.saddle {
        writeln!(text, "saddle         lambda_+ {:.5}, lambda_- {:.5}", saddle.out, saddle.inward)?;
    }
    let c = &plan.computation;
    write!(
        text,
        "time spent     {:.0} model time ({}, {}), seed {}",
        verdict.time, c.stepper, c.control, c.seed
    )?;
    Ok(text)
}
