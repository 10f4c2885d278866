//! A line from theory or from a fit.

use super::axes::Scale;
use super::clip::clip;
use super::error::{Result, check_finite};
use super::geometry::Point;
use super::layer::{Marks, Rank, Row};
use super::legend::{Entry, Mark};
use super::line_style::LineStyle;
use super::paint::Paint;
use super::palette::WHITE;
use super::plane::Plane;
use super::svg::Svg;

/// A line to compare data with. It does not widen the axes.
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
    /// Draws the line on a white ground, over cells; `scale` is in data units.
    pub(super) fn draw_cased(&self, svg: &mut Svg, scale: &Scale) {
        let points: Vec<Point> = self.points.iter().map(|point| scale.map(*point)).collect();
        for piece in clip(&points, scale.frame) {
            svg.polyline(&piece, false, &Paint::stroke(WHITE, 3.6).opacity(0.85));
            svg.polyline(&piece, false, &self.style.paint());
        }
    }
}

impl Marks for ExpectedLine {
    fn check(&self) -> Result<()> {
        check_finite("expected line value", self.points.iter().flatten().copied())
    }

    fn rank(&self) -> Rank {
        Rank::Theory
    }

    fn keys(&self, _: usize) -> Vec<Entry> {
        vec![Entry::new(Mark::Line(self.style.paint()), &self.label)]
    }

    fn draw(&self, svg: &mut Svg, plane: &Plane, _: usize) {
        for piece in plane.pieces(self.points.iter().copied()) {
            svg.polyline(&piece, false, &self.style.paint());
        }
    }

    fn columns(&self) -> [&'static [&'static str]; 2] {
        [&["line"], &[]]
    }

    fn rows(&self) -> Vec<Row> {
        self.points.iter().map(|at| Row::named(&self.label, *at, &[])).collect()
    }
}
