//! The steady motions of a model.

use crate::equilibria::{Equilibrium, FoundBy};
use motiform_models::ModelName;
use motiform_study::Plan;
use motiform_study::plan::Named;
use serde::Serialize;
use std::fmt::{Display, Formatter, Result};

/// The steady motions that were found for the parameters of a plan.
#[derive(Clone, Debug, Serialize)]
pub struct SteadyMotions<'a> {
    model: &'a ModelName,
    parameters: &'a Named,
    equilibria: &'a [Equilibrium],
    complete: &'static str,
}

impl<'a> SteadyMotions<'a> {
    /// The steady motions found for the parameters of a plan; nothing proves that they are all.
    pub fn new(plan: &'a Plan, equilibria: &'a [Equilibrium]) -> Self {
        let c = &plan.computation;
        Self { model: &c.model, parameters: &c.parameters, equilibria, complete: "not proven" }
    }
}

impl Display for SteadyMotions<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let name = |one: &Equilibrium| match one.direction.course {
            Some(course) => format!("{} {}", one.motion, course.words()),
            None => one.motion.to_string(),
        };
        let names: Vec<String> = self.equilibria.iter().map(name).collect();
        let width = names.iter().map(String::len).max().unwrap_or(0).max(12);
        writeln!(
            f,
            "{:<width$} {:>12} {:>13} {:>9} {:>8}  leading eigenvalues",
            "motion", "speed", "turning rate", "unstable", "share"
        )?;
        for (one, name) in self.equilibria.iter().zip(&names) {
            let Equilibrium { speed, turning_rate, unstable, .. } = one;
            write!(f, "{name:<width$} {speed:>12.8} {turning_rate:>13.8} {unstable:>9} {:>8}  ", share(one))?;
            writeln!(f, "{}{}", leading(one), family(one))?;
        }
        let count = self.equilibria.len();
        write!(f, "{count} found; nothing proves that these are all, more starts may find more")
    }
}

/// The first eigenvalues.
fn leading(one: &Equilibrium) -> String {
    let values = one.eigenvalues.iter().take(3).map(|&(re, im)| match im {
        0.0 => format!("{re:.6}"),
        im => format!("{re:.6}{im:+.6}i"),
    });
    values.collect::<Vec<_>>().join(", ")
}

/// The parameters of the family that the row stands for.
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
