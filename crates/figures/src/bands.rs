//! Curves with bands of confidence, on axes of any kind.

use super::axes::{AxisKind, Scale};
use super::clip::clip;
use super::error::{FigureError, Result, check_finite};
use super::expected::ExpectedLine;
use super::figure::{Csv, figure};
use super::framed::Framed;
use super::geometry::{Point, Rect};
use super::legend::{BAND, Entry, Mark};
use super::paint::Paint;
use super::palette::{CATEGORIES, Colour, GREY};
use super::room::Room;
use super::svg::Svg;

const WIDTH: f64 = 540.0;
const HEIGHT: f64 = 300.0;
/// Room between curves and frame, as a share of the axis.
const ROOM: f64 = 0.05;

/// A point of a curve, with the ends of its band.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BandPoint {
    /// Where.
    pub x: f64,
    /// The value.
    pub y: f64,
    /// Lower end of the band; the value itself where there is none.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

/// A curve with its band.
#[derive(Debug, Clone, PartialEq)]
pub struct BandCurve {
    /// Markup for the legend; a curve without a label has no entry.
    pub label: String,
    /// Points, joined in this order.
    pub points: Vec<BandPoint>,
}

/// Curves with bands, such as an autocorrelation with its errors. Axes show all values; a band that reaches beyond is cut off. On a
/// logarithmic axis what is not above 0 has no place: a curve is interrupted there, and a band that reaches down to 0 ends at the frame.
///
/// # Units   those of the labels; texts are markup (see [`super::Label`])
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BandFigure {
    /// Line above the legend.
    pub title: String,
    /// Paragraphs below the axes, in particular the meaning of the bands.
    pub caption: Vec<String>,
    /// Label of the x axis.
    pub x_label: String,
    /// Label of the y axis.
    pub y_label: String,
    /// Curves, each in its own colour.
    pub curves: Vec<BandCurve>,
    /// Lines on top of the curves; they do not widen the axes.
    pub lines: Vec<ExpectedLine>,
    /// Whether the value 0 is in sight and has a line (of no account on a logarithmic axis).
    pub zero_line: bool,
    /// Whether the x axis is logarithmic.
    pub logarithmic_x: bool,
    /// Whether the y axis is logarithmic.
    pub logarithmic_y: bool,
}

impl BandFigure {
    /// Draws the figure for a width.
    ///
    /// # Errors   nothing that has a place on the axes, or a number that is not finite
    pub fn svg_in(&self, room: Room) -> Result<Svg> {
        let values = self.curves.iter().flat_map(|c| &c.points).flat_map(|p| [p.x, p.y, p.low, p.high]);
        check_finite("value of a curve (x, y, ends of the band in turn)", values)?;
        check_finite("expected line value", self.lines.iter().flat_map(|l| &l.points).flatten().copied())?;
        let curves = || self.curves.iter().zip(CATEGORIES.into_iter().cycle());
        let labelled = curves().filter(|(curve, _)| !curve.label.is_empty());
        let keys = labelled.map(|(curve, colour)| Entry::new(curve.mark(colour), &curve.label));
        let sheet = Framed {
            title: &self.title,
            caption: &self.caption,
            legend: keys.chain(self.lines.iter().map(ExpectedLine::key)).collect(),
            scale: self.scale()?,
            kinds: self.kinds(),
            labels: [&self.x_label, &self.y_label],
            room,
            grid: true,
            head: 0.0,
        };
        sheet.svg(|svg, scale| {
            if self.zero_line && !self.logarithmic_y {
                let [left, right] = [scale.x.min, scale.x.max].map(|x| scale.map([x, 0.0]));
                svg.line(left, right, &Paint::stroke(GREY, 1.2));
            }
            curves().for_each(|(curve, colour)| curve.draw_band(svg, scale, self.kinds(), colour));
            curves().for_each(|(curve, colour)| curve.draw_line(svg, scale, self.kinds(), colour));
            self.lines.iter().for_each(|line| line.draw(svg, scale, self.kinds()));
            Ok(())
        })
    }

    fn kinds(&self) -> [AxisKind; 2] {
        let kind = |logarithmic| if logarithmic { AxisKind::Logarithmic } else { AxisKind::Linear };
        [kind(self.logarithmic_x), kind(self.logarithmic_y)]
    }

    fn scale(&self) -> Result<Scale> {
        let [x, y] = self.kinds();
        let place = |p: &BandPoint| Some([x.place(p.x)?, y.place(p.y)?]);
        let all: Vec<Point> = self.curves.iter().flat_map(|c| &c.points).filter_map(place).collect();
        let zero = (self.zero_line && !self.logarithmic_y).then_some(0.0);
        let ranges =
            (x.range(all.iter().map(|p| p[0]), 0.02), y.range(all.iter().map(|p| p[1]).chain(zero), ROOM));
        let (Some(x), Some(y), false) = (ranges.0, ranges.1, all.is_empty()) else {
            return Err(FigureError::Empty { what: "list of points (on a logarithmic axis: above 0)" });
        };
        Ok(Scale { frame: Rect { x: 0.0, y: 0.0, w: WIDTH, h: HEIGHT }, x, y })
    }

    /// A row per point, and one per point of each line, which has no band.
    fn csv(&self) -> String {
        let mut csv = Csv::new(["curve", &self.x_label, &self.y_label, "low", "high"]);
        for curve in &self.curves {
            curve.points.iter().for_each(|p| csv.row(&[&curve.label], [p.x, p.y, p.low, p.high].map(Some)));
        }
        for line in &self.lines {
            line.points.iter().for_each(|[x, y]| csv.row(&[&line.label], [Some(*x), Some(*y), None, None]));
        }
        csv.finish()
    }
}

figure!(BandFigure);

impl BandCurve {
    fn mark(&self, colour: Colour) -> Mark {
        let banded = self.points.iter().any(|p| p.low < p.high);
        if banded { Mark::Band(colour) } else { Mark::Line(Paint::stroke(colour, 1.6)) }
    }

    /// One closed outline for each uninterrupted piece, cut off at the frame above and below.
    fn draw_band(&self, svg: &mut Svg, scale: &Scale, [x, y]: [AxisKind; 2], colour: Colour) {
        let ends = |p: &BandPoint| {
            let (at, _) = (x.place(p.x)?, y.place(p.y)?);
            let inside = |end: f64| y.place(end).unwrap_or(scale.y.min).clamp(scale.y.min, scale.y.max);
            (p.low < p.high).then(|| [[at, inside(p.low)], [at, inside(p.high)]].map(|p| scale.map(p)))
        };
        let places: Vec<Option<[Point; 2]>> = self.points.iter().map(ends).collect();
        for piece in places.split(Option::is_none).filter(|piece| piece.len() > 1) {
            let low = piece.iter().flatten().map(|ends| ends[0]);
            let high = piece.iter().flatten().rev().map(|ends| ends[1]);
            svg.polyline(&low.chain(high).collect::<Vec<_>>(), true, &Paint::fill(colour).opacity(BAND));
        }
    }

    fn draw_line(&self, svg: &mut Svg, scale: &Scale, [x, y]: [AxisKind; 2], colour: Colour) {
        let place = |p: &BandPoint| Some(scale.map([x.place(p.x)?, y.place(p.y)?]));
        let places: Vec<Option<Point>> = self.points.iter().map(place).collect();
        for piece in places.split(Option::is_none) {
            let piece: Vec<Point> = piece.iter().copied().flatten().collect();
            for part in clip(&piece, scale.frame) {
                svg.polyline(&part, false, &Paint::stroke(colour, 1.6));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure() -> BandFigure {
        let point = |k: u32| {
            let x = f64::from(k);
            BandPoint { x, y: x * x, low: x * x - 10.0, high: x * x + 10.0 }
        };
        let curves = vec![BandCurve { label: "curve".into(), points: (0..9).map(point).collect() }];
        BandFigure { curves, x_label: "x".into(), y_label: "y".into(), ..BandFigure::default() }
    }

    #[test]
    fn bands_that_leave_the_frame_are_cut_off() {
        for (logarithmic_x, logarithmic_y) in [(false, false), (false, true), (true, true)] {
            let svg = BandFigure { logarithmic_x, logarithmic_y, ..figure() }.svg().expect("a figure");
            assert!(!svg.contains("NaN") && !svg.contains("inf"));
        }
        assert_eq!(figure().csv().lines().count(), 10);
    }

    #[test]
    fn nothing_to_draw_is_an_error() {
        assert!(BandFigure::default().svg().is_err());
        let mut broken = figure();
        broken.curves[0].points[3].high = f64::INFINITY;
        assert!(broken.svg().is_err());
    }
}
