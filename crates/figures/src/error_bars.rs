//! Measured values with their errors against a parameter.

use super::axes::{AxisKind, Scale};
use super::clip::clip;
use super::error::{FigureError, Result, check_finite};
use super::expected::ExpectedLine;
use super::figure::{Csv, figure};
use super::framed::Framed;
use super::geometry::{Point, Rect};
use super::glyph::{self, Glyph};
use super::legend::{Entry, Mark};
use super::marks::REGIMES;
use super::paint::Paint;
use super::palette::{CATEGORIES, Colour, GREY, INK};
use super::room::Room;
use super::svg::Svg;

const WIDTH: f64 = 540.0;
const HEIGHT: f64 = 300.0;
/// Room between data and frame, as a share of the axis.
const ROOM: f64 = 0.05;
/// Half the length of a cap, in pixels.
const CAP: f64 = 3.6;

/// A measured value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// Where it was measured.
    pub x: f64,
    /// The value.
    pub y: f64,
    /// Half the length of its error bar, at least 0; 0 draws none.
    pub error: f64,
}

/// Measured values of one kind.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorBarSeries {
    /// Markup for the legend; series without a label have no entry. The name of a regime gives the series that regime's
    /// marker and colour.
    pub label: String,
    /// The values, in the order in which a line joins them.
    pub points: Vec<Measured>,
    /// Whether a line joins them.
    pub joined: bool,
}

/// An interval without a marker: the error of a value that is not symmetric.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Where.
    pub x: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end; infinite for none, and the bar then leaves the frame without a cap.
    pub high: f64,
}

/// Points with error bars, such as an exponent against a parameter.
///
/// On a logarithmic axis what is not above 0 is left out, and the caption counts it; an error bar that reaches down to 0
/// ends at the frame without a cap.
///
/// # Units   those of the values; texts are markup (see [`super::Label`])
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ErrorBarFigure {
    /// Line above the legend.
    pub title: String,
    /// Paragraphs below the axes, in particular the meaning of the error bars.
    pub caption: Vec<String>,
    /// Label of the x axis.
    pub x_label: String,
    /// Label of the y axis.
    pub y_label: String,
    /// The data; each series has its own colour and marker.
    pub series: Vec<ErrorBarSeries>,
    /// Bars whose ends are given, behind the data.
    pub intervals: Vec<Interval>,
    /// Lines behind the data; they do not widen the axes.
    pub lines: Vec<ExpectedLine>,
    /// Whether the value 0 is in sight and has a line (of no account on a logarithmic axis).
    pub zero_line: bool,
    /// Whether the x axis is logarithmic.
    pub logarithmic_x: bool,
    /// Whether the y axis is logarithmic.
    pub logarithmic_y: bool,
}

impl ErrorBarFigure {
    /// Draws the figure for a width.
    ///
    /// # Errors   nothing that has a place on the axes, a number that is not finite, or a negative error
    pub fn svg_in(&self, room: Room) -> Result<Svg> {
        self.check()?;
        let caption = self.caption();
        let sheet = Framed {
            title: &self.title,
            caption: &caption,
            legend: self.legend(),
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
            for line in &self.lines {
                line.draw(svg, scale, self.kinds());
            }
            self.draw_intervals(svg, scale);
            for (series, look) in self.series.iter().zip(self.looks()) {
                self.draw_series(svg, scale, series, look);
            }
            Ok(())
        })
    }

    /// Marker and colour of each series: those of its regime, or the next of the usual ones.
    fn looks(&self) -> impl Iterator<Item = Look> {
        let usual = glyph::SERIES.into_iter().zip(CATEGORIES).cycle();
        let regime = |label: &str| REGIMES.into_iter().find(|mark| mark.name == label);
        let look = move |(series, usual): (&ErrorBarSeries, Look)| {
            regime(&series.label).map_or(usual, |mark| (mark.glyph, mark.colour))
        };
        self.series.iter().zip(usual).map(look)
    }

    fn kinds(&self) -> [AxisKind; 2] {
        let kind = |logarithmic| if logarithmic { AxisKind::Logarithmic } else { AxisKind::Linear };
        [kind(self.logarithmic_x), kind(self.logarithmic_y)]
    }

    /// Places along the axes of a value and of the ends of its error bar.
    fn places(&self, m: &Measured) -> Option<(Point, [Option<f64>; 2])> {
        let [x, y] = self.kinds();
        let ends = [m.y - m.error, m.y + m.error].map(|end| y.place(end));
        Some(([x.place(m.x)?, y.place(m.y)?], ends))
    }

    fn scale(&self) -> Result<Scale> {
        let all: Vec<_> = self.series.iter().flat_map(|s| &s.points).filter_map(|m| self.places(m)).collect();
        let [x, y] = self.kinds();
        let ends = all.iter().flat_map(|(at, ends)| ends.iter().copied().flatten().chain([at[1]]));
        let zero = (self.zero_line && !self.logarithmic_y).then_some(0.0);
        let bars = || self.intervals.iter();
        let finite = bars().flat_map(|bar| [bar.low, bar.high]).filter(|end| end.is_finite());
        let xs = all.iter().map(|(at, _)| at[0]).chain(bars().filter_map(|bar| x.place(bar.x)));
        let ys = ends.chain(zero).chain(finite.filter_map(|end| y.place(end)));
        let ranges = (x.range(xs, ROOM), y.range(ys, ROOM));
        let (Some(x), Some(y), false) = (ranges.0, ranges.1, all.is_empty() && self.intervals.is_empty())
        else {
            return Err(FigureError::Empty {
                what: "list of measured values (on a logarithmic axis: above 0)",
            });
        };
        Ok(Scale { frame: Rect { x: 0.0, y: 0.0, w: WIDTH, h: HEIGHT }, x, y })
    }

    fn caption(&self) -> Vec<String> {
        let points = self.series.iter().flat_map(|s| &s.points);
        let left_out = points.filter(|m| self.places(m).is_none()).count();
        let note = format!("Not drawn, since not above 0: {left_out} of the values.");
        self.caption.iter().cloned().chain((left_out > 0).then_some(note)).collect()
    }

    fn legend(&self) -> Vec<Entry> {
        let labelled = self.series.iter().zip(self.looks()).filter(|(series, _)| !series.label.is_empty());
        let key = |(s, (glyph, colour)): (&ErrorBarSeries, _)| {
            Entry::new(Mark::Point(glyph, colour, s.joined), &s.label)
        };
        labelled.map(key).chain(self.lines.iter().map(ExpectedLine::key)).collect()
    }

    /// The intervals, in the colour of axes; what reaches beyond the frame ends there without a cap.
    fn draw_intervals(&self, svg: &mut Svg, scale: &Scale) {
        let [x, y] = self.kinds();
        let mut lines = Vec::new();
        for bar in &self.intervals {
            let Some(x) = x.place(bar.x) else { continue };
            let [low, high] = [bar.low, bar.high].map(|end| y.place(end).filter(|end| end.is_finite()));
            let [below, above] =
                [[x, low.unwrap_or(scale.y.min)], [x, high.unwrap_or(scale.y.max)]].map(|at| scale.map(at));
            lines.push([below, above]);
            let caps = low.map(|_| below).into_iter().chain(high.map(|_| above));
            lines.extend(caps.map(|[px, py]| [[px - CAP, py], [px + CAP, py]]));
        }
        svg.lines(&lines, &Paint::stroke(INK, 1.2));
    }

    fn draw_series(&self, svg: &mut Svg, scale: &Scale, series: &ErrorBarSeries, (glyph, colour): Look) {
        let drawn: Vec<_> = series.points.iter().filter_map(|m| self.places(m)).collect();
        let radius = if drawn.len() > 60 { 2.4 } else { 3.6 };
        if series.joined {
            let line: Vec<_> = drawn.iter().map(|(at, _)| scale.map(*at)).collect();
            for piece in clip(&line, scale.frame) {
                svg.polyline(&piece, false, &Paint::stroke(colour, 1.4).opacity(0.8));
            }
        }
        let lines: Vec<_> = drawn.iter().flat_map(|(at, ends)| bar(scale, *at, *ends, radius)).collect();
        svg.lines(&lines, &Paint::stroke(colour, 1.2));
        for (at, _) in &drawn {
            glyph.draw(svg, scale.map(*at), radius, colour);
        }
    }

    fn check(&self) -> Result<()> {
        let points = || self.series.iter().flat_map(|s| &s.points);
        check_finite("measured value (x, y, error in turn)", points().flat_map(|m| [m.x, m.y, m.error]))?;
        if let Some(m) = points().find(|m| m.error < 0.0) {
            return Err(FigureError::OutOfRange {
                what: "an error",
                value: m.error,
                min: 0.0,
                max: f64::MAX,
            });
        }
        check_finite(
            "end of an interval (x, low in turn)",
            self.intervals.iter().flat_map(|bar| [bar.x, bar.low]),
        )?;
        if let Some(index) = self.intervals.iter().position(|bar| bar.high.is_nan()) {
            return Err(FigureError::NotFinite { what: "upper end of an interval", index, value: f64::NAN });
        }
        check_finite("expected line value", self.lines.iter().flat_map(|l| &l.points).flatten().copied())
    }

    /// A row per measured value, and one per point of each line, which has no error.
    fn csv(&self) -> String {
        let mut csv = Csv::new(["series", &self.x_label, &self.y_label, "error"]);
        for series in &self.series {
            series.points.iter().for_each(|m| csv.row(&[&series.label], [m.x, m.y, m.error].map(Some)));
        }
        for bar in &self.intervals {
            let end = |label: &str, end: f64| (label.to_owned(), end);
            for (label, end) in [end("lower end", bar.low), end("upper end", bar.high)] {
                csv.row(&[&label], [Some(bar.x), Some(end).filter(|end| end.is_finite()), None]);
            }
        }
        for line in &self.lines {
            line.points.iter().for_each(|[x, y]| csv.row(&[&line.label], [Some(*x), Some(*y), None]));
        }
        csv.finish()
    }
}

figure!(ErrorBarFigure);

/// Marker and colour of a series.
type Look = (Glyph, Colour);

/// An error bar with its caps; an end without place lies at the lower edge of the frame. Nothing where the marker, whose
/// radius is that of the caps, hides the bar.
fn bar(scale: &Scale, [x, _]: Point, ends: [Option<f64>; 2], cap: f64) -> Vec<[Point; 2]> {
    let pixel = |end: Option<f64>| scale.map([x, end.unwrap_or(scale.y.min)]);
    let [low, high] = ends.map(pixel);
    if low[1] - high[1] <= 2.0 * cap {
        return Vec::new();
    }
    let caps = ends.into_iter().flatten().map(|end| scale.map([x, end]));
    let caps = caps.map(|[px, py]| [[px - cap, py], [px + cap, py]]);
    [[low, high]].into_iter().chain(caps).collect()
}
