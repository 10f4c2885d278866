//! Power spectral density against frequency, both logarithmic.

use super::axes::{AxisKind, Scale};
use super::error::{FigureError, Result, check_finite};
use super::figure::{Csv, figure};
use super::framed::Framed;
use super::geometry::{Point, Range, Rect};
use super::legend::{Entry, Mark};
use super::paint::Paint;
use super::palette::Colour;
use super::room::Room;
use super::simplify::{envelope, simplify};
use super::svg::Svg;

/// Most decades of power in sight: what lies lower is the round-off of what was recorded.
const DECADES: f64 = 12.0;
const WIDTH: f64 = 560.0;
const HEIGHT: f64 = 300.0;

/// The spectrum of one quantity.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectrumCurve {
    /// Markup for the legend, which appears where there are several curves.
    pub label: String,
    /// Colour; see [`super::palette::CATEGORIES`].
    pub colour: Colour,
    /// Power spectral density, one value per frequency; what is not above 0 is left out.
    pub power: Vec<f64>,
}

/// Power spectra on logarithmic axes. The frequency 0 and powers that are not positive have no place there and leave a
/// gap.
///
/// # Units   those of the values; texts are markup (see [`super::Label`])
#[derive(Debug, Clone, PartialEq)]
pub struct SpectrumFigure {
    /// Line above the axes.
    pub title: String,
    /// Paragraphs below the axes: window, segments, number of samples.
    pub caption: Vec<String>,
    /// Label of the frequency axis.
    pub x_label: String,
    /// Label of the power axis.
    pub y_label: String,
    /// Frequencies, from 0 or above, not decreasing.
    pub frequencies: Vec<f64>,
    /// Curves, drawn in this order.
    pub curves: Vec<SpectrumCurve>,
}

impl Default for SpectrumFigure {
    fn default() -> Self {
        Self {
            title: String::new(),
            caption: Vec::new(),
            x_label: "frequency".to_owned(),
            y_label: "power spectral density".to_owned(),
            frequencies: Vec::new(),
            curves: Vec::new(),
        }
    }
}

impl SpectrumFigure {
    /// Draws the figure for a width.
    ///
    /// # Errors   nothing above 0, a number that is not finite, frequencies that decrease, or a curve of another length
    pub fn svg_in(&self, room: Room) -> Result<Svg> {
        self.check()?;
        let sheet = Framed {
            title: &self.title,
            caption: &self.caption,
            legend: self.legend(),
            scale: self.scale()?,
            kinds: [AxisKind::Logarithmic; 2],
            labels: [&self.x_label, &self.y_label],
            room,
            grid: true,
            head: 0.0,
        };
        sheet.svg(|svg, scale| {
            svg.clipped(scale.frame, |svg| {
                self.curves.iter().for_each(|curve| self.draw_curve(svg, curve, scale));
            });
            Ok(())
        })
    }

    fn legend(&self) -> Vec<Entry> {
        let entry = |c: &SpectrumCurve| Entry::new(Mark::Line(paint(c)), &c.label);
        let several = self.curves.len() > 1;
        self.curves.iter().filter(|_| several).map(entry).collect()
    }

    /// log10 of frequency and power over all curves, each at least a decade wide.
    fn scale(&self) -> Result<Scale> {
        let points = || self.curves.iter().flat_map(|c| self.points(c)).flatten();
        let range = |i: usize| Range::of(points().map(|p: Point| p[i]));
        let (Some(x), Some(y)) = (range(0), range(1)) else {
            return Err(FigureError::Empty { what: "spectrum above 0" });
        };
        let y = Range { min: y.min.max(y.max - DECADES), max: y.max };
        let y = y.with_span(y.span() * 1.1);
        let frame = Rect { x: 0.0, y: 0.0, w: WIDTH, h: HEIGHT };
        Ok(Scale { frame, x: x.with_span(x.span().max(1.0)), y: y.with_span(y.span().max(1.0)) })
    }

    /// log10 of frequency and power; `None` where one of them is not above 0.
    fn points(&self, curve: &SpectrumCurve) -> impl Iterator<Item = Option<Point>> {
        let pairs = self.frequencies.iter().zip(&curve.power);
        pairs.map(|(f, p)| (*f > 0.0 && *p > 0.0).then(|| [libm::log10(*f), libm::log10(*p)]))
    }

    fn draw_curve(&self, svg: &mut Svg, curve: &SpectrumCurve, scale: &Scale) {
        let points: Vec<_> = self.points(curve).map(|p| p.map(|p| scale.map(p))).collect();
        for piece in points.split(Option::is_none) {
            let piece: Vec<Point> = piece.iter().copied().flatten().collect();
            match piece[..] {
                [] => {}
                [one] => svg.circle(one, 2.0, &Paint::fill(curve.colour)),
                _ => svg.polyline(&simplify(&envelope(&piece, 0.5), 0.15), false, &paint(curve)),
            }
        }
    }

    fn check(&self) -> Result<()> {
        check_finite("frequency", self.frequencies.iter().copied())?;
        if let Some(i) = self.frequencies.windows(2).position(|w| w[1] < w[0]) {
            return Err(FigureError::Unsorted { what: "frequency", index: i + 1 });
        }
        for curve in &self.curves {
            let (expected, got) = (self.frequencies.len(), curve.power.len());
            if expected != got {
                return Err(FigureError::Powers { curve: curve.label.clone(), expected, got });
            }
            check_finite("spectral power", curve.power.iter().copied())?;
        }
        Ok(())
    }

    /// A row per frequency, a column per curve.
    fn csv(&self) -> String {
        let names = self.curves.iter().map(|curve| curve.label.clone());
        let mut csv = Csv::new([self.x_label.clone()].into_iter().chain(names));
        for (row, frequency) in self.frequencies.iter().enumerate() {
            let powers = self.curves.iter().map(|curve| Some(curve.power[row]));
            csv.row(&[], [Some(*frequency)].into_iter().chain(powers));
        }
        csv.finish()
    }
}

figure!(SpectrumFigure);

fn paint(curve: &SpectrumCurve) -> Paint {
    Paint::stroke(curve.colour, 1.4)
}
