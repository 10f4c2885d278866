//! Survival curves: the share of events that last longer than a time.

use super::axes::AxisKind;
use super::bands::{COLUMNS, colour};
use super::chart::Chart;
use super::error::{FigureError, Result, check_finite};
use super::geometry::Point;
use super::layer::{Marks, Row};
use super::legend::{BAND, Entry, Mark};
use super::paint::Paint;
use super::plane::Plane;
use super::svg::Svg;

/// The share from a time on, until the next step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurvivalStep {
    /// The time when the share changes.
    pub t: f64,
    /// The share, from 0 to 1.
    pub share: f64,
    /// Lower end of its band.
    pub low: f64,
    /// Upper end of its band.
    pub high: f64,
}

/// A survival curve with its band: steps.
///
/// Shares of 0 have no place on a logarithmic axis: a curve ends with its last share above 0. The axis reaches down to half the least
/// share, and time from 0 on; what of a band lies below is cut off.
#[derive(Debug, Clone, PartialEq)]
pub struct SurvivalCurve {
    /// Markup for the legend.
    pub label: String,
    /// Steps by increasing time; the first one usually has the share 1.
    pub steps: Vec<SurvivalStep>,
    /// Time up to which the last share holds.
    pub end: f64,
}

impl Chart {
    /// Survival curves on a logarithmic axis, where an exponential law is a straight line.
    pub fn survival(curves: impl IntoIterator<Item = SurvivalCurve>) -> Self {
        let (x_label, y_label) = ("*t*".to_owned(), "share that lasts longer".to_owned());
        Self { x_label, y_label, logarithmic_y: true, ..Self::default() }.with(curves)
    }
}

impl Marks for SurvivalCurve {
    fn check(&self) -> Result<()> {
        let values = self.steps.iter().flat_map(|s| [s.t, s.share, s.low, s.high]);
        check_finite("survival value (time, share, band in turn)", values.chain([self.end]))?;
        let times: Vec<f64> = self.steps.iter().map(|s| s.t).chain([self.end]).collect();
        match times.windows(2).position(|w| w[1] < w[0]) {
            Some(i) => Err(FigureError::Unsorted { what: "survival time", index: i + 1 }),
            None => Ok(()),
        }
    }

    /// Time from 0 on; shares down to a half of the least one.
    fn extent(&self, [x, y]: [AxisKind; 2]) -> [Vec<f64>; 2] {
        let seen = || self.steps.iter().filter(|s| s.share > 0.0);
        let times = seen().map(|s| s.t).chain([self.end, 0.0]).filter_map(|t| x.place(t));
        let least = seen().map(|s| s.share).reduce(f64::min);
        let shares = least.into_iter().flat_map(|least| [0.5 * least, 1.15]).filter_map(|s| y.place(s));
        [times.collect(), shares.collect()]
    }

    fn room(&self) -> [f64; 2] {
        [0.01, 0.0]
    }

    fn keys(&self, number: usize) -> Vec<Entry> {
        vec![Entry::new(Mark::Band(colour(number)), &self.label)]
    }

    fn draw_ground(&self, svg: &mut Svg, plane: &Plane, number: usize) {
        let mut outline = self.stairs(plane, |s| s.high);
        outline.extend(self.stairs(plane, |s| s.low).into_iter().rev());
        svg.polyline(&outline, true, &Paint::fill(colour(number)).opacity(BAND));
    }

    fn draw(&self, svg: &mut Svg, plane: &Plane, number: usize) {
        svg.polyline(&self.stairs(plane, |s| s.share), false, &Paint::stroke(colour(number), 1.6));
    }

    fn columns(&self) -> [&'static [&'static str]; 2] {
        COLUMNS
    }

    fn rows(&self) -> Vec<Row> {
        let row = |s: &SurvivalStep| Row::named(&self.label, [s.t, s.share], &[s.low, s.high]);
        self.steps.iter().map(row).collect()
    }
}

impl SurvivalCurve {
    /// The steps as long as the share is above 0, in pixels inside the frame.
    fn stairs(&self, plane: &Plane, value: fn(&SurvivalStep) -> f64) -> Vec<Point> {
        let seen = self.steps.iter().take_while(|s| s.share > 0.0).count();
        let ends = self.steps.iter().skip(1).map(|s| s.t).chain([self.end]);
        let corners = self.steps[..seen].iter().zip(ends).flat_map(|(s, end)| {
            let y = plane.upwards(value(s));
            [s.t, end].map(|t| plane.scale.map([t, y]))
        });
        corners.collect()
    }
}
