//! `motiform atlas`.

use crate::args::AtlasOptions;
use crate::commands::remarks::ties;
use crate::commands::subject;
use crate::output::{End, plain, say, warn};
use crate::progress::Progress;
use motiform_analysis::Regime;
use motiform_diagrams::atlas::{
    AtlasFolder, Boundary, Grid, Line, Stage, atlas_summary, boundaries, mixed_courses, regions, survey,
    trace, why_no_line, words,
};
use motiform_store::Folder;
use motiform_study::atlas::{AtlasPlan, axis, samples};
use motiform_study::{Error, Study, counted};
use serde::{Serialize, Serializer};
use std::fmt::{Display, Formatter};
use std::path::{Path, PathBuf};

pub(crate) fn run(options: &AtlasOptions) -> anyhow::Result<End> {
    let remedy = "nothing is drawn with --no-figures: leave one out";
    options.style.refuse_unless(!options.no_figures, remedy)?;
    let study = study(options)?;
    let plan = AtlasPlan::new(&study)?;
    ties(&study, &plan.computation.scan.axes.iter().map(|axis| axis.name.as_str()).collect::<Vec<_>>())?;
    let out = options.folder.out.clone().unwrap_or_else(|| PathBuf::from(plan.default_folder()));
    let files = AtlasFolder::open(&out, &plan, options.folder.opening())?;
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
    say(&Surveyed { atlas: &atlas, written: files.shown() }, options.json)?;
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
        watch.stage(&stage.name, stage.share, done, stage.even);
    };
    let found = survey(plan, threads, files, &watch, &named).and_then(|grid| {
        let Some(grid) = grid else { return Ok(None) };
        let lines = trace(plan, &grid, threads, files, &watch, &named)?;
        Ok(lines.map(|lines| (grid, lines)))
    });
    watch.finish();
    found
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
    options.lines.apply(&mut study.atlas)?;
    Ok(study.perturbed()?.0)
}

/// The regions and boundaries of a plane.
struct Surveyed<'a> {
    atlas: &'a AtlasFolder,
    written: &'a Path,
}

impl Serialize for Surveyed<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        atlas_summary(self.atlas).serialize(serializer)
    }
}

impl Display for Surveyed<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        let AtlasFolder { plan, grid, lines } = self.atlas;
        writeln!(f, "{}", plain(&plan.title))?;
        for side in plan.plane() {
            writeln!(f, "axis       {}", side.words())?;
        }
        let samples = plan.computation.scan.samples;
        writeln!(
            f,
            "cells      {} computed of {}, {} each",
            grid.computed(),
            grid.places.len(),
            counted(samples, "initial state")
        )?;
        let all = regions(plan, grid);
        let (listed, small): (Vec<_>, Vec<_>) = all.iter().partition(|region| region.cells >= LISTED);
        for region in listed {
            let (names, [x, y]) = (words(&region.motions), region.at);
            writeln!(f, "region     {names:<32} {:5.1} %, around {x:.4}, {y:.4}", 100.0 * region.share)?;
        }
        if !small.is_empty() {
            let share = 100.0 * small.iter().map(|region| region.share).sum::<f64>();
            let words = format!("{} of fewer than {LISTED} cells each", small.len());
            writeln!(f, "regions    {words:<32} {share:5.1} %: summary.json lists them")?;
        }
        mixed_courses(grid).iter().try_for_each(|words| writeln!(f, "note       {words}"))?;
        let curves: usize = lines.iter().map(|line| line.curves.len()).sum();
        match lines.is_empty() {
            true => writeln!(f, "followed   {}", why_no_line(plan))?,
            false => {
                writeln!(f, "followed   {}, {}", counted(lines.len(), "line"), counted(curves, "curve"))?;
            }
        }
        let short = lines.iter().filter(|line| line.refused.is_some()).count();
        if short > 0 {
            writeln!(
                f,
                "           {short} of them not to their ends: report.html and summary.json say why"
            )?;
        }
        let all = boundaries(plan, grid, lines);
        let (listed, short): (Vec<_>, Vec<_>) = all.iter().partition(|found| found.edges >= LISTED);
        listed.into_iter().try_for_each(|found| boundary(f, found))?;
        if !short.is_empty() {
            writeln!(
                f,
                "boundaries {} between fewer than {LISTED} pairs of cells: summary.json lists them",
                short.len()
            )?;
        }
        write!(f, "written    {}", self.written.display())
    }
}

/// Regions and boundaries of fewer cells are not listed.
const LISTED: usize = 3;

fn boundary(f: &mut Formatter<'_>, found: &Boundary) -> std::fmt::Result {
    let part = |edges: usize| format!("{:.0} %", 100.0 * edges as f64 / found.edges as f64);
    let mut kinds: Vec<String> =
        found.kinds.iter().map(|(kind, edges)| format!("{kind} {}", part(*edges))).collect();
    if found.unnamed > 0 {
        kinds.push(format!("not named {}", part(found.unnamed)));
    }
    let between = found.between.each_ref().map(|side| words(side)).join(" | ");
    writeln!(f, "boundary   {between:<40} {}", kinds.join(", "))?;
    if let Some(why) = found.why {
        writeln!(f, "           {why}")?;
    }
    Ok(())
}
