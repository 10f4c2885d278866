//! `motiform section`.

use crate::args::{Crossing, SectionOptions};
use crate::commands::subject;
use crate::output::{End, print, warn};
use crate::progress::Progress;
use motiform_dynamics::Direction;
use motiform_lab::section::section;
use motiform_store::columns::to_csv;
use motiform_store::table::Table;
use motiform_study::{Error, RunPlan};
use serde_json::{Map, Value, json};

pub(crate) fn run(options: &SectionOptions) -> anyhow::Result<End> {
    let plan = plan(options)?;
    let direction = match options.direction {
        Crossing::Rising => Direction::Rising,
        Crossing::Falling => Direction::Falling,
        Crossing::Either => Direction::Either,
    };
    let (name, value) = &options.at;
    let watch = Progress::new(plan.computation.transient + plan.computation.t_end, "model time");
    let found = section(&plan, (name, *value), direction, &watch);
    watch.finish();
    let (table, ending) = found?;
    if options.motion.json {
        let object = json!({
            "model": plan.computation.model,
            "parameters": plan.computation.parameters,
            "at": { "coordinate": name, "value": value },
            "crossings": crossings(&table),
            "outcome": ending,
        });
        print(&serde_json::to_string(&object)?)?;
    } else {
        print(String::from_utf8_lossy(&to_csv(&table.columns)).trim_end())?;
    }
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

/// An object for each crossing.
fn crossings(table: &Table) -> Vec<Value> {
    let row = |row: usize| {
        let entries = table.columns.iter().map(|column| (column.name.clone(), column.values[row].into()));
        Value::Object(entries.collect::<Map<_, _>>())
    };
    (0..table.rows()).map(row).collect()
}
