//! The pages of tracked cells.

use crate::output::warn;
use crate::progress::Progress;
use motiform_cells::report::{Case, Sink, pages};
use motiform_cells::{CellFit, CellTrack, Observation, Sample};
use motiform_dynamics::Watch;
use motiform_lab::draw::FigureFormat;
use motiform_study::Error;
use std::collections::HashMap;

/// Draws the pages of observed cells, with their fits as far as these are done; `together`: with the one fit of all cells. Each goes to
/// `write` at once. If Ctrl-C stopped the drawing, a warning and `false`: not all pages are drawn.
pub(crate) fn draw(
    sample: &Sample,
    (cells, observations): (&[&CellTrack], &[Observation]),
    (fits, together): (&[CellFit], bool),
    (threads, format): (usize, &FigureFormat),
    write: &Sink<'_>,
) -> anyhow::Result<bool> {
    let own: HashMap<&str, &CellFit> = match together {
        true => HashMap::new(),
        false => fits.iter().map(|fit| (fit.name.as_str(), fit)).collect(),
    };
    let case = |(cell, observation)| {
        let cell: &CellTrack = cell;
        Case { cell, observation, fit: own.get(cell.name.as_str()).copied() }
    };
    let cases: Vec<Case<'_>> = cells.iter().copied().zip(observations).map(case).collect();
    let common = if together { fits.first() } else { None };
    let made = Progress::new(cells.len() as f64, "pages").over(|watch| match watch.stopped() {
        true => Ok(false),
        false => pages(sample, &cases, common, threads, format, watch, write),
    });
    match made {
        Ok(true) => Ok(true),
        Ok(false) | Err(Error::Interrupted) => {
            warn("interrupted: not all pages are drawn");
            Ok(false)
        }
        Err(error) => Err(error.into()),
    }
}
