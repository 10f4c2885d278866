//! Power spectral density against frequency.

use super::axes::AxisKind;
use super::chart::Chart;
use super::error::{FigureError, Result, check_finite};
use super::figure::Csv;
use super::geometry::Point;
use super::layer::Marks;
use super::legend::{Entry, Mark};
use super::paint::Paint;
use super::palette::Colour;
use super::plane::Plane;
use super::simplify::{envelope, simplify};
use super::svg::Svg;

/// Most decades of power in sight: what lies lower is the round-off of what was recorded.
const DECADES: f64 = 12.0;

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

/// Power spectra. On logarithmic axes the frequency 0 and powers that are not positive have no place and leave a gap.
#[derive(Debug, Clone, PartialEq)]
pub struct Spectra {
    /// Frequencies, from 0 or above, not decreasing.
    pub frequencies: Vec<f64>,
    /// Curves, drawn in this order.
    pub curves: Vec<SpectrumCurve>,
}

impl Chart {
    /// Power spectra on logarithmic axes.
    pub fn spectra(frequencies: Vec<f64>, curves: Vec<SpectrumCurve>) -> Self {
        let (x_label, y_label) = ("frequency".to_owned(), "power spectral density".to_owned());
        Self { x_label, y_label, logarithmic_x: true, logarithmic_y: true, ..Self::default() }
            .with([Spectra { frequencies, curves }])
    }
}

impl Spectra {
    fn points(&self, curve: &SpectrumCurve) -> impl Iterator<Item = Point> {
        self.frequencies.iter().zip(&curve.power).map(|(f, p)| [*f, *p])
    }
}

impl Marks for Spectra {
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

    fn extent(&self, [x, y]: [AxisKind; 2]) -> [Vec<f64>; 2] {
        let points = self.curves.iter().flat_map(|curve| self.points(curve));
        let places = points.filter_map(|[f, p]| Some((x.place(f)?, y.place(p)?)));
        let (xs, mut ys): (Vec<f64>, Vec<f64>) = places.unzip();
        if y == AxisKind::Logarithmic {
            let highest = ys.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            ys.iter_mut().for_each(|y| *y = y.max(highest - DECADES));
        }
        [xs, ys]
    }

    fn frame(&self) -> [f64; 2] {
        [560.0, 300.0]
    }

    fn room(&self) -> [f64; 2] {
        [0.0, 0.05]
    }

    fn keys(&self, _: usize) -> Vec<Entry> {
        let several = self.curves.len() > 1;
        let key = |curve: &SpectrumCurve| Entry::new(Mark::Line(paint(curve)), &curve.label);
        self.curves.iter().filter(|_| several).map(key).collect()
    }

    fn draw(&self, svg: &mut Svg, plane: &Plane, _: usize) {
        svg.clipped(plane.scale.frame, |svg| {
            for curve in &self.curves {
                let points: Vec<_> = self.points(curve).map(|point| plane.at(point)).collect();
                points.split(Option::is_none).for_each(|piece| draw_piece(svg, piece, curve));
            }
        });
    }

    /// A row per frequency, a column per curve.
    fn table(&self, [x, _]: [&str; 2]) -> Option<Csv> {
        let mut csv = Csv::new([x].into_iter().chain(self.curves.iter().map(|curve| curve.label.as_str())));
        for (row, frequency) in self.frequencies.iter().enumerate() {
            let powers = self.curves.iter().map(|curve| Some(curve.power[row]));
            csv.row(&[], [Some(*frequency)].into_iter().chain(powers));
        }
        Some(csv)
    }
}

/// A single value between gaps is a dot.
fn draw_piece(svg: &mut Svg, piece: &[Option<Point>], curve: &SpectrumCurve) {
    let piece: Vec<Point> = piece.iter().copied().flatten().collect();
    match piece[..] {
        [] => {}
        [one] => svg.circle(one, 2.0, &Paint::fill(curve.colour)),
        _ => svg.polyline(&simplify(&envelope(&piece, 0.5), 0.15), false, &paint(curve)),
    }
}

fn paint(curve: &SpectrumCurve) -> Paint {
    Paint::stroke(curve.colour, 1.4)
}
