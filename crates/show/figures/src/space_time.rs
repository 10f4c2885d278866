//! A signed field over time and place as a heat map.

use super::axes::{Axes, BELOW, Scale};
use super::block::Block;
use super::colour_bar::ColourBar;
use super::error::{FigureError, Result, check_finite};
use super::figure::{Csv, figure};
use super::geometry::{Range, Rect};
use super::heat_map::{Cells, Grid};
use super::palette::{Colour, signed_colour};
use super::room::Room;
use super::svg::Svg;

const WIDTH: f64 = 600.0;
const HEIGHT: f64 = 200.0;
const MARGIN: f64 = 14.0;
/// Between frame and colour bar, in pixels.
const GAP: f64 = 18.0;
/// Most cells of the picture, across and upwards: one per pixel of the frame.
const CELLS: (usize, usize) = (WIDTH as usize, HEIGHT as usize);

/// A field such as phi(s, t) in colours: blue below 0, orange above, the colour limits equal on both sides of 0.
///
/// The field is averaged over boxes to one cell per pixel at most (600 x 200); the limits are those of what is drawn.
/// The picture lies in the SVG as a PNG of about 0.1 MB.
///
/// # Shapes  `values` has `rows` x `columns` numbers, place by place (all times of the first place, then the next)
/// # Units   those of the values; texts are markup (see [`super::Label`])
/// # Not     a travelling wave faster than a pixel: averaging makes it fade, so cut the time range
#[derive(Debug, Clone, PartialEq)]
pub struct SpaceTimeFigure {
    /// Line above the axes.
    pub title: String,
    /// Paragraphs below the axes.
    pub caption: Vec<String>,
    /// Label of the time axis.
    pub x_label: String,
    /// Label of the axis of places.
    pub y_label: String,
    /// Label of the colours.
    pub value_label: String,
    /// First and last time.
    pub times: (f64, f64),
    /// First and last place.
    pub places: (f64, f64),
    /// Number of times.
    pub columns: usize,
    /// Number of places.
    pub rows: usize,
    /// The field; the value of place `row` at time `column` is number `row * columns + column`.
    pub values: Vec<f64>,
}

impl Default for SpaceTimeFigure {
    fn default() -> Self {
        Self {
            title: String::new(),
            caption: Vec::new(),
            x_label: "*t*".to_owned(),
            y_label: "*s*".to_owned(),
            value_label: "*φ*".to_owned(),
            times: (0.0, 1.0),
            places: (0.0, 1.0),
            columns: 0,
            rows: 0,
            values: Vec::new(),
        }
    }
}

impl SpaceTimeFigure {
    /// Draws the figure for a width.
    ///
    /// # Errors   no value, a number that is not finite, a range that runs backwards, or not `columns` x `rows` values
    pub fn svg_in(&self, room: Room) -> Result<Svg> {
        self.check()?;
        let cells = self.cells();
        let limit = cells.largest();
        let limit = if limit > 0.0 { limit } else { 1.0 };
        let range = Range { min: -limit, max: limit };
        let bar = |height| ColourBar::new(range, bar_colour, &self.value_label, height);
        let beside = self.axes([WIDTH, HEIGHT]).left_margin() + GAP + bar(HEIGHT).width() + 2.0 * MARGIN;
        let [w, h] = room.frame([WIDTH, HEIGHT], beside);
        let (axes, bar) = (self.axes([w, h]), bar(h));
        let left = MARGIN + axes.left_margin();
        let inner = left - MARGIN + w + GAP + bar.width();
        let (title, caption) = (Block::title(&self.title, inner), Block::caption(&self.caption, inner));
        let mut axes = axes.moved_to(left);
        axes.scale.frame.y = MARGIN + title.height() + 4.0;
        let (frame, foot) = (axes.scale.frame, axes.scale.frame.bottom() + BELOW + 8.0);
        let height = foot + caption.height() + MARGIN - 6.0;
        let mut svg = Svg::in_room(room, (inner + 2.0 * MARGIN).ceil(), height.ceil());
        svg.frame(frame);
        title.draw(&mut svg, [MARGIN, MARGIN]);
        svg.image(frame, &cells.png(limit)?);
        axes.draw(&mut svg);
        bar.draw(&mut svg, [frame.right() + GAP, frame.y]);
        caption.draw(&mut svg, [MARGIN, foot]);
        Ok(svg)
    }

    fn axes(&self, [w, h]: [f64; 2]) -> Axes {
        let frame = Rect { x: 0.0, y: 0.0, w, h };
        let scale = Scale { frame, x: axis(self.times), y: axis(self.places) };
        Axes::new(scale, Some(&self.x_label), &self.y_label)
    }

    fn check(&self) -> Result<()> {
        let (columns, rows, got) = (self.columns, self.rows, self.values.len());
        if columns == 0 || rows == 0 || got == 0 {
            return Err(FigureError::Empty { what: "space-time field" });
        }
        if columns.checked_mul(rows) != Some(got) {
            return Err(FigureError::Cells { columns, rows, got });
        }
        for (what, (first, last)) in [("time range", self.times), ("range of places", self.places)] {
            check_finite(what, [first, last])?;
            if last < first {
                return Err(FigureError::Unsorted { what, index: 1 });
            }
        }
        check_finite("space-time value", self.values.iter().copied())
    }

    /// A row per column of boxes of the picture: the time of its middle, then the means at each place, from the first to the last.
    fn csv(&self) -> String {
        let cells = self.cells();
        let (columns, rows) = cells.size();
        let middle = |(from, to): (f64, f64), i: usize, count: usize| {
            from + (to - from) * (i as f64 + 0.5) / count as f64
        };
        let places = (0..rows).map(|row| format!("{:?}", middle(self.places, row, rows)));
        let mut csv = Csv::new([self.x_label.clone()].into_iter().chain(places));
        for column in 0..columns {
            let values = (0..rows).map(|row| Some(cells.value(column, row)));
            csv.row(&[], [Some(middle(self.times, column, columns))].into_iter().chain(values));
        }
        csv.finish()
    }

    /// The field, one mean per pixel at most.
    fn cells(&self) -> Cells {
        Grid { columns: self.columns, rows: self.rows, values: &self.values }.averaged(CELLS)
    }
}

figure!(SpaceTimeFigure);

/// The range of an axis, widened if it is a single number.
fn axis((min, max): (f64, f64)) -> Range {
    let range = Range { min, max };
    if range.span() > 0.0 { range } else { range.padded(0.0) }
}

fn bar_colour(fraction: f64) -> Colour {
    signed_colour(2.0 * fraction - 1.0)
}
