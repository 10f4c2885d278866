//! A chart in other units: all numbers of all layers multiplied along the axes.

use super::chart::Chart;
use super::geometry::Point;
use super::layer::Layer;

impl Chart {
    /// The chart with the data along each axis multiplied by a factor: for units other than those of the data.
    #[must_use]
    pub fn scaled(mut self, by: [f64; 2]) -> Self {
        self.layers.iter_mut().for_each(|layer| layer.scale(by));
        self
    }
}

impl Layer {
    fn scale(&mut self, [x, y]: [f64; 2]) {
        let scale = |point: &mut Point| *point = [x * point[0], y * point[1]];
        match self {
            Self::Band(curve) => curve.points.iter_mut().for_each(|p| {
                (p.x, p.y, p.low, p.high) = (x * p.x, y * p.y, y * p.low, y * p.high);
            }),
            Self::Steps(curve) => {
                curve.steps.iter_mut().for_each(|step| {
                    (step.t, step.share) = (x * step.t, y * step.share);
                    (step.low, step.high) = (y * step.low, y * step.high);
                });
                curve.end *= x;
            }
            Self::Points(series) => series.points.iter_mut().for_each(|p| {
                (p.x, p.y, p.error) = (x * p.x, y * p.y, y * p.error);
            }),
            Self::Intervals(bars) => bars.iter_mut().for_each(|bar| {
                (bar.x, bar.low, bar.high) = (x * bar.x, y * bar.low, y * bar.high);
            }),
            Self::Line(line) => line.points.iter_mut().for_each(scale),
            Self::Spectra(spectra) => {
                spectra.frequencies.iter_mut().for_each(|frequency| *frequency *= x);
                spectra.curves.iter_mut().flat_map(|curve| &mut curve.power).for_each(|power| *power *= y);
            }
            Self::Returns(returns) => returns.points.iter_mut().for_each(scale),
            Self::Branches(diagram) => {
                diagram.x = diagram.x.map(|end| x * end);
                diagram.parts.iter_mut().flat_map(|part| &mut part.points).for_each(scale);
                diagram.dots.iter_mut().flat_map(|dots| &mut dots.points).for_each(scale);
                diagram.marks.iter_mut().map(|mark| &mut mark.at).for_each(scale);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{
        BandCurve, BandPoint, BranchDiagram, Chart, ErrorBarSeries, ExpectedLine, LineStyle, Measured,
    };

    /// A chart in other units is that of data in these units.
    #[test]
    fn data_and_chart_are_scaled_alike() {
        let chart = |[a, b]: [f64; 2]| {
            let point = |x: f64| BandPoint { x: a * x, y: b * x * x, low: b * x, high: b * (x * x + 1.0) };
            let measured = |x: f64| Measured { x: a * x, y: b * x, error: b * 0.5 };
            let line = vec![[0.0, b], [a, 2.0 * b]];
            Chart::default()
                .with([BandCurve {
                    label: "band".into(),
                    points: (1..9).map(|k| point(f64::from(k))).collect(),
                }])
                .with([ErrorBarSeries {
                    label: "points".into(),
                    points: vec![measured(1.0), measured(3.0)],
                    joined: false,
                }])
                .with([ExpectedLine { label: "line".into(), style: LineStyle::Dotted, points: line }])
                .with([BranchDiagram { x: [0.0, 4.0 * a], ..BranchDiagram::default() }])
        };
        assert_eq!(chart([1.0; 2]).scaled([2.0, 0.25]), chart([2.0, 0.25]));
    }
}
