//! Figures of statistics in other units than those of the model.

use motiform_figures::{Chart, Figure};
use motiform_statistics::four_digits;
use motiform_study::{Dimension, Shown};

/// The dimension of a mean-square displacement.
pub(super) const SQUARE: Dimension = [2, 0];

/// The dimension of a probability density.
pub(super) fn density(of: Dimension) -> Dimension {
    of.map(|power| -power)
}

/// A number in model units, with four digits and its unit.
pub(super) fn in_words(units: &Shown, dimension: Dimension, value: f64) -> String {
    let unit = units.name(dimension, "");
    let space = if unit.is_empty() { "" } else { "\u{a0}" };
    format!("{}{space}{unit}", four_digits(value * units.factor(dimension)))
}

/// A figure with axes of these dimensions in these units; nothing without data.
pub(super) fn in_units(chart: Chart, dimensions: [Dimension; 2], units: &Shown) -> Option<Box<dyn Figure>> {
    let mut chart = chart.scaled(dimensions.map(|dimension| units.factor(dimension)));
    chart.x_label = units.label(&chart.x_label, dimensions[0]);
    chart.y_label = units.label(&chart.y_label, dimensions[1]);
    (!chart.is_empty()).then(|| Box::new(chart) as _)
}
