//! The cells and the curves as tables.

use crate::atlas::grid::{Grid, NUMBERS};
use crate::atlas::line::Line;
use motiform_store::columns::{Column, Values};
use motiform_study::AtlasPlan;
use motiform_study::quantity::{motion, special};

fn whole(values: impl Iterator<Item = usize>) -> Values {
    Values::Whole(values.map(|value| i64::try_from(value).unwrap_or(i64::MAX)).collect())
}

/// A row per cell and motion.
#[must_use]
pub fn cell_columns(plan: &AtlasPlan, grid: &Grid) -> Vec<Column> {
    let scan = plan.scan();
    let rows: Vec<_> = grid
        .places
        .iter()
        .enumerate()
        .flat_map(|(cell, place)| place.motions.iter().map(move |found| (cell, place, found)))
        .collect();
    let mut all = vec![Column::of(&motion::CELL, whole(rows.iter().map(|row| row.0)))];
    for (side, axis) in scan.computation.axes.iter().enumerate() {
        let values = rows.iter().map(|row| scan.axis_values(row.0)[side]).collect();
        all.push(Column::new(&axis.name, "the parameter", Values::Number(values)));
    }
    let names = rows.iter().map(|row| row.2.regime.name().to_owned()).collect();
    all.push(Column::of(&motion::REGIME, Values::Text(names)));
    all.push(Column::of(&motion::ROWS, whole(rows.iter().map(|row| row.2.rows))));
    let is_computed = rows.iter().map(|row| usize::from(row.1.like.is_none()));
    all.push(Column::of(&motion::COMPUTED, whole(is_computed)));
    for (place, quantity) in NUMBERS.into_iter().enumerate() {
        let values = rows.iter().map(|row| row.2.numbers[place].unwrap_or(f64::NAN)).collect();
        all.push(Column::of(quantity, Values::Number(values)));
    }
    all
}

/// A row per point of each curve.
#[must_use]
pub fn curve_columns(plan: &AtlasPlan, lines: &[Line]) -> Vec<Column> {
    let curves = lines.iter().flat_map(|line| &line.curves).enumerate();
    let rows: Vec<_> = curves
        .flat_map(|(number, one)| one.curve.samples().map(move |sample| (number, one, sample)))
        .collect();
    let text = |read: &dyn Fn(usize) -> &'static str| {
        Values::Text((0..rows.len()).map(|row| read(row).to_owned()).collect())
    };
    let mut all = vec![
        Column::of(&special::CURVE, whole(rows.iter().map(|row| row.0))),
        Column::of(&special::KIND, text(&|row| rows[row].1.curve.kind.name())),
        Column::of(&special::MOTION, text(&|row| rows[row].1.motion.name())),
        Column::of(
            &special::CODIMENSION_2,
            text(&|row| rows[row].2.degenerate.map_or("", |kind| kind.name())),
        ),
        Column::of(&special::UNSTABLE, whole(rows.iter().map(|row| row.2.unstable))),
    ];
    for (side, along) in plan.plane().iter().enumerate() {
        let values = rows.iter().map(|row| row.2.parameters[side]).collect();
        all.push(Column::new(&along.name, "the parameter", Values::Number(values)));
    }
    let periods = rows.iter().map(|row| row.2.period.unwrap_or(f64::NAN)).collect();
    all.push(Column::of(&special::PERIOD, Values::Number(periods)));
    all
}
