//! Measured values with their errors.

use super::axes::AxisKind;
use super::clip::clip;
use super::error::{FigureError, Result, check_finite};
use super::geometry::Point;
use super::glyph::{self, Glyph};
use super::layer::{Marks, Row};
use super::legend::{Entry, Mark};
use super::marks::REGIMES;
use super::paint::Paint;
use super::palette::{CATEGORIES, Colour};
use super::plane::Plane;
use super::svg::Svg;

/// Room between data and frame, as shares of the axes.
pub(super) const ROOM: [f64; 2] = [0.05; 2];
/// Columns beside those of the axes.
pub(super) const COLUMNS: [&[&str]; 2] = [&["series"], &["error"]];

/// A measured value with its error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// The abscissa of the measurement.
    pub x: f64,
    /// The value.
    pub y: f64,
    /// Half the length of its error bar, at least 0; 0 draws none.
    pub error: f64,
}

/// Measured values of one kind: markers with error bars, such as an exponent against a parameter.
///
/// An error bar that reaches down to 0 on a logarithmic axis ends at the frame without a cap.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorBarSeries {
    /// Markup for the legend; series without a label have no entry. The name of a regime gives the series that regime's
    /// marker and colour.
    pub label: String,
    /// The values, in the order in which a line joins them.
    pub points: Vec<Measured>,
    /// `true` if a line joins them.
    pub joined: bool,
}

impl Marks for ErrorBarSeries {
    fn check(&self) -> Result<()> {
        let values = self.points.iter().flat_map(|m| [m.x, m.y, m.error]);
        check_finite("measured value (x, y, error in turn)", values)?;
        match self.points.iter().find(|m| m.error < 0.0) {
            Some(Measured { error: value, .. }) => {
                Err(FigureError::OutOfRange { what: "an error", value: *value, min: 0.0, max: f64::MAX })
            }
            None => Ok(()),
        }
    }

    fn extent(&self, kinds: [AxisKind; 2]) -> [Vec<f64>; 2] {
        let all: Vec<Place> = self.places(kinds).collect();
        let ends = all.iter().flat_map(|(at, ends)| ends.iter().copied().flatten().chain([at[1]]));
        [all.iter().map(|(at, _)| at[0]).collect(), ends.collect()]
    }

    fn room(&self) -> [f64; 2] {
        ROOM
    }

    fn left_out(&self, kinds: [AxisKind; 2]) -> usize {
        self.points.len() - self.places(kinds).count()
    }

    fn keys(&self, number: usize) -> Vec<Entry> {
        let (glyph, colour) = self.look(number);
        let mark = Mark::Point(glyph, colour, self.joined);
        (!self.label.is_empty()).then(|| Entry::new(mark, &self.label)).into_iter().collect()
    }

    fn draw(&self, svg: &mut Svg, plane: &Plane, number: usize) {
        let (glyph, colour) = self.look(number);
        let map = |at: Point| plane.scale.map(at);
        let drawn: Vec<Place> = self.places(plane.kinds).collect();
        let radius = if drawn.len() > 60 { 2.4 } else { 3.6 };
        if self.joined {
            let line: Vec<_> = drawn.iter().map(|(at, _)| map(*at)).collect();
            for piece in clip(&line, plane.scale.frame) {
                svg.polyline(&piece, false, &Paint::stroke(colour, 1.4).opacity(0.8));
            }
        }
        let lines: Vec<_> = drawn.iter().flat_map(|place| bar(plane, place, radius)).collect();
        svg.lines(&lines, &Paint::stroke(colour, 1.2));
        drawn.iter().for_each(|(at, _)| glyph.draw(svg, map(*at), radius, colour));
    }

    fn columns(&self) -> [&'static [&'static str]; 2] {
        COLUMNS
    }

    fn rows(&self) -> Vec<Row> {
        self.points.iter().map(|m| Row::named(&self.label, [m.x, m.y], &[m.error])).collect()
    }
}

/// Places along the axes of a value and of the ends of its error bar.
type Place = (Point, [Option<f64>; 2]);

impl ErrorBarSeries {
    /// Marker and colour: those of its regime, or the next of the usual ones.
    fn look(&self, number: usize) -> (Glyph, Colour) {
        let regime = REGIMES.into_iter().find(|mark| mark.words == self.label);
        let next = number % CATEGORIES.len();
        regime.map_or((glyph::SERIES[next], CATEGORIES[next]), |mark| (mark.glyph, mark.colour))
    }

    /// Those of the values that have one.
    fn places(&self, [x, y]: [AxisKind; 2]) -> impl Iterator<Item = Place> {
        self.points.iter().filter_map(move |m| {
            let ends = [m.y - m.error, m.y + m.error].map(|end| y.place(end));
            Some(([x.place(m.x)?, y.place(m.y)?], ends))
        })
    }
}

/// An error bar with its caps; an end without place lies at the lower edge of the frame. Nothing where the marker, whose
/// radius is that of the caps, hides the bar.
fn bar(plane: &Plane, ([x, _], ends): &Place, cap: f64) -> Vec<[Point; 2]> {
    let scale = plane.scale;
    let [low, high] = ends.map(|end| scale.map([*x, end.unwrap_or(scale.y.min)]));
    if low[1] - high[1] <= 2.0 * cap {
        return Vec::new();
    }
    let caps = ends.iter().flatten().map(|end| scale.map([*x, *end]));
    let caps = caps.map(|[px, py]| [[px - cap, py], [px + cap, py]]);
    [[low, high]].into_iter().chain(caps).collect()
}
