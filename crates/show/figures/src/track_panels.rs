//! Paths with outlines side by side at one scale: an observed body and its simulations.

use super::block::Block;
use super::error::{FigureError, Result, check_finite};
use super::figure::{Csv, figure};
use super::geometry::{Point, Range, Rect};
use super::paint::Paint;
use super::palette::{BLACK, GREY, INK, WHITE, time_colour_in};
use super::room::Room;
use super::simplify::simplify;
use super::svg::{Anchor, Svg};
use super::text::Label;

const MARGIN: f64 = 14.0;
/// Tallest panel, and width of all of them, in pixels.
const SIDE: f64 = 300.0;
const WIDTH: f64 = 920.0;
const GAP: f64 = 14.0;
/// Narrowest panel; it is also as wide as its name.
const LEAST: f64 = 60.0;
/// Height of a panel's name.
const HEAD: f64 = 20.0;
const WORDS: f64 = 12.5;
/// Height of the row of the scale bar.
const FOOT: f64 = 34.0;

/// A body: its path and outlines along it.
#[derive(Debug, Clone, PartialEq)]
pub struct TrackPanel {
    /// Its name (markup).
    pub name: String,
    /// Pieces of the path; pieces are not joined.
    pub path: Vec<Vec<Point>>,
    /// Outlines in order of time, coloured from first (dark) to last (bright); closed by the drawing.
    pub outlines: Vec<Vec<Point>>,
}

/// Tracks side by side at one scale, each in the middle of its panel; a scale bar instead of axes, as no place is special.
///
/// # Units   those of the scale bar; texts are markup (see [`super::Label`])
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TrackPanels {
    /// Line above the panels.
    pub title: String,
    /// Paragraphs below.
    pub caption: Vec<String>,
    /// Unit of length beside the scale bar (markup).
    pub unit: String,
    /// Most panels in a row; fewer where they are wide, or the sheet is narrow.
    pub columns: usize,
    /// The panels, from left to right and row by row.
    pub panels: Vec<TrackPanel>,
}

impl TrackPanels {
    /// Draws the figure for a width.
    ///
    /// # Errors   no panel, a panel without a point, a number that is not finite
    pub fn svg_in(&self, room: Room) -> Result<Svg> {
        check_finite("coordinate of a track", self.panels.iter().flat_map(TrackPanel::points).flatten())?;
        let boxes: Option<Vec<[Range; 2]>> = self.panels.iter().map(TrackPanel::ranges).collect();
        let boxes = boxes.filter(|boxes| !boxes.is_empty()).ok_or(FigureError::Empty { what: "track" })?;
        let widest = |side: usize| boxes.iter().map(|ranges| ranges[side].span()).fold(0.0, f64::max);
        let size = [widest(0), widest(1)].map(|span| span.max(1e-100));
        let all = room.width().map_or(WIDTH, |width| width - 2.0 * MARGIN);
        let columns = self.columns(size, all);
        let wide = ((all + GAP) / columns as f64 - GAP).min((size[0] / size[1]).max(1.0) * SIDE);
        let pixels = (wide / size[0]).min(SIDE / size[1]) / 1.12;
        let (w, h) = (wide, (1.12 * size[1] * pixels).max(40.0));
        let rows = self.panels.len().div_ceil(columns);
        let inner = columns as f64 * (w + GAP) - GAP;
        let (title, caption) = (Block::title(&self.title, inner), Block::caption(&self.caption, inner));
        let top = MARGIN + title.height();
        let foot = top + rows as f64 * (HEAD + h + GAP);
        let height = foot + FOOT + caption.height() + MARGIN;
        let mut svg = Svg::in_room(room, (inner + 2.0 * MARGIN).ceil(), height.ceil());
        title.draw(&mut svg, [MARGIN, MARGIN]);
        for (number, (panel, ranges)) in self.panels.iter().zip(&boxes).enumerate() {
            let (row, column) = (number / columns, number % columns);
            let x = MARGIN + column as f64 * (w + GAP);
            let y = top + row as f64 * (HEAD + h + GAP);
            svg.text([x, y + 14.0], WORDS, Anchor::Start, &Label::parse(&panel.name));
            let frame = Rect { x, y: y + HEAD, w, h };
            svg.frame(frame);
            panel.draw(&mut svg, frame, ranges, pixels);
        }
        self.draw_bar(&mut svg, [MARGIN, foot + 10.0], pixels, w);
        caption.draw(&mut svg, [MARGIN, foot + FOOT]);
        Ok(svg)
    }

    /// Panels beside one another: half as many where they are wide, one where they are very wide; and no more than there is room for
    /// between the margins. Rows are as full as possible.
    fn columns(&self, [w, h]: [f64; 2], all: f64) -> usize {
        let shape = if w > 2.5 * h {
            4
        } else if w > 1.2 * h {
            2
        } else {
            1
        };
        let most = self.panels.len().clamp(1, (self.columns / shape).max(1));
        let name = self.panels.iter().map(|panel| Label::parse(&panel.name).width(WORDS));
        let least = name.fold(LEAST, f64::max);
        let columns = most.min((((all + GAP) / (least + GAP)) as usize).max(1));
        self.panels.len().div_ceil(self.panels.len().div_ceil(columns))
    }

    /// A bar of a round length, at most half of a panel, and the colours of time.
    fn draw_bar(&self, svg: &mut Svg, [x, y]: Point, pixels: f64, panel: f64) {
        let length = round_below(0.4 * panel / pixels);
        let bar = [[x, y + 6.0], [x + length * pixels, y + 6.0]];
        svg.line(bar[0], bar[1], &Paint::stroke(INK, 3.0));
        let words = format!("{length} {}", self.unit);
        svg.text([bar[1][0] + 8.0, y + 10.0], WORDS, Anchor::Start, &Label::parse(&words));
    }

    /// A row per point.
    fn csv(&self) -> String {
        let mut csv = Csv::new(["track", "part", "number", "x", "y"]);
        for panel in &self.panels {
            for (part, lines) in [("path", &panel.path), ("outline", &panel.outlines)] {
                for (number, line) in lines.iter().enumerate() {
                    line.iter()
                        .for_each(|at| csv.row(&[&panel.name, part, &number.to_string()], at.map(Some)));
                }
            }
        }
        csv.finish()
    }
}

figure!(TrackPanels);

/// The largest of 1, 2 and 5 times a power of ten that is not above a length.
fn round_below(length: f64) -> f64 {
    let power = libm::pow(10.0, libm::log10(length).floor());
    [5.0, 2.0].into_iter().map(|digit| digit * power).find(|round| *round <= length).unwrap_or(power)
}

impl TrackPanel {
    fn points(&self) -> impl Iterator<Item = Point> + '_ {
        self.path.iter().chain(&self.outlines).flatten().copied()
    }

    fn ranges(&self) -> Option<[Range; 2]> {
        let range = |side: usize| Range::of(self.points().map(|p| p[side]));
        Some([range(0)?, range(1)?])
    }

    fn draw(&self, svg: &mut Svg, frame: Rect, ranges: &[Range; 2], pixels: f64) {
        let middle = [frame.x + 0.5 * frame.w, frame.y + 0.5 * frame.h];
        let map = |p: &Point| {
            [
                middle[0] + (p[0] - ranges[0].middle()) * pixels,
                middle[1] - (p[1] - ranges[1].middle()) * pixels,
            ]
        };
        let whole = Range { min: 0.0, max: (self.outlines.len().max(2) - 1) as f64 };
        for (number, outline) in self.outlines.iter().enumerate() {
            let colour = time_colour_in(number as f64, whole);
            let points: Vec<Point> = outline.iter().map(map).collect();
            let paint = Paint::stroke(colour.mix(BLACK, 0.25), 1.0).tint(colour, 0.18);
            svg.polyline(&simplify(&points, 0.04), true, &paint);
        }
        for piece in &self.path {
            let points: Vec<Point> = piece.iter().map(map).collect();
            svg.polyline(&simplify(&points, 0.1), false, &Paint::stroke(INK, 0.9));
        }
        let start = self.path.iter().flatten().next();
        start.into_iter().for_each(|at| svg.circle(map(at), 3.0, &Paint::fill(WHITE).edge(INK, 1.2)));
        svg.rect(frame, &Paint::stroke(GREY, 0.8));
    }
}
