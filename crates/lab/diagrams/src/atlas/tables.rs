//! The cells and the curves as tables.

use crate::atlas::grid::{Grid, NUMBERS};
use crate::atlas::line::Line;
use motiform_continuation::Degenerate;
use motiform_store::columns::Column;
use motiform_study::AtlasPlan;
use motiform_study::quantity::{motion, special};

/// A row per cell and motion.
pub fn cell_columns(plan: &AtlasPlan, grid: &Grid) -> Vec<Column> {
    let scan = plan.scan();
    let rows: Vec<_> = grid
        .places
        .iter()
        .enumerate()
        .flat_map(|(cell, place)| place.motions.iter().map(move |found| (cell, place, found)))
        .collect();
    let mut all = vec![Column::of(&motion::CELL, rows.iter().map(|row| row.0).collect())];
    for (side, axis) in scan.computation.axes.iter().enumerate() {
        let values = rows.iter().map(|row| scan.axis_values(row.0)[side]).collect();
        all.push(Column::new(&axis.name, "the parameter", values));
    }
    all.extend([
        Column::of(&motion::REGIME, rows.iter().map(|row| row.2.regime.name()).collect()),
        Column::of(&motion::ROWS, rows.iter().map(|row| row.2.rows).collect()),
        Column::of(&motion::COMPUTED, rows.iter().map(|row| row.1.like.is_none()).collect()),
    ]);
    for (place, quantity) in NUMBERS.into_iter().enumerate() {
        all.push(Column::of(quantity, rows.iter().map(|row| row.2.numbers[place]).collect()));
    }
    all
}

/// A row per point of each curve.
pub fn curve_columns(plan: &AtlasPlan, lines: &[Line]) -> Vec<Column> {
    let curves = lines.iter().flat_map(|line| &line.curves).enumerate();
    let rows: Vec<_> = curves
        .flat_map(|(number, one)| one.curve.samples().map(move |sample| (number, one, sample)))
        .collect();
    let degenerate = rows.iter().map(|row| row.2.degenerate.map_or("", Degenerate::name)).collect();
    let mut all = vec![
        Column::of(&special::CURVE, rows.iter().map(|row| row.0).collect()),
        Column::of(&special::KIND, rows.iter().map(|row| row.1.curve.kind.name()).collect()),
        Column::of(&special::MOTION, rows.iter().map(|row| row.1.motion.name()).collect()),
        Column::of(&special::CODIMENSION_2, degenerate),
        Column::of(&special::UNSTABLE, rows.iter().map(|row| row.2.unstable).collect()),
    ];
    for (side, along) in plan.plane().iter().enumerate() {
        let values = rows.iter().map(|row| row.2.parameters[side]).collect();
        all.push(Column::new(&along.name, "the parameter", values));
    }
    all.push(Column::of(&special::PERIOD, rows.iter().map(|row| row.2.period).collect()));
    all
}
