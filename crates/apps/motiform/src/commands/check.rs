//! `motiform check`.

use crate::args::CheckOptions;
use crate::commands::remarks;
use crate::output::{End, plain, print};
use motiform_dynamics::digits::given;
use motiform_study::{RunPlan, ScanPlan, Study, Ties, counted, study};
use std::fmt::Write;

pub(crate) fn run(options: &CheckOptions) -> anyhow::Result<End> {
    let Some(path) = options.study.as_ref().filter(|_| !options.schema) else {
        print(&serde_json::to_string_pretty(&study::schema())?)?;
        return Ok(End::Done);
    };
    let study = Study::read(path)?;
    let plan = RunPlan::new(&study)?;
    remarks::remark(&study, &[remarks::of_scan(&study), remarks::of_branches(&study)].concat())?;
    let scan = if study.scan.axes.is_empty() { None } else { Some(ScanPlan::new(&study)?) };
    let text = match (options.json, &scan) {
        (false, None) => summary(&plan, &study.ties)?,
        (false, Some(scan)) => format!("{}\n{}", summary(&plan, &study.ties)?, of_scan(scan)),
        (true, None) => serde_json::to_string_pretty(&plan)?,
        (true, Some(scan)) => {
            let mut json = serde_json::to_value(&plan)?;
            json["scan"] = serde_json::to_value(&scan.computation)?;
            serde_json::to_string_pretty(&json)?
        }
    };
    print(&text)?;
    Ok(End::Done)
}

pub(crate) fn summary(plan: &RunPlan, ties: &Ties) -> anyhow::Result<String> {
    let c = &plan.computation;
    let mut text = format!("{}: {}\nmodel       {}\n", plan.name, plain(&plan.title()), c.model);
    let set: Vec<String> = c
        .parameters
        .0
        .iter()
        .filter(|entry| entry.1 != 0.0)
        .map(|(name, value)| format!("{name}={}", given(*value)))
        .collect();
    writeln!(text, "parameters  {} (others 0)", set.join(" "))?;
    if !ties.is_empty() {
        let all: Vec<String> = ties.iter().map(|(name, formula)| format!("{name} = {formula}")).collect();
        writeln!(text, "ties        {}", all.join(", "))?;
    }
    let start: Vec<String> =
        c.initial.0.iter().map(|(name, value)| format!("{name}={}", given(*value))).collect();
    writeln!(text, "start       {}", start.join(" "))?;
    let [transient, end, every] = [c.transient, c.t_end, c.dt_out].map(given);
    writeln!(text, "time        transient {transient}, recorded {end}, every {every}")?;
    writeln!(text, "stepper     {}, {}, at most {} steps", c.stepper, c.control, c.max_steps)?;
    if let Some(noise) = &c.noise {
        writeln!(text, "noise       {}, seed {}", noise.words(plan.body()?.as_ref()), c.seed)?;
    }
    write!(text, "plan        {}", plan.hash())?;
    Ok(text)
}

fn of_scan(plan: &ScanPlan) -> String {
    let c = &plan.computation;
    let axes: Vec<String> = c.axes.iter().map(ToString::to_string).collect();
    format!(
        "scan        {}: {} with {} each, in {}\nscan plan   {}",
        axes.join(" x "),
        counted(plan.cells(), "cell"),
        counted(c.samples, "initial state"),
        counted(plan.parts(), "part"),
        plan.hash()
    )
}
