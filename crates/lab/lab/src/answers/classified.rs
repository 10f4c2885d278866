//! The name of a motion.

use super::{About, decimals, estimate};
use motiform_analysis::Verdict;
use motiform_analysis::regime::Resolution;
use motiform_dynamics::digits::six_decimals;
use motiform_dynamics::in_words;
use motiform_study::Plan;
use motiform_study::plan::Named;
use serde::Serialize;
use std::fmt::{Display, Formatter, Result};

/// Turns, rests and exponents that are printed of each.
const SHOWN: [usize; 3] = [8, 6, 6];

/// The motion of a plan, with the evidence.
#[derive(Clone, Debug, Serialize)]
pub struct Classified<'a> {
    #[serde(flatten)]
    about: About<'a>,
    seed: u64,
    initial: &'a Named,
    /// The verdict.
    #[serde(flatten)]
    verdict: &'a Verdict,
    #[serde(skip)]
    plan: &'a Plan,
}

impl<'a> Classified<'a> {
    /// The verdict on the motion of a plan.
    pub fn new(plan: &'a Plan, verdict: &'a Verdict) -> Self {
        let c = &plan.computation;
        Self { about: About::of(plan), seed: c.seed, initial: &c.initial, verdict, plan }
    }
}

impl Display for Classified<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let verdict = self.verdict;
        let course = verdict.course.map_or_else(String::new, |course| format!(", {}", course.words()));
        writeln!(f, "{}{course}\nbecause        {}", verdict.regime.words(), verdict.why)?;
        certainty(f, verdict)?;
        numbers(f, verdict)?;
        lists(f, verdict)?;
        let c = &self.plan.computation;
        write!(
            f,
            "time spent     {:.0} model time ({}, {}), seed {}",
            verdict.time, c.stepper, c.control, c.seed
        )
    }
}

/// The certainty of the verdict.
fn certainty(f: &mut Formatter<'_>, verdict: &Verdict) -> Result {
    if let Some(margin) = verdict.margin {
        let sure = if margin < 3.0 { "weak" } else { "clear" };
        let margin = if margin < 1e4 { format!("{margin:.1}") } else { format!("{margin:.0e}") };
        writeln!(f, "margin         {margin} times the uncertainty of the decisive quantity ({sure})")?;
    }
    if let Some(Resolution { parameter, value, change, exponent }) = &verdict.resolution {
        let there = exponent.map(|there| format!("lambda_1 is {} and ", estimate(&there, 0, 4)));
        let what = match (verdict.saddle, exponent) {
            (Some(_), _) => "the rates at the saddle",
            (_, Some(_)) => "mean speed and exponent",
            _ => "speed, turning rate and period",
        };
        let there = there.unwrap_or_default();
        writeln!(
            f,
            "resolution     with {parameter} = {value}, {there}{what} change by at most {change:.0e} of themselves"
        )?;
    }
    if let Some(form) = verdict.form {
        writeln!(f, "form           {}", in_words(form.name()))?;
    }
    if let Some(lasted) = verdict.lasted {
        writeln!(f, "lasted         at least {lasted:.0} model time; chaos may be transient")?;
    }
    Ok(())
}

fn numbers(f: &mut Formatter<'_>, verdict: &Verdict) -> Result {
    if let Some(speed) = verdict.speed {
        let [mean, least, most] = [speed.mean, speed.min, speed.max].map(six_decimals);
        writeln!(f, "speed          {mean} (from {least} to {most})")?;
    }
    if let Some(heading) = verdict.heading {
        let what = if verdict.period.is_some() { "of the drift, " } else { "" };
        writeln!(f, "heading        {:.4} degrees ({what}from the x axis)", heading.to_degrees())?;
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
            writeln!(f, "{name:14} {} {unit}", six_decimals(value))?;
        }
    }
    Ok(())
}

fn lists(f: &mut Formatter<'_>, verdict: &Verdict) -> Result {
    let [turns, rests, exponents] = SHOWN;
    if !verdict.legs.is_empty() {
        let turns: Vec<String> =
            verdict.legs.iter().take(turns).map(|turn| format!("{:.1}", turn.to_degrees())).collect();
        writeln!(f, "turns          {} degrees, from leg to leg", turns.join(", "))?;
    }
    if let Some(swing) = verdict.swing {
        writeln!(f, "heading swing  {:.1} degrees, peak to peak", swing.to_degrees())?;
    }
    if !verdict.rests.is_empty() {
        let last = &verdict.rests[verdict.rests.len().saturating_sub(rests)..];
        let rests: Vec<String> = last.iter().map(|rest| format!("{rest:.1}")).collect();
        writeln!(f, "rests          ... {} model time", rests.join(", "))?;
    }
    if !verdict.exponents.is_empty() {
        let shown = &verdict.exponents[..exponents.min(verdict.exponents.len())];
        let digits = decimals(shown, 5);
        let exponents: Vec<String> = shown.iter().map(|one| estimate(one, 0, digits)).collect();
        writeln!(f, "exponents      {}", exponents.join(", "))?;
    }
    if let Some(saddle) = verdict.saddle {
        writeln!(f, "saddle         lambda_+ {:.5}, lambda_- {:.5}", saddle.out, saddle.inward)?;
    }
    Ok(())
}
