//! `motiform scan`.

use crate::args::ScanOptions;
use crate::commands::remarks::{of_scan, ties};
use crate::commands::subject;
use crate::output::{End, say, warn};
use crate::progress::Progress;
use motiform_lab::answers::Scanned;
use motiform_lab::draw::{files, scan_figures};
use motiform_lab::scan::{Classify, Scan, Shard, Totals};
use motiform_study::{Error, ScanPlan, Study};
use std::path::PathBuf;

pub(crate) fn run(options: &ScanOptions) -> anyhow::Result<End> {
    let remedy = "nothing is drawn with --no-figures: leave one out";
    options.style.refuse_unless(!options.no_figures, remedy)?;
    let mut study = study(options)?;
    let units = options.units.of(&mut study)?;
    let plan = ScanPlan::new(&study)?;
    let shard = options.shard.as_deref().map_or(Ok(Shard::WHOLE), Shard::parse)?;
    let out = options.folder.out.clone().unwrap_or_else(|| PathBuf::from(plan.default_folder()));
    let scan = Scan::open(&out, &plan, shard, options.folder.opening())?;
    scan.notes().iter().for_each(|note| warn(note));
    for damaged in scan.damaged() {
        warn(&format!("{damaged}; its cells are recomputed"));
    }
    let left = scan.cells_left();
    let watch = Progress::new(left as f64, "cells");
    let ended = watch.over(|watch| scan.run(&Classify, options.threads.count(), watch))?;
    if !options.no_figures {
        let pictures = files(scan_figures(scan.folder(), &units)?, false, &options.style.format())?;
        scan.draw(pictures.iter().map(|picture| (picture.name.as_str(), picture.bytes.as_slice())))?;
    }
    scan.notes().iter().for_each(|note| warn(note));
    let totals = Totals::of(scan.folder())?;
    say(&Scanned::new(scan.folder(), &totals)?, options.json)?;
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
