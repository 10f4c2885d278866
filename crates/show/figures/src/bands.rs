//! Curves with bands of confidence.

use super::axes::AxisKind;
use super::error::{Result, check_finite};
use super::geometry::Point;
use super::layer::{Marks, Row};
use super::legend::{BAND, Entry, Mark};
use super::paint::Paint;
use super::palette::{CATEGORIES, Colour};
use super::plane::Plane;
use super::svg::Svg;

/// A point of a curve, with the ends of its band.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BandPoint {
    /// The abscissa.
    pub x: f64,
    /// The value.
    pub y: f64,
    /// Lower end of the band; the value itself where there is none.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

/// A curve with its band, such as an autocorrelation with its errors. The axes show all of its values; a band
/// that reaches beyond is cut off.
#[derive(Debug, Clone, PartialEq)]
pub struct BandCurve {
    /// Markup for the legend; a curve without a label has no entry.
    pub label: String,
    /// Points, joined in this order.
    pub points: Vec<BandPoint>,
}

/// The colour of a measured layer.
pub(super) fn colour(number: usize) -> Colour {
    CATEGORIES[number % CATEGORIES.len()]
}

/// Columns of curves and steps beside those of the axes.
pub(super) const COLUMNS: [&[&str]; 2] = [&["curve"], &["low", "high"]];

impl Marks for BandCurve {
    fn check(&self) -> Result<()> {
        let values = self.points.iter().flat_map(|p| [p.x, p.y, p.low, p.high]);
        check_finite("value of a curve (x, y, ends of the band in turn)", values)
    }

    fn extent(&self, [x, y]: [AxisKind; 2]) -> [Vec<f64>; 2] {
        let place = |p: &BandPoint| Some((x.place(p.x)?, y.place(p.y)?));
        let (xs, ys) = self.points.iter().filter_map(place).unzip();
        [xs, ys]
    }

    fn room(&self) -> [f64; 2] {
        [0.02, 0.05]
    }

    fn keys(&self, number: usize) -> Vec<Entry> {
        let banded = self.points.iter().any(|p| p.low < p.high);
        let mark =
            if banded { Mark::Band(colour(number)) } else { Mark::Line(Paint::stroke(colour(number), 1.6)) };
        (!self.label.is_empty()).then(|| Entry::new(mark, &self.label)).into_iter().collect()
    }

    /// One closed outline for each uninterrupted piece, cut off at the frame above and below.
    fn draw_ground(&self, svg: &mut Svg, plane: &Plane, number: usize) {
        let ends = |p: &BandPoint| {
            let (at, _) = (plane.kinds[0].place(p.x)?, plane.kinds[1].place(p.y)?);
            (p.low < p.high).then(|| [p.low, p.high].map(|end| plane.scale.map([at, plane.upwards(end)])))
        };
        let places: Vec<Option<[Point; 2]>> = self.points.iter().map(ends).collect();
        for piece in places.split(Option::is_none).filter(|piece| piece.len() > 1) {
            let low = piece.iter().flatten().map(|ends| ends[0]);
            let high = piece.iter().flatten().rev().map(|ends| ends[1]);
            let outline: Vec<Point> = low.chain(high).collect();
            svg.polyline(&outline, true, &Paint::fill(colour(number)).opacity(BAND));
        }
    }

    fn draw(&self, svg: &mut Svg, plane: &Plane, number: usize) {
        for piece in plane.pieces(self.points.iter().map(|p| [p.x, p.y])) {
            svg.polyline(&piece, false, &Paint::stroke(colour(number), 1.6));
        }
    }

    fn columns(&self) -> [&'static [&'static str]; 2] {
        COLUMNS
    }

    fn rows(&self) -> Vec<Row> {
        let row = |p: &BandPoint| Row::named(&self.label, [p.x, p.y], &[p.low, p.high]);
        self.points.iter().map(row).collect()
    }
}
