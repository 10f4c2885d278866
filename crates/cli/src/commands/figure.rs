//! `motiform figure`, and the drawing that `simulate` shares with it.

use super::film;
use crate::args::{DrawingOptions, FigureOptions};
use crate::output::{End, print, warn};
use motiform_branching::BranchFolder;
use motiform_branching::curves::CurveFolder;
use motiform_branching::draw::{Ordinate, draw_branches, draw_curves};
use motiform_figures::Style;
use motiform_files::{Folder, Kind, kind_of, read_dataset_by};
use motiform_lab::draw::{FigureFormat, Picture, draw, draw_scan};
use motiform_lab::long::read_shown;
use motiform_lab::scan::ScanFolder;
use motiform_study::study::FigureSettings;
use motiform_study::{Dataset, Error, plan};
use std::path::Path;

pub(crate) fn run(options: &FigureOptions) -> anyhow::Result<End> {
    film::check(&options.drawing.film)?;
    let mut end = End::Done;
    for path in &options.datasets {
        let pictures = drawn(path, options)?;
        let folder = Folder::redraw(path)?;
        for picture in &pictures {
            folder.draw(&picture.name, &picture.bytes, options.force)?;
        }
        folder.settle()?;
        let kept = folder.notes();
        let remedy = if options.force { "" } else { "; --force draws those of motiform again" };
        kept.iter().for_each(|note| warn(&format!("{note}{remedy}")));
        if !(kept.is_empty() || options.force) {
            end = End::NotAsAsked;
        }
        let names: Vec<&str> = pictures.iter().map(|picture| picture.name.as_str()).collect();
        print(&format!("{}: {}", path.display(), names.join(" ")))?;
    }
    Ok(end)
}

/// The pictures of a folder, whatever is in it.
fn drawn(path: &Path, options: &FigureOptions) -> anyhow::Result<Vec<Picture>> {
    match kind_of(path) {
        Some(Kind::Scan) => Ok(draw_scan(&ScanFolder::read(path)?, &format(&options.drawing))?),
        Some(Kind::Branches) => {
            let BranchFolder { plan, found } = BranchFolder::read(path)?;
            Ok(draw_branches(&plan, &found, Ordinate::Speed)?)
        }
        Some(Kind::Curves) => {
            let CurveFolder { plan, found } = CurveFolder::read(path)?;
            Ok(draw_curves(&plan, &found, None)?)
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
    draw(dataset, &format(options))
}

fn format(options: &DrawingOptions) -> FigureFormat {
    #[cfg(feature = "pdf")]
    let pdf = options.pdf;
    #[cfg(not(feature = "pdf"))]
    let pdf = false;
    let style = Style { title: options.title.clone(), no_caption: options.no_caption, width: options.width };
    FigureFormat { pdf, style }
}
