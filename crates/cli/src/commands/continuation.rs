//! `motiform continue`.

use crate::args::{ContinueOptions, Observable};
use crate::commands::subject;
use crate::output::{End, plain, print, warn};
use crate::progress::Progress;
use motiform_branching::draw::{Ordinate, draw_branches};
use motiform_branching::{
    BranchFolder, Branches, Followed, SpecialEntry, default_folder, follow, stretches, summary,
};
use motiform_files::Staging;
use motiform_lab::draw::Picture;
use motiform_study::branches::{Along, BranchSettings, origin};
use motiform_study::{BranchPlan, Error};
use std::fmt::Write;
use std::path::PathBuf;

pub(crate) fn run(options: &ContinueOptions) -> anyhow::Result<End> {
    let plan = plan(options)?;
    let (staging, before) = target(options, &plan)?;
    for note in staging.iter().flat_map(Staging::swept) {
        warn(note);
    }
    let watch = Progress::new(plan.computation.branches as f64, "branches");
    let found = follow(&plan, before, &watch);
    watch.finish();
    let folder = BranchFolder { plan, found: found? };
    let (written, undrawn) = write(options, &folder, staging)?;
    print(&if options.json {
        serde_json::to_string(&summary(&folder.plan, &folder.found))?
    } else {
        text(&folder, written.as_deref())?
    })?;
    if let Some(error) = undrawn {
        return Err(anyhow::Error::new(error).context("the points are written, the figures are not"));
    }
    if !folder.found.complete {
        warn("interrupted: what is whole is kept; the same `motiform continue` with --resume goes on");
        return Ok(End::Interrupted);
    }
    Ok(End::Done)
}

/// What the options describe.
fn plan(options: &ContinueOptions) -> Result<BranchPlan, Error> {
    let mut study = subject::study(&options.subject)?;
    subject::apply(&options.method, &mut study)?;
    study.perturb = options.perturb.unwrap_or(study.perturb);
    let (study, perturbation) = study.perturbed()?;
    if let Some(perturbation) = perturbation {
        warn(&format!("{perturbation}; --perturb 0 keeps the exact start"));
    }
    let settings = BranchSettings {
        along: Along::parse(&options.along)?,
        origin: options.from.as_deref().map(origin).transpose()?,
        points: usize::try_from(options.points).unwrap_or(usize::MAX),
        branches: usize::try_from(options.branches).unwrap_or(usize::MAX),
    };
    BranchPlan::new(&study, &settings)
}

/// Where the result goes, and what is there of it: prepared before any computing, so that a wrong --out costs nothing.
fn target(
    options: &ContinueOptions,
    plan: &BranchPlan,
) -> Result<(Option<Staging>, Option<Branches>), Error> {
    let out = match &options.out {
        Some(path) => path.clone(),
        None if options.json && !options.resume => return Ok((None, None)),
        None => PathBuf::from(default_folder(plan)),
    };
    let before = if options.resume { BranchFolder::resume(&out, plan)? } else { None };
    Ok((Some(Staging::new(&out, true, options.force || options.resume)?), before))
}

/// Writes the folder; what was written, and why there are no figures, if there are none.
fn write(
    options: &ContinueOptions,
    folder: &BranchFolder,
    staging: Option<Staging>,
) -> Result<(Option<String>, Option<Error>), Error> {
    let Some(staging) = staging else { return Ok((None, None)) };
    let drawn = if options.no_figures { Ok(Vec::new()) } else { pictures(options.observable, folder) };
    let (pictures, undrawn) = match drawn {
        Ok(pictures) => (pictures, None),
        Err(error @ Error::Figure(_)) => (Vec::new(), Some(error)),
        Err(error) => return Err(error),
    };
    Ok((Some(folder.write(&pictures, staging)?.display().to_string()), undrawn))
}

fn pictures(observable: Observable, folder: &BranchFolder) -> Result<Vec<Picture>, Error> {
    let ordinate = match observable {
        Observable::Speed => Ordinate::Speed,
        Observable::TurningRate => Ordinate::TurningRate,
        Observable::Size => Ordinate::Size,
        Observable::NetRotation => Ordinate::NetRotation,
    };
    draw_branches(&folder.plan, &folder.found, ordinate)
}

fn text(folder: &BranchFolder, written: Option<&str>) -> anyhow::Result<String> {
    let BranchFolder { plan, found } = folder;
    let along = &plan.computation.along;
    let mut text = format!("{}, {}..{}\n", plain(&plan.title()), along.from, along.to);
    for (number, followed) in found.branches.iter().enumerate() {
        branch(&mut text, folder, (number, followed))?;
    }
    if found.left > 0 {
        writeln!(text, "more       begins at {} of these points; --branches N follows more", found.left)?;
    }
    if let Some(written) = written {
        writeln!(text, "written    {written}")?;
    }
    Ok(text.trim_end().to_owned())
}

fn branch(
    text: &mut String,
    folder: &BranchFolder,
    (number, followed): (usize, &Followed),
) -> std::fmt::Result {
    let (motion, form) = followed.motion();
    let motion = motion.map_or("", |motion| motion.name());
    let form = form.map_or(String::new(), |form| format!(" ({})", form.name()));
    writeln!(text, "branch {number:<3} {motion}{form}, {} points", followed.samples().count())?;
    for [from, to] in stretches(&folder.found, followed) {
        writeln!(text, "           stable from {from:.9} to {to:.9}")?;
    }
    for special in folder.found.special(number) {
        writeln!(text, "           {}", line(&special))?;
    }
    for leg in &followed.legs {
        writeln!(text, "           ends: {}", leg.end)?;
    }
    Ok(())
}

fn line(special: &SpecialEntry) -> String {
    let mut line = format!("{:<17} {:.9}", special.kind, special.parameter);
    let period = special.period.map(|period| format!("period {period:.6}"));
    let words = special.criticality.map(str::to_owned);
    let breaks = special.breaks.map(|what| format!("breaks the {what}"));
    let next = special.branch.map(|branch| format!("to branch {branch}"));
    for part in [period, words, breaks, next].into_iter().flatten() {
        line += "  ";
        line += &part;
    }
    line
}
