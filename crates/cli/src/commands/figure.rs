//! `motiform figure`, and the drawing that `simulate` shares with it.

use super::film;
use crate::args::{DrawingOptions, FigureOptions, Observable};
use crate::output::{End, print, warn};
use motiform_atlas::{AtlasFolder, draw_atlas};
use motiform_branching::BranchFolder;
use motiform_branching::curves::CurveFolder;
use motiform_branching::draw::{draw_branches, draw_curves};
use motiform_files::{Folder, Kind, Opening, kind_of, read_dataset_by};
use motiform_lab::draw::{Picture, draw, draw_scan};
use motiform_lab::long::read_shown;
use motiform_lab::scan::ScanFolder;
use motiform_study::study::FigureSettings;
use motiform_study::{Dataset, Error, plan};
use std::path::Path;

pub(crate) fn run(options: &FigureOptions) -> anyhow::Result<End> {
    film::check(&options.drawing.film)?;
    let mut end = End::Done;
    if let (Some(out), true) = (&options.out, options.datasets.len() > 1) {
        let remedy = "its figures would have the same names: draw one folder at a time";
        return Err(Error::Setting { key: "--out", value: out.display().to_string(), remedy }.into());
    }
    for path in &options.datasets {
        let pictures = drawn(path, options)?;
        if let Some(out) = &options.out {
            apart(&pictures, out, options.force)?;
            continue;
        }
        let folder = Folder::redraw(path)?;
        let written = write(&folder, &pictures, options.force)?;
        folder.settle()?;
        let kept = folder.notes();
        let remedy = if options.force { "" } else { "; --force draws those of motiform again" };
        kept.iter().for_each(|note| warn(&format!("{note}{remedy}")));
        if !(kept.is_empty() || options.force) {
            end = End::NotAsAsked;
        }
        say(path, &written)?;
    }
    Ok(end)
}

/// Writes pictures into a folder of their own.
fn apart(pictures: &[Picture], out: &Path, force: bool) -> anyhow::Result<()> {
    let folder = Folder::open(out, Kind::Figures, Opening::of(false, force), &[])?;
    let written = write(&folder, pictures, false)?;
    folder.complete()?;
    folder.notes().iter().for_each(|note| warn(note));
    say(out, &written)
}

/// Writes pictures; the names of those that are written.
fn write<'p>(folder: &Folder, pictures: &'p [Picture], force: bool) -> Result<Vec<&'p str>, Error> {
    let mut written = Vec::new();
    for picture in pictures {
        if folder.draw(&picture.name, &picture.bytes, force)? {
            written.push(picture.name.as_str());
        }
    }
    Ok(written)
}

fn say(folder: &Path, written: &[&str]) -> anyhow::Result<()> {
    let names = if written.is_empty() { "no figure is written".to_owned() } else { written.join(" ") };
    print(&format!("{}: {names}", folder.display()))
}

/// Refuses an option that a kind of figure does not have.
fn refuse(given: Option<&'static str>, remedy: &'static str) -> Result<(), Error> {
    given.map_or(Ok(()), |key| Err(Error::Setting { key, value: "given".to_owned(), remedy }))
}

/// The pictures of a folder, whatever is in it.
fn drawn(path: &Path, options: &FigureOptions) -> anyhow::Result<Vec<Picture>> {
    let (kind, format) = (kind_of(path), options.drawing.style.format());
    if kind != Some(Kind::Branches) {
        let given = options.observable.map(|_| "--observable");
        refuse(given, "only diagrams of branches have it: leave it out")?;
    }
    if matches!(kind, Some(Kind::Scan | Kind::Branches | Kind::Curves | Kind::Atlas)) {
        refuse(options.drawing.of_bodies(), "only figures of a body have it: leave it out")?;
    }
    match kind {
        Some(Kind::Scan) => Ok(draw_scan(&ScanFolder::read(path)?, &format)?),
        Some(Kind::Branches) => {
            let BranchFolder { plan, found } = BranchFolder::read(path)?;
            let ordinate = options.observable.unwrap_or(Observable::Speed).ordinate();
            Ok(draw_branches(&plan, &found, ordinate, &format)?)
        }
        Some(Kind::Curves) => {
            let CurveFolder { plan, found } = CurveFolder::read(path)?;
            Ok(draw_curves(&plan, &found, None, &format)?)
        }
        Some(Kind::Atlas) => Ok(draw_atlas(&AtlasFolder::read(path)?, &format)?),
        Some(
            Kind::Statistics
            | Kind::Lifetimes
            | Kind::Observations
            | Kind::Fits
            | Kind::Report
            | Kind::Figures,
        ) => {
            let remedy = "figures of such a folder are not drawn again: give the command that wrote it the options of figures, with --force";
            Err(Error::Setting { key: "DIR", value: path.display().to_string(), remedy }.into())
        }
        _ => {
            let dataset = read_dataset_by(path, &|manifest, path| {
                apply(&options.drawing, &mut manifest.plan.figure);
                plan::check_figure(&manifest.plan.figure)?;
                let (trajectory, stride) = read_shown(manifest, path)?;
                note_stride(stride);
                Ok(trajectory)
            })?;
            let mut stills = pictures(&dataset, &options.drawing)?;
            stills.extend(film::convert(&stills, &options.drawing.film)?);
            Ok(stills)
        }
    }
}

/// Overrides the study's settings with those given on the command line.
pub(crate) fn apply(options: &DrawingOptions, settings: &mut FigureSettings) {
    settings.radius = options.radius.unwrap_or(settings.radius);
    settings.scale = options.scale.unwrap_or(settings.scale);
    settings.outlines = options.outlines.unwrap_or(settings.outlines);
    settings.from = options.from.unwrap_or(settings.from);
    settings.to = options.to.unwrap_or(settings.to);
    settings.animation &= !options.no_animation;
}

/// Says that a long run is not drawn from all of its rows.
pub(crate) fn note_stride(stride: u32) {
    if stride > 1 {
        warn(&format!("the run is long: its figures show one row of {stride}"));
    }
}

/// Every picture of a dataset.
pub(crate) fn pictures(dataset: &Dataset, options: &DrawingOptions) -> Result<Vec<Picture>, Error> {
    draw(dataset, &options.style.format())
}
