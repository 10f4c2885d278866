//! Layers of a chart: marks with their data.

use super::axes::AxisKind;
use super::bands::BandCurve;
use super::branches::BranchDiagram;
use super::error::Result;
use super::error_bars::ErrorBarSeries;
use super::expected::ExpectedLine;
use super::figure::Csv;
use super::geometry::Point;
use super::interval::Interval;
use super::legend::Entry;
use super::plane::Plane;
use super::return_map::Returns;
use super::spectrum::Spectra;
use super::survival::SurvivalCurve;
use super::svg::Svg;

/// The requests of a chart to its layers.
pub(super) trait Marks {
    /// Rejects data that cannot be drawn.
    fn check(&self) -> Result<()>;

    /// The places along the axes, across and upwards, that must be in sight.
    fn extent(&self, _: [AxisKind; 2]) -> [Vec<f64>; 2] {
        Default::default()
    }

    /// Width and height of the frame of a chart that begins with this layer, in pixels.
    fn frame(&self) -> [f64; 2] {
        [540.0, 300.0]
    }

    /// Room between these places and the frame, as shares of the axes.
    fn room(&self) -> [f64; 2] {
        [0.0; 2]
    }

    /// Its place in legend and table: measured layers, each with the next colour and marker; their intervals; lines of theory.
    fn rank(&self) -> Rank {
        Rank::Measured
    }

    /// The number of values that are left out since they have no place on the axes.
    fn left_out(&self, _: [AxisKind; 2]) -> usize {
        0
    }

    /// The entries of the legend; `number` counts the measured layers from 0.
    fn keys(&self, number: usize) -> Vec<Entry>;

    /// Draws what lies beneath all layers.
    fn draw_ground(&self, _: &mut Svg, _: &Plane, _: usize) {}

    /// Draws the marks.
    fn draw(&self, svg: &mut Svg, plane: &Plane, number: usize);

    /// The names of the columns before and after those of the axes.
    fn columns(&self) -> [&'static [&'static str]; 2] {
        [&[]; 2]
    }

    /// A row per mark.
    fn rows(&self) -> Vec<Row> {
        Vec::new()
    }

    /// The whole table of a chart that begins with this layer, where it is another one than a row per mark.
    fn table(&self, _: [&str; 2]) -> Option<Csv> {
        None
    }
}

/// A row of the table of a chart: texts of the columns before those of the axes, place, numbers of the columns after.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Row {
    pub(super) texts: Vec<String>,
    pub(super) at: [Option<f64>; 2],
    pub(super) numbers: Vec<f64>,
}

impl Row {
    /// A mark with a name.
    pub(super) fn named(name: &str, at: Point, numbers: &[f64]) -> Self {
        Self { texts: vec![name.to_owned()], at: at.map(Some), numbers: numbers.to_vec() }
    }
}

/// The order of layers in legend and table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Rank {
    Measured,
    Interval,
    Theory,
}

/// A layer of a [`super::Chart`].
#[derive(Debug, Clone, PartialEq)]
pub enum Layer {
    /// A curve with its band.
    Band(BandCurve),
    /// Steps with their band.
    Steps(SurvivalCurve),
    /// Points with error bars.
    Points(ErrorBarSeries),
    /// Bars whose ends are given.
    Intervals(Vec<Interval>),
    /// A line from theory.
    Line(ExpectedLine),
    /// Power spectra over common frequencies.
    Spectra(Spectra),
    /// Each value of a sequence against the one before it.
    Returns(Returns),
    /// Branches with their special points.
    Branches(BranchDiagram),
}

impl Layer {
    pub(super) fn marks(&self) -> &dyn Marks {
        match self {
            Self::Band(curve) => curve,
            Self::Steps(curve) => curve,
            Self::Points(series) => series,
            Self::Intervals(bars) => bars,
            Self::Line(line) => line,
            Self::Spectra(spectra) => spectra,
            Self::Returns(returns) => returns,
            Self::Branches(branches) => branches,
        }
    }
}

macro_rules! layers {
    ($($data:ty => $layer:ident),* $(,)?) => {
        $(impl From<$data> for Layer {
            fn from(data: $data) -> Self {
                Self::$layer(data)
            }
        })*
    };
}

layers! {
    BandCurve => Band,
    SurvivalCurve => Steps,
    ErrorBarSeries => Points,
    Vec<Interval> => Intervals,
    ExpectedLine => Line,
    Spectra => Spectra,
    Returns => Returns,
    BranchDiagram => Branches,
}
