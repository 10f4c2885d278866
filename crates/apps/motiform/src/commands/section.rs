//! `motiform section`.

use crate::args::{Crossing, SectionOptions};
use crate::commands::subject;
use crate::output::{End, say, warn};
use crate::progress::Progress;
use motiform_dynamics::Direction;
use motiform_lab::section::section;
use motiform_models::ModelName;
use motiform_store::columns::to_csv;
use motiform_store::table::Table;
use motiform_study::plan::Named;
use motiform_study::{Ending, Error, RunPlan};
use serde::{Serialize, Serializer};
use serde_json::Value;
use std::fmt::{Display, Formatter};

pub(crate) fn run(options: &SectionOptions) -> anyhow::Result<End> {
    let plan = plan(options)?;
    let direction = match options.direction {
        Crossing::Rising => Direction::Rising,
        Crossing::Falling => Direction::Falling,
        Crossing::Either => Direction::Either,
    };
    let (name, value) = &options.at;
    let watch = Progress::new(plan.computation.transient + plan.computation.t_end, "model time");
    let (table, ending) = watch.over(|watch| section(&plan, name, *value, direction, watch))?;
    let c = &plan.computation;
    let at = At { coordinate: name, value: *value };
    let crossings = Crossings(&table);
    say(
        &Section { model: &c.model, parameters: &c.parameters, at, crossings, outcome: &ending },
        options.motion.json,
    )?;
    if !ending.is_complete() {
        warn(&format!("the run {ending}"));
    }
    Ok(End::from(&ending.outcome))
}

fn plan(options: &SectionOptions) -> Result<RunPlan, Error> {
    let mut study = subject::motion(&options.motion)?;
    options.run.apply(&mut study.run)?;
    study.run.dt_out = 0.0; // there are no rows: those of a preset may be too many for this span
    RunPlan::new(&study)
}

/// The crossings of an orbit: objects, or lines of a table.
#[derive(Serialize)]
struct Section<'a> {
    model: &'a ModelName,
    parameters: &'a Named,
    at: At<'a>,
    crossings: Crossings<'a>,
    outcome: &'a Ending,
}

/// The section.
#[derive(Serialize)]
struct At<'a> {
    coordinate: &'a str,
    value: f64,
}

/// An object for each crossing.
struct Crossings<'a>(&'a Table);

impl Serialize for Crossings<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let row = |row: usize| {
            let columns = self.0.columns.iter();
            Value::Object(columns.map(|column| (column.name.clone(), column.values[row].into())).collect())
        };
        serializer.collect_seq((0..self.0.rows()).map(row))
    }
}

impl Display for Section<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        f.write_str(String::from_utf8_lossy(&to_csv(&self.crossings.0.columns)).trim_end())
    }
}
