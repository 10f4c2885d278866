//! Bars whose ends are given.

use super::axes::AxisKind;
use super::error::{FigureError, Result, check_finite};
use super::error_bars::{COLUMNS, ROOM};
use super::layer::{Marks, Rank, Row};
use super::legend::Entry;
use super::paint::Paint;
use super::palette::INK;
use super::plane::Plane;
use super::svg::Svg;

/// Half the length of a cap, in pixels.
const CAP: f64 = 3.6;

/// An interval without a marker: the error of a value that is not symmetric.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// The abscissa.
    pub x: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end; infinite for none, and the bar then leaves the frame without a cap.
    pub high: f64,
}

/// In the colour of axes; what reaches beyond the frame ends there without a cap.
impl Marks for Vec<Interval> {
    fn check(&self) -> Result<()> {
        check_finite("end of an interval (x, low in turn)", self.iter().flat_map(|bar| [bar.x, bar.low]))?;
        match self.iter().position(|bar| bar.high.is_nan()) {
            Some(index) => {
                Err(FigureError::NotFinite { what: "upper end of an interval", index, value: f64::NAN })
            }
            None => Ok(()),
        }
    }

    fn extent(&self, [x, y]: [AxisKind; 2]) -> [Vec<f64>; 2] {
        let ends = self.iter().flat_map(|bar| [bar.low, bar.high]).filter(|end| end.is_finite());
        [
            self.iter().filter_map(|bar| x.place(bar.x)).collect(),
            ends.filter_map(|end| y.place(end)).collect(),
        ]
    }

    fn room(&self) -> [f64; 2] {
        ROOM
    }

    fn rank(&self) -> Rank {
        Rank::Interval
    }

    fn keys(&self, _: usize) -> Vec<Entry> {
        Vec::new()
    }

    fn draw(&self, svg: &mut Svg, plane: &Plane, _: usize) {
        let ([x, y], scale) = (plane.kinds, plane.scale);
        let mut lines = Vec::new();
        for bar in self {
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

    fn columns(&self) -> [&'static [&'static str]; 2] {
        [COLUMNS[0], &[]]
    }

    fn rows(&self) -> Vec<Row> {
        let row = |x: f64, (name, end): (&str, f64)| {
            let at = [Some(x), Some(end).filter(|end| end.is_finite())];
            Row { texts: vec![name.to_owned()], at, numbers: Vec::new() }
        };
        let ends = |bar: &Interval| [("lower end", bar.low), ("upper end", bar.high)];
        self.iter().flat_map(|bar| ends(bar).map(|end| row(bar.x, end))).collect()
    }
}
