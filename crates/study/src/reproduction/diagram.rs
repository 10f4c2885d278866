//! A scan as a phase diagram.

use crate::figures::{Cell, PhaseDiagram};
use crate::scan::CellSummary;
use crate::{Error, ScanPlan};
use motiform_models::parameters::index_of;

/// The diagram of a scan over two axes, as SVG.
pub(super) fn diagram(
    plan: &ScanPlan,
    cells: &[CellSummary],
    title: &str,
    caption: &[String],
) -> Result<String, Error> {
    let axes = &plan.computation.axes;
    let place = |cell: usize| plan.axis_values(cell);
    let shares = |summary: &CellSummary| {
        let named = |motion: &crate::scan::Motion| (motion.regime.name().to_owned(), motion.share);
        summary.motions.iter().map(named).collect()
    };
    let cell = |summary: &CellSummary| {
        let values = place(summary.cell);
        Cell { x: values[0], y: values.get(1).copied().unwrap_or(0.0), shares: shares(summary) }
    };
    let values = |index: usize| {
        let mut values = axes.get(index).map_or(Vec::new(), |axis| axis.values.clone());
        values.sort_by(f64::total_cmp);
        values
    };
    let figure = PhaseDiagram {
        title: title.to_owned(),
        caption: caption.to_vec(),
        x_label: symbol(plan, 0)?,
        y_label: symbol(plan, 1)?,
        x: values(0),
        y: values(1),
        cells: cells.iter().map(cell).collect(),
        lines: Vec::new(),
    };
    Ok(figure.svg()?)
}

/// The symbol of an axis as markup; nothing where there is no such axis.
fn symbol(plan: &ScanPlan, index: usize) -> Result<String, Error> {
    let Some(axis) = plan.computation.axes.get(index) else { return Ok(String::new()) };
    let info = plan.info()?;
    let place = index_of(info.parameters(), info.name, &axis.name)?;
    Ok(info.parameters()[place].symbol.to_owned())
}
