//! `motiform observe`.

use crate::args::{CellsOptions, ObserveOptions};
use crate::commands::pages::{cases, draw};
use crate::commands::population::observed;
use crate::output::{End, say, warn};
use crate::progress::Progress;
use motiform_analysis::regime::Regime;
use motiform_cells::{
    CellTrack, Observation, OutlineFile, Sample, Units, observations_json, observe, observed_population,
    population_numbers, write_observations,
};
use motiform_dynamics::Watch;
use motiform_lab::pool::all_cores;
use motiform_statistics::{Answer, four_digits, with_interval};
use motiform_store::{Kind, Staged};
use motiform_study::quantity::cell;
use motiform_tracks::modes::ModeOptions;
use motiform_tracks::{Columns, Note, Options};
use serde::{Serialize, Serializer};
use std::fmt::{Display, Formatter, Write};
use std::path::PathBuf;

/// Numbers of one path, which have no interval.
const WITHOUT_INTERVAL: [&str; 3] = [cell::PATH.name, cell::NET_DISPLACEMENT.name, cell::DIRECTIONALITY.name];
/// Notes of one kind that are printed.
const MOST_NOTES: usize = 4;

pub(crate) fn run(options: &ObserveOptions) -> anyhow::Result<End> {
    style(&options.cells)?;
    let stage = |out| Staged::new(out, Kind::Observations, options.cells.force);
    let staged = options.cells.out.as_deref().map(stage).transpose()?;
    staged.iter().flat_map(Staged::notes).for_each(|note| warn(note));
    let file = |path| OutlineFile::new(path, options.cells.force);
    let outlines = options.outlines.as_deref().map(file).transpose().map_err(plain_error)?;
    let sample = read(&options.cells)?;
    let outlines = outlines.map(|file| file.write(&sample.tracks)).transpose().map_err(plain_error)?;
    let cells: Vec<&CellTrack> = sample.cells.iter().collect();
    let Some(found) = observe_all(&cells) else { return Ok(End::Interrupted) };
    let mut drawn = true;
    if let (Some(staged), false) = (&staged, options.cells.no_report) {
        let write = |name: &str, bytes: &[u8]| Ok(staged.write(name, bytes)?);
        let format = options.cells.style.format();
        drawn = draw(&sample, &cases(&cells, &found, &[]), None, all_cores(), &format, &write)?;
    }
    let written =
        staged.map(|staged| write_observations(&sample, &found, staged)).transpose().map_err(plain_error)?;
    let written = written.map(|(path, kept)| {
        kept.iter().for_each(|note| warn(note));
        path
    });
    let files: Vec<PathBuf> = outlines.into_iter().chain(written).collect();
    say(&Observed { sample: &sample, found: &found, files: &files }, options.cells.json)?;
    let undecided = found.iter().any(|one| one.motion.regime.is_none());
    Ok(match (drawn, undecided) {
        (false, _) => End::Interrupted,
        (true, true) => End::NotAsAsked,
        (true, false) => End::Done,
    })
}

/// The motion of each cell; `None`, and a warning, if Ctrl-C stopped it.
fn observe_all(cells: &[&CellTrack]) -> Option<Vec<Observation>> {
    let watch = Progress::new(cells.len() as f64, "cells");
    let mut found = Vec::with_capacity(cells.len());
    while let (Some(cell), false) = (cells.get(found.len()), watch.stopped()) {
        found.push(observe(cell));
        watch.progress(found.len() as f64 / cells.len() as f64);
    }
    watch.finish();
    if found.len() < cells.len() {
        warn(&format!(
            "interrupted after {} of {} cells: no observation is written",
            found.len(),
            cells.len()
        ));
        return None;
    }
    Some(found)
}

/// The observed motions: each cell, all of them together, and the files that were written.
struct Observed<'a> {
    sample: &'a Sample,
    found: &'a [Observation],
    files: &'a [PathBuf],
}

impl Serialize for Observed<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        observations_json(self.sample, self.found).serialize(serializer)
    }
}

impl Display for Observed<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        let Self { sample, found, files } = self;
        let (mut text, units) = (head(sample), Units::of(sample));
        for one in *found {
            let cell = sample.cells.iter().find(|cell| cell.name == one.cell);
            write!(text, "\n{}", sentences(one, cell, &units)?)?;
        }
        if found.len() > 1 {
            write!(text, "\n{}", observed(&observed_population(found), &population_numbers(found), &units)?)?;
        }
        for path in *files {
            write!(text, "\nwritten            {}", path.display())?;
        }
        f.write_str(text.trim_end())
    }
}

fn sentences(
    found: &Observation,
    cell: Option<&CellTrack>,
    units: &Units,
) -> Result<String, std::fmt::Error> {
    let name = found.motion.regime.map_or_else(|| "undecided".to_owned(), Regime::words);
    let mut text = format!("cell {:<13} {name}\nbecause            {}\n", found.cell, found.motion.why);
    if let Some(confidence) = found.motion.confidence {
        writeln!(text, "confidence         {:.0} % of resamples of this record", 100.0 * confidence)?;
    }
    text += &quality(cell, found.frames)?;
    if let Some(measures) = &found.measures
        && measures.frames < found.frames
    {
        let [from, to] = measures.span.map(four_digits);
        let stretch = format!("{} frames, t = {from} to {to} {}", measures.frames, units.time);
        writeln!(text, "seen               the longest stretch without gaps: {stretch}")?;
    }
    text += &numbers(found, units)?;
    Ok(text)
}

/// Reasons, each with the numbers that share it.
type Reasons = Vec<(String, Vec<&'static str>)>;

fn add(reasons: &mut Reasons, reason: String, name: &'static str) {
    match reasons.iter_mut().find(|(same, _)| *same == reason) {
        Some((_, names)) => names.push(name),
        None => reasons.push((reason, vec![name])),
    }
}

/// Why a number that is given has no interval.
fn without_interval(found: &Observation, name: &str) -> &'static str {
    let speed = found.numbers.steps.as_ref().and_then(|steps| steps.speed);
    let enough = speed.is_some_and(|speed| speed.interval.is_some());
    match name == cell::RMS_SPEED.name && enough {
        true => "the error of the places has no upper end",
        false => "fewer than 16 values",
    }
}

/// The numbers without a model, and why some are missing.
fn numbers(found: &Observation, units: &Units) -> Result<String, std::fmt::Error> {
    let mut text = String::new();
    let (mut missing, mut bare) = (Reasons::new(), Reasons::new());
    for row in found.numbers.rows() {
        let unit = units.unit(row.quantity.dimension);
        if let Some(reason) = row.reason(&unit) {
            add(&mut missing, reason, row.quantity.symbol);
            continue;
        }
        let is_bare = row.value.known().is_some_and(|found| found.interval.is_none());
        if is_bare && !WITHOUT_INTERVAL.contains(&row.quantity.name) {
            add(&mut bare, without_interval(found, row.quantity.name).to_owned(), row.quantity.symbol);
        }
        let value = answer(&row.value, &unit);
        writeln!(text, "{:<18} {}", row.quantity.symbol, value.trim_end())?;
    }
    for (reason, names) in missing {
        writeln!(text, "not given          {}: {reason}", names.join(", "))?;
    }
    for (reason, names) in bare {
        writeln!(text, "no interval        {}: {reason}", names.join(", "))?;
    }
    if let Some(remark) = found.numbers.remark(&units.length) {
        writeln!(text, "centroid           {remark}")?;
    }
    Ok(text)
}

/// A value with its interval, or why there is none.
fn answer(found: &Answer, unit: &str) -> String {
    match found {
        Answer::Unknown { reason } => reason.clone(),
        Answer::Known(found) => {
            let number = found
                .interval
                .map_or_else(|| four_digits(found.value), |ends| with_interval(found.value, ends));
            format!("{number} {unit}")
        }
    }
}

/// Frames that count, and what is wrong with the others.
pub(crate) fn quality(cell: Option<&CellTrack>, frames: usize) -> Result<String, std::fmt::Error> {
    let Some(cell) = cell else { return Ok(String::new()) };
    let all = cell.modes.frames.len();
    let mut text = format!("frames             {frames} of {all} count");
    let flags: Vec<String> =
        cell.flags().into_iter().map(|(name, count)| format!("{count} {name}")).collect();
    if !flags.is_empty() {
        write!(text, "; {}", flags.join(", "))?;
    }
    text.push('\n');
    Ok(text)
}

/// Refuses options of figures where there are no pages.
pub(crate) fn style(options: &CellsOptions) -> Result<(), motiform_study::Error> {
    let remedy =
        "figures are in the pages of a folder: give --out DIR and leave out --no-report, or leave this out";
    options.style.refuse_unless(options.out.is_some() && !options.no_report, remedy)
}

/// The first lines: how much was read, in which units, and what the field of view adds.
pub(crate) fn head(sample: &Sample) -> String {
    let tracks = &sample.tracks;
    let mut text =
        format!("{}; lengths in {}, times in {}\n", tracks.size(), tracks.length_unit, tracks.time_unit);
    for (name, words) in sample.field.in_words(&Units::of(sample)) {
        text += &format!("{name:<19}{words}\n");
    }
    text
}

/// The cells of the files; notes about them are warnings.
pub(crate) fn read(options: &CellsOptions) -> anyhow::Result<Sample> {
    let settings = Options {
        format: options.format,
        pixel_size: options.pixel_size,
        interval: options.interval,
        length_unit: options.length_unit.clone(),
        time_unit: options.time_unit.clone(),
        columns: Columns::named(&options.columns),
        ..Options::default()
    };
    let modes = ModeOptions::default();
    let sample = Sample::read(&options.files, &settings, &modes).map_err(plain_error)?;
    let sample = chosen(sample.corrected(&options.correct, &modes), options)?;
    notes(&sample);
    Ok(sample)
}

/// The first notes of each kind as warnings, and how many more there are.
fn notes(sample: &Sample) {
    let kind = |note: &Note| std::mem::discriminant(note);
    let notes = &sample.tracks.notes;
    let mut shown: Vec<&Note> = Vec::new();
    for note in notes {
        let alike = notes.iter().filter(|other| kind(other) == kind(note)).count();
        let place = shown.iter().filter(|other| kind(other) == kind(note)).count();
        match place {
            0..MOST_NOTES => warn(&note.to_string()),
            MOST_NOTES => warn(&format!("and {} more of this kind; --json lists all", alike - MOST_NOTES)),
            _ => {}
        }
        shown.push(note);
    }
}

/// The cells that are asked for.
fn chosen(sample: Sample, options: &CellsOptions) -> anyhow::Result<Sample> {
    if let Some(name) = options.cell.iter().find(|name| !sample.cells.iter().any(|cell| cell.name == **name))
    {
        let known: Vec<&str> = sample.cells.iter().take(12).map(|cell| cell.name.as_str()).collect();
        let more = match sample.cells.len() - known.len() {
            0 => String::new(),
            rest => format!(" and {rest} more"),
        };
        anyhow::bail!("--cell {name}: there is no such cell; the cells are {}{more}", known.join(", "));
    }
    Ok(if options.cell.is_empty() { sample } else { sample.only(&options.cell) })
}

/// The error itself, so that remedies and exit codes are those of every command.
pub(crate) fn plain_error(error: motiform_cells::Error) -> anyhow::Error {
    match error {
        motiform_cells::Error::Study(error) => error.into(),
        other => other.into(),
    }
}
