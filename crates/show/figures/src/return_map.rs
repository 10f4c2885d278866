//! A return map: each value of a sequence against the one before it.

use std::collections::HashSet;

use super::axes::AxisKind;
use super::chart::Chart;
use super::error::{Result, check_finite};
use super::geometry::Point;
use super::layer::{Marks, Row};
use super::legend::{Entry, Mark};
use super::paint::Paint;
use super::palette::{BLUE, GREY};
use super::plane::Plane;
use super::svg::Svg;

/// Pairs (x_n, x_(n+1)) with the diagonal, on equal axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Returns {
    /// Names of x_n and x_(n+1) (markup).
    pub names: [String; 2],
    /// The pairs.
    pub points: Vec<Point>,
}

impl Chart {
    /// A return map; the names of x_n and x_(n+1) are also those of the axes.
    pub fn return_map(names: [String; 2], points: Vec<Point>) -> Self {
        let [x_label, y_label] = names.clone();
        Self { x_label, y_label, ..Self::default() }.with([Returns { names, points }])
    }
}

impl Marks for Returns {
    fn check(&self) -> Result<()> {
        check_finite("return map value", self.points.iter().flatten().copied())
    }

    fn extent(&self, kinds: [AxisKind; 2]) -> [Vec<f64>; 2] {
        kinds.map(|kind| self.points.iter().flatten().filter_map(|value| kind.place(*value)).collect())
    }

    fn frame(&self) -> [f64; 2] {
        [420.0; 2]
    }

    fn room(&self) -> [f64; 2] {
        [0.05; 2]
    }

    fn keys(&self, _: usize) -> Vec<Entry> {
        let (radius, paint) = (self.dot().0, Paint::fill(BLUE));
        let [x, y] = &self.names;
        let pair = format!("({x}, {y}): {} points", self.points.len());
        vec![
            Entry::new(Mark::Dot(paint, radius.max(1.6)), &pair),
            Entry::new(Mark::Line(diagonal_paint()), &format!("{y} = {x}")),
        ]
    }

    fn draw(&self, svg: &mut Svg, plane: &Plane, _: usize) {
        svg.clipped(plane.scale.frame, |svg| self.draw_data(svg, plane));
    }

    fn rows(&self) -> Vec<Row> {
        let row = |point: &Point| Row { texts: Vec::new(), at: point.map(Some), numbers: Vec::new() };
        self.points.iter().map(row).collect()
    }
}

impl Returns {
    /// Radius in pixels and paint of a point: smaller and lighter where there are many.
    fn dot(&self) -> (f64, Paint) {
        match self.points.len() {
            0..=300 => (2.6, Paint::fill(BLUE).opacity(0.8)),
            301..=3000 => (1.7, Paint::fill(BLUE).opacity(0.7)),
            _ => (0.9, Paint::fill(BLUE).opacity(0.6)),
        }
    }

    fn draw_data(&self, svg: &mut Svg, plane: &Plane) {
        let [from, to] = [plane.scale.x.min, plane.scale.x.max].map(|v| plane.scale.map([v, v]));
        svg.line(from, to, &diagonal_paint());
        let (radius, paint) = self.dot();
        let mut drawn = HashSet::new(); // one dot per half pixel keeps the file small
        for [x, y] in self.points.iter().filter_map(|point| plane.at(*point)) {
            if drawn.insert(((2.0 * x) as i64, (2.0 * y) as i64)) {
                svg.circle([x, y], radius, &paint);
            }
        }
    }
}

fn diagonal_paint() -> Paint {
    Paint::stroke(GREY, 1.2).dashed("6 4")
}
