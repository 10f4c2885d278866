//! Figures of statistics in other units than those of the model.

use motiform_figures::{BandFigure, ErrorBarFigure, ExpectedLine, Figure};
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

/// A figure with axes of these dimensions in these units; nothing without a curve.
pub(super) fn bands(
    mut figure: BandFigure,
    dimensions: [Dimension; 2],
    units: &Shown,
) -> Option<Box<dyn Figure>> {
    let [x, y] = dimensions.map(|dimension| units.factor(dimension));
    for point in figure.curves.iter_mut().flat_map(|curve| &mut curve.points) {
        (point.x, point.y) = (x * point.x, y * point.y);
        (point.low, point.high) = (y * point.low, y * point.high);
    }
    rescale(&mut figure.lines, [x, y]);
    figure.x_label = units.label(&figure.x_label, dimensions[0]);
    figure.y_label = units.label(&figure.y_label, dimensions[1]);
    (!figure.curves.is_empty()).then(|| Box::new(figure) as _)
}

/// The same of a figure with bars.
pub(super) fn bars(mut figure: ErrorBarFigure, dimensions: [Dimension; 2], units: &Shown) -> Box<dyn Figure> {
    let [x, y] = dimensions.map(|dimension| units.factor(dimension));
    for point in figure.series.iter_mut().flat_map(|series| &mut series.points) {
        (point.x, point.y, point.error) = (x * point.x, y * point.y, y * point.error);
    }
    for interval in &mut figure.intervals {
        (interval.x, interval.low, interval.high) = (x * interval.x, y * interval.low, y * interval.high);
    }
    rescale(&mut figure.lines, [x, y]);
    figure.x_label = units.label(&figure.x_label, dimensions[0]);
    figure.y_label = units.label(&figure.y_label, dimensions[1]);
    Box::new(figure)
}

fn rescale(lines: &mut [ExpectedLine], [x, y]: [f64; 2]) {
    for point in lines.iter_mut().flat_map(|line| &mut line.points) {
        *point = [x * point[0], y * point[1]];
    }
}
