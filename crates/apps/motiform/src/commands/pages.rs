//! The pages of tracked cells.

use crate::output::warn;
use crate::progress::Progress;
use motiform_cells::report::{Case, Sink, pages};
use motiform_cells::{CellFit, CellTrack, Observation, Sample};
use motiform_dynamics::Watch;
use motiform_lab::draw::FigureFormat;
use motiform_study::Error;
use std::collections::HashMap;

/// The cells with their observed motions, and with their fits as far as these are done.
pub(crate) fn cases<'c>(
    cells: &[&'c CellTrack],
    observations: &'c [Observation],
    fits: &'c [CellFit],
) -> Vec<Case<'c>> {
    let own: HashMap<&str, &CellFit> = fits.iter().map(|fit| (fit.name.as_str(), fit)).collect();
    let case = |(&cell, observation): (&&'c CellTrack, _)| Case {
        cell,
        observation,
        fit: own.get(cell.name.as_str()).copied(),
    };
    cells.iter().zip(observations).map(case).collect()
}

/// Draws the pages of observed cells; `together` is the one fit of all cells. Each page goes to `write` at once. If Ctrl-C stopped the
/// drawing, a warning and `false`: not all pages are drawn.
pub(crate) fn draw(
    sample: &Sample,
    cases: &[Case<'_>],
    together: Option<&CellFit>,
    threads: usize,
    format: &FigureFormat,
    write: &Sink<'_>,
) -> anyhow::Result<bool> {
    let made = Progress::new(cases.len() as f64, "pages").over(|watch| match watch.stopped() {
        true => Ok(false),
        false => pages(sample, cases, together, threads, format, watch, write),
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
