//! Figures of statistics in other units than those of the model.

use motiform_figures::{Chart, Figure};
use motiform_statistics::four_digits;
use motiform_study::{Dimension, Quantity, Shown};

/// A number in model units, with four digits and its unit.
pub(super) fn in_words(units: &Shown, dimension: Dimension, value: f64) -> String {
    let unit = units.name(dimension, "");
    let space = if unit.is_empty() { "" } else { "\u{a0}" };
    format!("{}{space}{unit}", four_digits(value * units.factor(dimension)))
}

/// A chart with the axes of two quantities in these units.
pub(super) fn with_axes(chart: Chart, axes: [&Quantity; 2], units: &Shown) -> Option<Box<dyn Figure>> {
    let [x_label, y_label] = axes.map(|quantity| units.axis(quantity));
    let chart = chart.scaled(axes.map(|quantity| units.factor(quantity.dimension)));
    (!chart.is_empty()).then(|| Box::new(Chart { x_label, y_label, ..chart }) as _)
}
