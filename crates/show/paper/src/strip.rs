//! A scan over one parameter as a strip.

use super::context::Context;
use motiform_figures::{Cell, Drawn, ExpectedLine, PhaseDiagram};
use motiform_lab::scan::CellSummary;
use motiform_study::Error;

/// The motions found at each value, increasing, and lines in front of them.
pub(super) fn strip(
    context: &Context<'_>,
    x_label: &str,
    points: &[(f64, CellSummary)],
    lines: Vec<ExpectedLine>,
    caption: Vec<String>,
) -> Result<Drawn, Error> {
    let cell = |(x, summary): &(f64, CellSummary)| Cell { x: *x, y: 0.0, shares: summary.shares() };
    let figure = PhaseDiagram {
        caption,
        x_label: x_label.to_owned(),
        x: points.iter().map(|point| point.0).collect(),
        cells: points.iter().map(cell).collect(),
        lines,
        ..PhaseDiagram::default()
    };
    context.sheet(figure)
}
