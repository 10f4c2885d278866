//! `motiform equilibria`.

use crate::args::EquilibriaOptions;
use crate::commands::subject;
use crate::output::{End, print};
use crate::progress::Progress;
use motiform_lab::equilibria::{Equilibrium, FoundBy, equilibria};
use motiform_study::RunPlan;
use serde_json::json;
use std::fmt::Write;

pub(crate) fn run(options: &EquilibriaOptions) -> anyhow::Result<End> {
    let plan = RunPlan::new(&subject::motion(&options.motion)?)?;
    let watch = Progress::new(f64::from(options.starts), "starts");
    let found = equilibria(&plan, options.starts as usize, &watch);
    watch.finish();
    let Some(found) = found? else { return Ok(End::Interrupted) };
    let text = if options.motion.json {
        serde_json::to_string(&json!({
            "model": plan.computation.model,
            "parameters": plan.computation.parameters,
            "equilibria": found,
            "complete": "not proven",
        }))?
    } else {
        table(&found)?
    };
    print(&text)?;
    Ok(End::Done)
}

fn table(found: &[Equilibrium]) -> anyhow::Result<String> {
    let name = |one: &Equilibrium| match one.direction.course {
        Some(course) => format!("{} {}", one.motion, course.words()),
        None => one.motion.to_string(),
    };
    let names: Vec<String> = found.iter().map(name).collect();
    let width = names.iter().map(String::len).max().unwrap_or(0).max(12);
    let mut text = format!(
        "{:<width$} {:>12} {:>13} {:>9} {:>8}  leading eigenvalues\n",
        "motion", "speed", "turning rate", "unstable", "share"
    );
    for (one, name) in found.iter().zip(&names) {
        let values = one.eigenvalues.iter().take(3).map(|&(re, im)| match im {
            0.0 => format!("{re:.6}"),
            im => format!("{re:.6}{im:+.6}i"),
        });
        writeln!(
            text,
            "{name:<width$} {:>12.8} {:>13.8} {:>9} {:>8}  {}{}",
            one.speed,
            one.turning_rate,
            one.unstable,
            share(one),
            values.collect::<Vec<_>>().join(", "),
            family(one)
        )?;
    }
    let count = found.len();
    write!(text, "{count} found; nothing proves that these are all, more --starts may find more")?;
    Ok(text)
}

/// `true` if the row stands for a family.
fn family(one: &Equilibrium) -> String {
    match one.family {
        0 => String::new(),
        1 => "  (a one-parameter family)".to_owned(),
        count => format!("  (a family of {count} parameters)"),
    }
}

/// The share of the random starts, or the other way that led to it.
fn share(one: &Equilibrium) -> String {
    match one.found_by {
        FoundBy::Starts => format!("{:.1} %", 100.0 * one.share),
        FoundBy::Deflation => "deflated".to_owned(),
        FoundBy::Mirror => "mirrored".to_owned(),
    }
}
