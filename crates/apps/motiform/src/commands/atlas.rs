//! `motiform atlas`.

use crate::args::AtlasOptions;
use crate::commands::remarks::ties;
use crate::commands::subject;
use crate::output::{End, plain, print, warn};
use crate::progress::Progress;
use motiform_analysis::Regime;
use motiform_diagrams::atlas::{
    AtlasFolder, Boundary, Grid, Line, Stage, atlas_summary, boundaries, regions, survey, trace,
};
use motiform_store::{Folder, Opening};
use motiform_study::atlas::{AtlasPlan, AtlasSettings, axis, samples};
use motiform_study::{Error, Study};
use std::fmt::Write;
use std::path::PathBuf;

pub(crate) fn run(options: &AtlasOptions) -> anyhow::Result<End> {
    let remedy = "nothing is drawn with --no-figures: leave one out";
    options.style.refuse_unless(!options.no_figures, remedy)?;
    let study = study(options)?;
    let plan = AtlasPlan::new(&study, &settings(options))?;
    ties(&study, &plan.computation.scan.axes.iter().map(|axis| axis.name.as_str()).collect::<Vec<_>>())?;
    let out = options.out.clone().unwrap_or_else(|| PathBuf::from(plan.default_folder()));
    let files = AtlasFolder::open(&out, &plan, Opening::of(options.resume, options.force))?;
    files.notes().iter().for_each(|note| warn(note));
    let Some((grid, lines)) = compute(options, &plan, &files)? else {
        files.settle()?;
        warn(
            "interrupted: finished cells and lines are kept; the same `motiform atlas` with --resume goes on",
        );
        return Ok(End::Interrupted);
    };
    let atlas = AtlasFolder { plan, grid, lines };
    let format = options.style.format();
    atlas.write(&files, (!options.no_figures).then_some(&format))?;
    files.notes().iter().for_each(|note| warn(note));
    print(&if options.json {
        serde_json::to_string(&atlas_summary(&atlas))?
    } else {
        text(&atlas, &files.shown().display().to_string())?
    })?;
    let undetermined = |place: &motiform_diagrams::atlas::Place| place.motion(Regime::Undetermined).is_some();
    Ok(if atlas.grid.places.iter().any(undetermined) { End::NotAsAsked } else { End::Done })
}

/// Stages of [`survey`] and [`trace`].
const STAGES: usize = 4;

/// Cells, then lines, each with its progress; `None` if Ctrl-C was pressed.
fn compute(
    options: &AtlasOptions,
    plan: &AtlasPlan,
    files: &Folder,
) -> Result<Option<(Grid, Vec<Line>)>, Error> {
    let threads = options.threads.count();
    let watch = Progress::staged(STAGES);
    let named = |stage: &Stage| {
        let done = if stage.even { "done" } else { "of the boundaries named" };
        watch.stage(&stage.name, stage.share, (done, stage.even));
    };
    let grid = survey(plan, threads, files, (&watch, &named));
    let lines = match grid {
        Ok(Some(grid)) => {
            let lines = trace(plan, &grid, threads, files, (&watch, &named));
            lines.map(|lines| lines.map(|lines| (grid, lines)))
        }
        other => other.map(|_| None),
    };
    watch.finish();
    lines
}

fn settings(options: &AtlasOptions) -> AtlasSettings {
    AtlasSettings {
        lines: usize::from(options.lines),
        branches: usize::try_from(options.branches).unwrap_or(usize::MAX),
        steady: options.steady.then_some(true),
    }
}

/// The study that the options describe.
fn study(options: &AtlasOptions) -> Result<Study, Error> {
    let mut study = subject::study(&options.subject)?;
    subject::note_noise(&mut study);
    if !options.axes.is_empty() {
        study.scan.axes = options.axes.iter().map(|text| axis(text)).collect::<Result<_, _>>()?;
    }
    study.scan.samples = samples(&study, options.samples);
    study.scan.budget = options.budget.unwrap_or(study.scan.budget);
    study.random = options.random.or(study.random);
    study.run.seed = options.seed.unwrap_or(study.run.seed);
    Ok(study.perturbed()?.0)
}

fn text(atlas: &AtlasFolder, written: &str) -> anyhow::Result<String> {
    let AtlasFolder { plan, grid, lines } = atlas;
    let mut text = format!("{}\n", plain(&plan.title));
    for side in plan.plane() {
        writeln!(text, "axis       {side}")?;
    }
    let samples = plan.computation.scan.samples;
    writeln!(
        text,
        "cells      {} computed of {}, {samples} initial states each",
        grid.computed(),
        grid.places.len()
    )?;
    for region in regions(plan, grid).iter().filter(|region| region.cells >= LISTED) {
        let (names, [x, y]) = (names(&region.motions), region.at);
        writeln!(text, "region     {names:<32} {:5.1} %, around {x:.4}, {y:.4}", 100.0 * region.share)?;
    }
    let curves: usize = lines.iter().map(|line| line.curves.len()).sum();
    writeln!(text, "followed   {} lines, {curves} curves", lines.len())?;
    let short = lines.iter().filter(|line| line.refused.is_some()).count();
    if short > 0 {
        writeln!(text, "           {short} of them not to their ends: report.html and summary.json say why")?;
    }
    for found in boundaries(plan, grid, lines).iter().filter(|found| found.edges >= LISTED) {
        boundary(&mut text, found)?;
    }
    write!(text, "written    {written}")?;
    Ok(text)
}

/// Regions and boundaries of fewer cells are not listed.
const LISTED: usize = 3;

fn names(motions: &[Regime]) -> String {
    motions.iter().map(|motion| motion.name()).collect::<Vec<_>>().join(" + ")
}

fn boundary(text: &mut String, found: &Boundary) -> std::fmt::Result {
    let part = |edges: usize| format!("{:.0} %", 100.0 * edges as f64 / found.edges as f64);
    let mut kinds: Vec<String> =
        found.kinds.iter().map(|(kind, edges)| format!("{kind} {}", part(*edges))).collect();
    if found.unnamed > 0 {
        kinds.push(format!("not named {}", part(found.unnamed)));
    }
    let between = found.between.each_ref().map(|side| names(side)).join(" | ");
    writeln!(text, "boundary   {between:<40} {}", kinds.join(", "))?;
    if let Some(why) = found.why {
        writeln!(text, "           {why}")?;
    }
    Ok(())
}
