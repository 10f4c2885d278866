//! Tracked cells as HTML pages: `report.html` for the data set, and a page per cell with its outlines, its motion, the fitted equations, their place on
//! the paper's planes, and simulated cells beside the observed one.
//!
//! Turns results of [`crate`] into pages and figures; computes nothing but the regimes beneath the places ([`Maps`]). Definitions on
//! the pages are those of docs/cells.md, docs/statistics.md and docs/inference.md.

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

pub use maps::Maps;

use crate::{CellFit, CellTrack, Observation, Prediction, Sample, Units};
use motiform_dynamics::Watch;
use motiform_figures::report::Report;
use motiform_inference::{Placement, Plane};
use motiform_lab::pool;
use motiform_study::Error;
use motiform_tracks::Cell;
use std::collections::HashMap;

/// What is known of a cell.
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
const INDEX: &str = "report.html";

/// What takes a page: its name and content.
pub type Sink<'w> = dyn Fn(&str, &[u8]) -> Result<(), Error> + Sync + 'w;

/// Draws one page per cell, with a picture of its path beside those of simulated cells, on `threads` threads, and the page of the data set, and gives each to `write` as soon as it is drawn, the one of the data set
/// last. Links are relative, so that a folder of them can be moved. `together`: one fit of all cells, which has a place on the page of the data set. False
/// if the watch stopped the work.
///
/// # Errors
/// Numbers that do not fit on an axis; those of `write`.
pub fn pages(
    sample: &Sample,
    (cases, together): (&[Case<'_>], Option<&CellFit>),
    maps: &Maps,
    (threads, watch): (usize, &dyn Watch),
    write: &Sink<'_>,
) -> Result<bool, Error> {
    let units = Units::of(sample).typeset();
    let names = crate::file_names(cases.iter().map(|case| case.cell.name.as_str()));
    let outlines: HashMap<&str, &Cell> =
        sample.tracks.cells.iter().map(|cell| (cell.name.as_str(), cell)).collect();
    let named: Vec<(&Case<'_>, &String)> = cases.iter().zip(&names).collect();
    let page = |(case, name): &(&Case<'_>, &String)| {
        let drawn = outlines.get(case.cell.name.as_str()).copied();
        let report = cell(case, drawn, name, maps, &units)?;
        for picture in comparison::pictures(case, name, &units)? {
            write(&picture.name, &picture.bytes)?;
        }
        write(&page_name(name), report.html().as_bytes()).map(Some)
    };
    let drawn = pool::as_far_as(&named, threads, watch, page)?;
    if drawn.iter().any(Option::is_none) {
        return Ok(false);
    }
    let index = index::report(sample, (cases, together), &names, maps, &units)?;
    write(INDEX, index.html().as_bytes())?;
    Ok(true)
}

/// The planes on which a cell has a place: those whose [`Maps`] are needed.
#[must_use]
pub fn planes(fits: &[CellFit]) -> Vec<Plane> {
    let placed = |number: usize| {
        let of = |fit: &CellFit| {
            fit.fitted.as_ref().is_ok_and(|f| matches!(f.places[number], Placement::Placed(_)))
        };
        fits.iter().any(of)
    };
    place::PLANES
        .into_iter()
        .enumerate()
        .filter(|(number, _)| placed(*number))
        .map(|(_, plane)| plane.0)
        .collect()
}

fn page_name(name: &str) -> String {
    format!("report-{name}.html")
}

/// The page of a cell.
fn cell(
    case: &Case<'_>,
    drawn: Option<&Cell>,
    name: &str,
    maps: &Maps,
    units: &Units,
) -> Result<Report, Error> {
    let mut sections = vec![summary::section(case), free::section(case, units)?];
    sections.extend(outlines::section(case, drawn, units)?);
    sections.push(motion::section(case, units)?);
    if let Some(fit) = case.fit {
        sections.push(fitted::section(fit, name, units));
        if let Ok(fitted) = &fit.fitted {
            sections.push(checks::section(fitted, units)?);
            sections.push(place::section(&case.cell.name, fitted, maps)?);
        }
    }
    if let Some(prediction) = case.prediction() {
        sections.push(comparison::section(case, prediction, units)?);
    }
    Ok(Report {
        title: format!("Cell {}: {}", motiform_figures::literal(&case.cell.name), index::verdict(case)),
        parent: Some(("All cells of the data set".to_owned(), INDEX.to_owned())),
        sections,
        glossary: words::glossary(),
        ..Report::default()
    })
}
