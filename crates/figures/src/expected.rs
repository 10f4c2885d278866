//! A line from theory or from a fit.

use super::axes::{AxisKind, Scale};
use super::clip::clip;
use super::geometry::Point;
use super::legend::{Entry, Mark};
use super::line_style::LineStyle;
use super::svg::Svg;

/// A line to compare data with.
#[derive(Debug, Clone, PartialEq)]
pub struct ExpectedLine {
    /// Markup for the legend.
    pub label: String,
    /// Dashes.
    pub style: LineStyle,
    /// Points in data units, joined by straight lines on the axes as drawn. What lies outside the frame is cut off, and
    /// so are points without a place on a logarithmic axis.
    pub points: Vec<Point>,
}

impl ExpectedLine {
    pub(super) fn key(&self) -> Entry {
        Entry::new(Mark::Line(self.style.paint()), &self.label)
    }

    pub(super) fn draw(&self, svg: &mut Svg, scale: &Scale, [x, y]: [AxisKind; 2]) {
        let place = |p: &Point| Some(scale.map([x.place(p[0])?, y.place(p[1])?]));
        let places: Vec<_> = self.points.iter().map(place).collect();
        for piece in places.split(Option::is_none) {
            let piece: Vec<Point> = piece.iter().copied().flatten().collect();
            for part in clip(&piece, scale.frame) {
                svg.polyline(&part, false, &self.style.paint());
            }
        }
    }
}
