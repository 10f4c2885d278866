//! `motiform scan`.

use crate::args::ScanOptions;
use crate::commands::remarks::{of_scan, ties};
use crate::commands::subject;
use crate::output::{End, print, warn};
use crate::progress::Progress;
use motiform_lab::draw::{files, scan_figures};
use motiform_lab::scan::{Classify, Opening, Scan, ScanFolder, Shard, Totals};
use motiform_study::{Error, ScanPlan, Study};
use serde_json::json;
use std::fmt::Write;
use std::path::PathBuf;

pub(crate) fn run(options: &ScanOptions) -> anyhow::Result<End> {
    let remedy = "nothing is drawn with --no-figures: leave one out";
    options.style.refuse_unless(!options.no_figures, remedy)?;
    let study = study(options)?;
    let (plan, units) = (ScanPlan::new(&study)?, options.units.of(Some(&study))?);
    let shard = options.shard.as_deref().map_or(Ok(Shard::WHOLE), Shard::parse)?;
    let out = options.out.clone().unwrap_or_else(|| PathBuf::from(plan.default_folder()));
    let scan = Scan::open(&out, &plan, shard, Opening::of(options.resume, options.force))?;
    scan.notes().iter().for_each(|note| warn(note));
    for damaged in scan.damaged() {
        warn(&format!("{damaged}; its cells are recomputed"));
    }
    let left = scan.cells_left();
    let watch = Progress::new(left as f64, "cells");
    let ended = scan.run(&Classify, options.threads.count(), &watch);
    watch.finish();
    let ended = ended?;
    if !options.no_figures {
        let pictures = files(scan_figures(scan.folder(), &units)?, false, &options.style.format())?;
        scan.draw(pictures.iter().map(|picture| (picture.name.as_str(), picture.bytes.as_slice())))?;
    }
    scan.notes().iter().for_each(|note| warn(note));
    let totals = Totals::of(scan.folder())?;
    show(scan.folder(), &totals, options.json)?;
    for damaged in &totals.damaged {
        warn(&format!("{damaged}; it belongs to another shard, which --resume recomputes"));
    }
    if !ended.complete {
        let done = ended.cells;
        warn(&format!(
            "interrupted: {done} of {left} cells are done; the same `motiform scan` with --resume continues"
        ));
        return Ok(End::Interrupted);
    }
    let lost = scan.lost();
    if lost > 0 {
        warn(&format!(
            "{lost} of the parts that were written have disappeared or changed: another process uses this folder; --resume recomputes them"
        ));
        return Ok(End::NotAsAsked);
    }
    Ok(if totals.undetermined > 0 { End::NotAsAsked } else { End::Done })
}

/// The study that the options describe.
fn study(options: &ScanOptions) -> Result<Study, Error> {
    let mut study = subject::study(&options.subject)?;
    subject::note_noise(&mut study);
    for (name, value) in &options.initial {
        study.set_initial(name, *value)?;
    }
    options.scan.apply(&mut study.scan)?;
    study.random = options.random.or(study.random);
    options.run.apply(&mut study.run)?;
    study.perturb = options.perturb.unwrap_or(study.perturb);
    ties(&study, &of_scan(&study))?;
    if let Some(perturbation) = ScanPlan::perturbation(&study)? {
        warn(&format!("{perturbation}; --perturb 0 keeps the exact start"));
    }
    Ok(study)
}

/// Prints the contents of a folder.
pub(crate) fn show(folder: &ScanFolder, totals: &Totals, as_json: bool) -> anyhow::Result<()> {
    print(&if as_json { json(folder, totals)? } else { summary(folder, totals)? })
}

fn json(folder: &ScanFolder, totals: &Totals) -> anyhow::Result<String> {
    let regimes: serde_json::Map<String, serde_json::Value> =
        totals.regimes().map(|(regime, rows)| (regime.name().to_owned(), rows.into())).collect();
    Ok(serde_json::to_string(&json!({
        "plan_hash": folder.manifest().plan_hash,
        "cells": folder.plan().cells(),
        "random": folder.plan().computation.random,
        "rows": totals.rows,
        "regimes": regimes,
        "multistable": totals.multistable,
        "undetermined": totals.undetermined,
        "escaped": totals.escaped,
        "missing": totals.missing,
        "folder": folder.path(),
    }))?)
}

fn summary(folder: &ScanFolder, totals: &Totals) -> anyhow::Result<String> {
    let plan = folder.plan();
    let mut text = format!("{} ({}, {})\n", plan.title, plan.computation.model, plan.name);
    for axis in &plan.computation.axes {
        writeln!(text, "axis      {axis}")?;
    }
    let (cells, samples) = (totals.cells, plan.computation.samples);
    writeln!(
        text,
        "cells     {cells} of {}, {samples} initial state{} each",
        plan.cells(),
        if samples == 1 { "" } else { "s" }
    )?;
    if samples > 1 || plan.draws_first()? {
        let (random, seed) = (plan.computation.random.words(), plan.computation.seed);
        writeln!(text, "          random ones {random}, seed {seed}")?;
    }
    for (regime, rows) in totals.regimes() {
        let share = 100.0 * rows as f64 / totals.rows as f64;
        writeln!(text, "          {:14} {rows} rows ({share:.1} %)", regime.name())?;
    }
    let special = [
        (totals.multistable, "with more than one motion"),
        (totals.undetermined, "undetermined"),
        (totals.escaped, "with an escape"),
    ];
    for (count, what) in special.into_iter().filter(|entry| entry.0 > 0) {
        writeln!(text, "          {count} cells {what}")?;
    }
    write!(text, "folder    {}", folder.path().display())?;
    Ok(text)
}
