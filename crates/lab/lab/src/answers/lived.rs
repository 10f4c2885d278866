//! Mean lives of transient chaos along a parameter.

use crate::lifetimes::{LifeAt, Lifetimes};
use motiform_dynamics::digits::{four_digits, given};
use motiform_figures::Label;
use motiform_study::quantity::statistic::LIFE;
use motiform_study::scan::ScanComputation;
use motiform_study::{ScanPlan, Shown, counted};
use serde::Serialize;
use std::fmt::{Display, Formatter};

/// A label of figures as text: 10^-3, z_1.
fn plain(label: &str) -> String {
    Label::parse(label).terminal()
}

/// The lifetimes of the motions of a plan.
#[derive(Clone, Debug, Serialize)]
pub struct Lived<'a> {
    plan_hash: String,
    #[serde(rename = "plan")]
    computation: &'a ScanComputation,
    #[serde(flatten)]
    pub(crate) found: &'a Lifetimes,
    notes: Vec<String>,
    sentence: String,
    #[serde(skip)]
    pub(crate) plan: &'a ScanPlan,
    #[serde(skip)]
    units: &'a Shown,
}

impl<'a> Lived<'a> {
    /// The lifetimes of the motions of a plan, whose lines are in these units.
    pub fn new(plan: &'a ScanPlan, found: &'a Lifetimes, units: &'a Shown) -> Self {
        Self {
            plan_hash: plan.hash(),
            computation: &plan.computation,
            found,
            notes: found.notes(),
            sentence: found.laws.words(),
            plan,
            units,
        }
    }

    /// The first lines: what was followed, and the head of the table.
    fn head(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        let Self { plan, found, units, .. } = self;
        let c = &plan.computation;
        writeln!(f, "{} ({}, {})", plan.title, c.model, plan.name)?;
        let (until, unit) = match units.is_physical() {
            true => (
                found.until_in(|time| plain(&units.words(time, LIFE.dimension, ""))),
                format!(", times in {}", plain(&units.name(LIFE.dimension, ""))),
            ),
            false => (found.until_in(given), String::new()),
        };
        let starts = format!("{} each, {}, seed {}", counted(c.samples, "start"), c.random.words(), c.seed);
        let asked =
            if c.budget > 0.0 && c.budget < found.until()[1] { ", in whole looks of the model" } else { "" };
        writeln!(f, "{starts}, followed to {until}{asked}")?;
        write!(f, "{:>12}", found.parameter)?;
        for title in ["blew up", "captured", "lasting", "delay", "events", "watched", "mean life"] {
            write!(f, " {title:>10}")?;
        }
        writeln!(f, "  95 % limits{unit}")
    }
}

impl Display for Lived<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        self.head(f)?;
        for at in &self.found.values {
            writeln!(f, "{}", row(at, self.units.factor(LIFE.dimension)))?;
        }
        for note in &self.notes {
            writeln!(f, "note      {note}")?;
        }
        let (factor, unit) = (self.units.factor(LIFE.dimension), plain(&self.units.name(LIFE.dimension, "")));
        write!(f, "law       {}", self.found.laws.words_in(factor, &unit))
    }
}

fn row(at: &LifeAt, factor: f64) -> String {
    let life = &at.life;
    let number = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |value| format!("{value:.3e}"));
    let limits = match life.upper {
        Some(upper) => format!("{:.3e} to {:.3e}", factor * life.lower, factor * upper),
        None if life.lower > 0.0 => format!("above {:.3e}", factor * life.lower),
        None => "-".to_owned(),
    };
    let (delay, watched) = (four_digits(factor * at.delay), number(Some(factor * life.watched)));
    format!(
        "{:>12} {:>10} {:>10} {:>10} {delay:>10} {:>10} {watched:>10} {:>10}  {limits}",
        given(at.value),
        at.blew_up,
        at.captured,
        at.lasting,
        life.events,
        number(life.value.map(|value| factor * value))
    )
}
