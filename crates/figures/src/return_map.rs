//! A return map: each value of a sequence against the one before it.

use std::collections::HashSet;

use super::axes::{AxisKind, Scale};
use super::error::{FigureError, Result, check_finite};
use super::figure::{Csv, figure};
use super::framed::Framed;
use super::geometry::{Point, Range, Rect};
use super::legend::{Entry, Mark};
use super::paint::Paint;
use super::palette::{BLUE, GREY};
use super::room::Room;
use super::svg::Svg;

const SIDE: f64 = 420.0;

/// Scatter of x_(n+1) against x_n with the diagonal, on equal axes.
///
/// # Units   those of the values; texts are markup (see [`super::Label`])
#[derive(Debug, Clone, PartialEq)]
pub struct ReturnMapFigure {
    /// Line above the axes.
    pub title: String,
    /// Paragraphs below the axes.
    pub caption: Vec<String>,
    /// Label of the x axis.
    pub x_label: String,
    /// Label of the y axis.
    pub y_label: String,
    /// Pairs (x_n, x_(n+1)).
    pub points: Vec<Point>,
}

impl Default for ReturnMapFigure {
    fn default() -> Self {
        Self {
            title: String::new(),
            caption: Vec::new(),
            x_label: "*x*_*n*".to_owned(),
            y_label: "*x*_{*n*+1}".to_owned(),
            points: Vec::new(),
        }
    }
}

impl ReturnMapFigure {
    /// Draws the figure for a width.
    ///
    /// # Errors   there is no point, or a number is not finite
    pub fn svg_in(&self, room: Room) -> Result<Svg> {
        check_finite("return map value", self.points.iter().flatten().copied())?;
        let range = Range::of(self.points.iter().flatten().copied());
        let range = range.ok_or(FigureError::Empty { what: "return map" })?.padded(0.05);
        let frame = Rect { x: 0.0, y: 0.0, w: SIDE, h: SIDE };
        let sheet = Framed {
            title: &self.title,
            caption: &self.caption,
            legend: self.legend(),
            scale: Scale { frame, x: range, y: range },
            kinds: [AxisKind::Linear; 2],
            labels: [&self.x_label, &self.y_label],
            room,
            grid: true,
            head: 0.0,
        };
        sheet.svg(|svg, scale| {
            svg.clipped(scale.frame, |svg| self.draw_data(svg, scale));
            Ok(())
        })
    }

    fn legend(&self) -> Vec<Entry> {
        let (radius, paint) = (self.dot().0, Paint::fill(BLUE));
        let pair = format!("({}, {}): {} points", self.x_label, self.y_label, self.points.len());
        let diagonal = format!("{} = {}", self.y_label, self.x_label);
        vec![
            Entry::new(Mark::Dot(paint, radius.max(1.6)), &pair),
            Entry::new(Mark::Line(diagonal_paint()), &diagonal),
        ]
    }

    /// Radius in pixels and paint of a point: smaller and lighter where there are many.
    fn dot(&self) -> (f64, Paint) {
        match self.points.len() {
            0..=300 => (2.6, Paint::fill(BLUE).opacity(0.8)),
            301..=3000 => (1.7, Paint::fill(BLUE).opacity(0.7)),
            _ => (0.9, Paint::fill(BLUE).opacity(0.6)),
        }
    }

    fn draw_data(&self, svg: &mut Svg, scale: &Scale) {
        let corner = |v| scale.map([v, v]);
        svg.line(corner(scale.x.min), corner(scale.x.max), &diagonal_paint());
        let (radius, paint) = self.dot();
        let mut drawn = HashSet::new(); // one dot per half pixel keeps the file small
        for point in &self.points {
            let [x, y] = scale.map(*point);
            if drawn.insert(((2.0 * x) as i64, (2.0 * y) as i64)) {
                svg.circle([x, y], radius, &paint);
            }
        }
    }

    fn csv(&self) -> String {
        let mut csv = Csv::new([&self.x_label, &self.y_label]);
        self.points.iter().for_each(|point| csv.row(&[], point.map(Some)));
        csv.finish()
    }
}

figure!(ReturnMapFigure);

fn diagonal_paint() -> Paint {
    Paint::stroke(GREY, 1.2).dashed("6 4")
}
