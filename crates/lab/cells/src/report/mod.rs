//! Tracked cells as HTML pages: `report.html` for the data set, and a page per cell with its outlines, its motion, the fitted
//! equations, their place on the paper's planes, and simulated cells beside the observed one.
//!
//! Turns results of [`crate`] into pages and figures; computes nothing. Definitions on the pages are
//! those of docs/cells.md, docs/statistics.md and docs/inference.md.

mod checks;
mod comparison;
mod fitted;
mod free;
mod index;
mod maps;
mod motion;
mod numbers;
mod outlines;
mod place;
mod population;
mod relatives;
mod summary;
mod terms;
mod words;

use crate::{CellFit, CellTrack, Observation, Prediction, Sample, Units};
use motiform_dynamics::Watch;
use motiform_figures::Figure;
use motiform_figures::report::{Picture, Report, ReportFigure};
use motiform_lab::draw::{FigureFormat, formats, sheet_in};
use motiform_lab::pool;
use motiform_study::Error;
use motiform_tracks::Cell;
use std::collections::HashMap;

/// All results for a cell.
#[derive(Debug, Clone, Copy)]
pub struct Case<'c> {
    /// Its frames.
    pub cell: &'c CellTrack,
    /// Its observed motion.
    pub observation: &'c Observation,
    /// Its fit, if there was one.
    pub fit: Option<&'c CellFit>,
}

impl<'c> Case<'c> {
    /// Amplitudes that are drawn: 3, or 4 of a model with z4.
    fn modes(&self) -> usize {
        let fitted = self.fit.and_then(|fit| fit.fitted.as_ref().ok());
        fitted.map_or(3, |fitted| fitted.model().library.modes.max(3))
    }

    /// Cells simulated by the fit.
    fn prediction(&self) -> Option<&'c Prediction> {
        self.fit?.prediction.as_ref()
    }
}

/// The page of the data set.
const INDEX: &str = "report";

/// Contents that all pages of a data set share.
pub(crate) struct Setting<'p> {
    /// Units as they are written on pages.
    pub units: Units,
    /// The style of figures.
    pub format: &'p FigureFormat,
}

impl Setting<'_> {
    /// A figure of a page, with the words below it.
    pub(crate) fn figure(
        &self,
        figure: impl Figure,
        caption: impl Into<String>,
    ) -> Result<ReportFigure, Error> {
        Ok(ReportFigure::new(sheet_in(figure, &self.format.style)?, caption))
    }

    /// Gives a page to `write`, and where PDF figures are asked for each of its figures as files of its own.
    fn write(&self, stem: &str, mut report: Report, write: &Sink<'_>) -> Result<(), Error> {
        report.without_captions = self.format.style.no_caption;
        for (number, section) in report.numbered().filter(|_| self.format.pdf) {
            let all = section.figures.iter().chain(&section.small_figures);
            for (figure, name) in all.zip(section.figure_names(number)) {
                let Picture::Svg(svg) = &figure.picture else { continue };
                for file in formats(&format!("{stem}-figure-{name}"), svg.clone(), self.format)? {
                    write(&file.name, &file.bytes)?;
                }
            }
        }
        write(&format!("{stem}.html"), report.html().as_bytes())
    }
}

/// Receiver of a page: takes its name and content.
pub type Sink<'w> = dyn Fn(&str, &[u8]) -> Result<(), Error> + Sync + 'w;

/// Draws one page per cell, with a picture of its path beside those of simulated cells, on `threads` threads, and the page of the data
/// set, and gives each to `write` as soon as it is drawn, the one of the data set last. Links are relative, so that a folder of them
/// can be moved. `together`: one fit of all cells, which has a place on the page of the data set. False if the watch stopped the work.
/// Figures of the pages have the style of `format`; where it asks for PDF, each is also a set of files, `PAGE-figure-NUMBER`. Units are
/// those of the data.
///
/// # Errors
/// Numbers that do not fit on an axis; those of `write`.
pub fn pages(
    sample: &Sample,
    cases: &[Case<'_>],
    together: Option<&CellFit>,
    threads: usize,
    format: &FigureFormat,
    watch: &dyn Watch,
    write: &Sink<'_>,
) -> Result<bool, Error> {
    let setting = Setting { units: Units::of(sample).typeset(), format };
    let names = crate::file_names(cases.iter().map(|case| case.cell.name.as_str()));
    let outlines: HashMap<&str, &Cell> =
        sample.tracks.cells.iter().map(|cell| (cell.name.as_str(), cell)).collect();
    let named: Vec<(&Case<'_>, &String)> = cases.iter().zip(&names).collect();
    let page = |(case, name): &(&Case<'_>, &String)| {
        let drawn = outlines.get(case.cell.name.as_str()).copied();
        let report = cell(case, drawn, name, &setting)?;
        for picture in comparison::pictures(case, name, &setting)? {
            write(&picture.name, &picture.bytes)?;
        }
        setting.write(&stem(name), report, write).map(Some)
    };
    let drawn = pool::as_far_as(&named, threads, watch, page)?;
    if drawn.iter().any(Option::is_none) {
        return Ok(false);
    }
    setting.write(INDEX, index::report(sample, cases, together, &names, &setting)?, write)?;
    Ok(true)
}

/// The page of a cell without its ending.
fn stem(name: &str) -> String {
    format!("report-{name}")
}

fn page_of(stem: &str) -> String {
    format!("{stem}.html")
}

fn page_name(name: &str) -> String {
    page_of(&stem(name))
}

/// The page of a cell.
fn cell(case: &Case<'_>, drawn: Option<&Cell>, name: &str, setting: &Setting<'_>) -> Result<Report, Error> {
    let units = &setting.units;
    let mut sections = vec![summary::section(case), free::section(case, setting)?];
    sections.extend(outlines::section(case, drawn, setting)?);
    sections.push(motion::section(case, setting)?);
    if let Some(fit) = case.fit {
        sections.push(fitted::section(fit, name, units));
        if let Ok(fitted) = &fit.fitted {
            sections.push(checks::section(fitted, setting)?);
            sections.push(place::section(&case.cell.name, fitted, setting)?);
        }
    }
    if let Some(prediction) = case.prediction() {
        sections.push(comparison::section(case, prediction, setting)?);
    }
    Ok(Report {
        title: format!("Cell {}: {}", motiform_figures::literal(&case.cell.name), index::verdict(case)),
        parent: Some(("All cells of the data set".to_owned(), page_of(INDEX))),
        sections,
        glossary: words::glossary(),
        ..Report::default()
    })
}
