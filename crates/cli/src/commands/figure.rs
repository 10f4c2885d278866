//! `motiform figure`, and the drawing that `simulate` shares with it.

use super::{curves, film};
use crate::args::{DrawingOptions, FigureOptions};
use crate::output::{End, print};
use motiform_branching::BranchFolder;
use motiform_branching::curves::CurveFolder;
use motiform_branching::draw::{Ordinate, draw_branches};
use motiform_figures::Style;
use motiform_files::{read_dataset, replace_file};
use motiform_lab::draw::{FigureFormat, Picture, draw, draw_scan};
use motiform_lab::scan::ScanFolder;
use motiform_study::study::FigureSettings;
use motiform_study::{Dataset, Error, plan};
use std::path::Path;

pub(crate) fn run(options: &FigureOptions) -> anyhow::Result<End> {
    film::check(&options.drawing.film)?;
    for folder in &options.datasets {
        if ScanFolder::is_one(folder) {
            let names = write_scan(&ScanFolder::read(folder)?, &format(&options.drawing))?;
            print(&format!("{}: {}", folder.display(), names.join(" ")))?;
            continue;
        }
        if BranchFolder::is_one(folder) {
            let names = write_branches(folder)?;
            print(&format!("{}: {}", folder.display(), names.join(" ")))?;
            continue;
        }
        if CurveFolder::is_one(folder) {
            let names = curves::redraw(folder)?;
            print(&format!("{}: {}", folder.display(), names.join(" ")))?;
            continue;
        }
        let mut dataset = read_dataset(folder)?;
        apply(&options.drawing, &mut dataset.manifest.plan.figure);
        plan::check_figure(&dataset.manifest.plan.figure)?;
        let mut names = Vec::new();
        let stills = pictures(&dataset, &options.drawing)?;
        let films = film::convert(&stills, &options.drawing.film)?;
        for picture in stills.into_iter().chain(films) {
            replace_file(&folder.join(&picture.name), &picture.bytes)?;
            names.push(picture.name);
        }
        print(&format!("{}: {}", folder.display(), names.join(" ")))?;
    }
    Ok(End::Done)
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

/// Draws a scan into its folder; returns the names of its figures.
pub(crate) fn write_scan(folder: &ScanFolder, format: &FigureFormat) -> Result<Vec<String>, Error> {
    let mut names = Vec::new();
    for picture in draw_scan(folder, format)? {
        replace_file(&folder.path().join(&picture.name), &picture.bytes)?;
        names.push(picture.name);
    }
    Ok(names)
}

/// Draws branches into their folder; the names of the figures.
fn write_branches(path: &Path) -> Result<Vec<String>, Error> {
    let BranchFolder { plan, found } = BranchFolder::read(path)?;
    let mut names = Vec::new();
    for picture in draw_branches(&plan, &found, Ordinate::Speed)? {
        replace_file(&path.join(&picture.name), &picture.bytes)?;
        names.push(picture.name);
    }
    Ok(names)
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
