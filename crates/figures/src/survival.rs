//! Survival curves: the share of events that last longer than a time.

use super::axes::{AxisKind, Scale};
use super::error::{FigureError, Result, check_finite};
use super::expected::ExpectedLine;
use super::figure::{Csv, figure};
use super::framed::Framed;
use super::geometry::{Point, Rect};
use super::legend::{BAND, Entry, Mark};
use super::paint::Paint;
use super::palette::{CATEGORIES, Colour};
use super::room::Room;
use super::svg::Svg;

const WIDTH: f64 = 540.0;
const HEIGHT: f64 = 300.0;

/// The share from a time on, until the next step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurvivalStep {
    /// When the share changes.
    pub t: f64,
    /// The share, from 0 to 1.
    pub share: f64,
    /// Lower end of its band.
    pub low: f64,
    /// Upper end of its band.
    pub high: f64,
}

/// A survival curve.
#[derive(Debug, Clone, PartialEq)]
pub struct SurvivalCurve {
    /// Markup for the legend.
    pub label: String,
    /// Steps by increasing time; the first one usually has the share 1.
    pub steps: Vec<SurvivalStep>,
    /// Time up to which the last share holds.
    pub end: f64,
}

/// Survival curves with their bands on a logarithmic axis: an exponential law is a straight line.
///
/// Shares of 0 have no place there: a curve ends with its last share above 0. The axis reaches down to half the least
/// share; what of a band lies below is cut off.
///
/// # Units   time as its label says; shares from 0 to 1; texts are markup (see [`super::Label`])
#[derive(Debug, Clone, PartialEq)]
pub struct SurvivalFigure {
    /// Line above the legend.
    pub title: String,
    /// Paragraphs below the axes: number of events, what the bands are.
    pub caption: Vec<String>,
    /// Label of the time axis.
    pub x_label: String,
    /// Label of the axis of shares.
    pub y_label: String,
    /// Curves, each in its own colour.
    pub curves: Vec<SurvivalCurve>,
    /// Lines to compare with, such as an exponential law.
    pub lines: Vec<ExpectedLine>,
}

impl Default for SurvivalFigure {
    fn default() -> Self {
        Self {
            title: String::new(),
            caption: Vec::new(),
            x_label: "*t*".to_owned(),
            y_label: "share that lasts longer".to_owned(),
            curves: Vec::new(),
            lines: Vec::new(),
        }
    }
}

const KINDS: [AxisKind; 2] = [AxisKind::Linear, AxisKind::Logarithmic];

impl SurvivalFigure {
    /// Draws the figure for a width.
    ///
    /// # Errors   no share above 0, a number that is not finite, or times that decrease
    pub fn svg_in(&self, room: Room) -> Result<Svg> {
        self.check()?;
        let curves = || self.curves.iter().zip(CATEGORIES.into_iter().cycle());
        let keys = curves().map(|(curve, colour)| Entry::new(Mark::Band(colour), &curve.label));
        let sheet = Framed {
            title: &self.title,
            caption: &self.caption,
            legend: keys.chain(self.lines.iter().map(ExpectedLine::key)).collect(),
            scale: self.scale()?,
            kinds: KINDS,
            labels: [&self.x_label, &self.y_label],
            room,
            grid: true,
            head: 0.0,
        };
        sheet.svg(|svg, scale| {
            curves().for_each(|(curve, colour)| curve.draw_band(svg, scale, colour));
            curves().for_each(|(curve, colour)| curve.draw_line(svg, scale, colour));
            self.lines.iter().for_each(|line| line.draw(svg, scale, KINDS));
            Ok(())
        })
    }

    /// Time from 0 on; log10 of the shares, down to a half of the least one.
    fn scale(&self) -> Result<Scale> {
        let seen = || self.curves.iter().flat_map(|c| c.steps.iter().filter(|s| s.share > 0.0));
        let times = seen().map(|s| s.t).chain(self.curves.iter().map(|c| c.end)).chain([0.0]);
        let least = seen().map(|s| s.share).fold(f64::INFINITY, f64::min);
        let shares = [KINDS[1].place(0.5 * least), KINDS[1].place(1.15)];
        let ranges = (KINDS[0].range(times, 0.01), KINDS[1].range(shares.into_iter().flatten(), 0.0));
        let ((Some(x), Some(y)), true) = (ranges, least.is_finite()) else {
            return Err(FigureError::Empty { what: "list of shares above 0" });
        };
        Ok(Scale { frame: Rect { x: 0.0, y: 0.0, w: WIDTH, h: HEIGHT }, x, y })
    }

    fn check(&self) -> Result<()> {
        for curve in &self.curves {
            let values = curve.steps.iter().flat_map(|s| [s.t, s.share, s.low, s.high]);
            check_finite("survival value (time, share, band in turn)", values.chain([curve.end]))?;
            let times: Vec<f64> = curve.steps.iter().map(|s| s.t).chain([curve.end]).collect();
            if let Some(i) = times.windows(2).position(|w| w[1] < w[0]) {
                return Err(FigureError::Unsorted { what: "survival time", index: i + 1 });
            }
        }
        check_finite("expected line value", self.lines.iter().flat_map(|l| &l.points).flatten().copied())
    }

    /// A row per step, and one per point of each line, which has no band.
    fn csv(&self) -> String {
        let mut csv = Csv::new(["curve", &self.x_label, &self.y_label, "low", "high"]);
        for curve in &self.curves {
            curve
                .steps
                .iter()
                .for_each(|s| csv.row(&[&curve.label], [s.t, s.share, s.low, s.high].map(Some)));
        }
        for line in &self.lines {
            line.points.iter().for_each(|[t, y]| csv.row(&[&line.label], [Some(*t), Some(*y), None, None]));
        }
        csv.finish()
    }
}

figure!(SurvivalFigure);

impl SurvivalCurve {
    fn draw_band(&self, svg: &mut Svg, scale: &Scale, colour: Colour) {
        let mut outline = self.stairs(scale, |s| s.high);
        outline.extend(self.stairs(scale, |s| s.low).into_iter().rev());
        svg.polyline(&outline, true, &Paint::fill(colour).opacity(BAND));
    }

    fn draw_line(&self, svg: &mut Svg, scale: &Scale, colour: Colour) {
        svg.polyline(&self.stairs(scale, |s| s.share), false, &Paint::stroke(colour, 1.6));
    }

    /// The steps as long as the share is above 0, in pixels inside the frame.
    fn stairs(&self, scale: &Scale, value: fn(&SurvivalStep) -> f64) -> Vec<Point> {
        let seen = self.steps.iter().take_while(|s| s.share > 0.0).count();
        let ends = self.steps.iter().skip(1).map(|s| s.t).chain([self.end]);
        let corners = self.steps[..seen].iter().zip(ends).flat_map(|(s, end)| {
            let y = KINDS[1].place(value(s)).unwrap_or(scale.y.min).clamp(scale.y.min, scale.y.max);
            [scale.map([s.t, y]), scale.map([end, y])]
        });
        corners.collect()
    }
}
