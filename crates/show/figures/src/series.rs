//! Quantities against time: panels above one another that share the time axis.

use super::axes::{Axes, BELOW, Scale};
use super::block::Block;
use super::error::{FigureError, Result, check_finite};
use super::figure::{Csv, figure};
use super::geometry::{Point, Range, Rect};
use super::legend::{Entry, Legend, Mark};
use super::paint::Paint;
use super::palette::{Colour, PALE};
use super::room::Room;
use super::simplify::simplify;
use super::svg::Svg;

const WIDTH: f64 = 600.0;
const HEIGHT: f64 = 120.0;
const GAP: f64 = 16.0;
const MARGIN: f64 = 14.0;

/// A curve of a panel.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Markup for the legend, which appears where a panel has several curves.
    pub label: String,
    /// Colour; see [`super::palette::CATEGORIES`].
    pub colour: Colour,
    /// One value per time; `None` where it is undefined.
    pub values: Vec<Option<f64>>,
}

/// A panel with its own y axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// Label of the y axis.
    pub label: String,
    /// Curves, drawn in this order.
    pub curves: Vec<Curve>,
    /// Least difference of values that is known: values that differ by less are drawn as a constant. 0: every difference.
    pub least: f64,
}

/// Time series in stacked panels. Where all curves of a panel are undefined, its ground is grey.
///
/// # Units   those of the values; texts are markup (see [`super::Label`])
#[derive(Debug, Clone, PartialEq)]
pub struct SeriesFigure {
    /// Line above the panels.
    pub title: String,
    /// Label of the time axis.
    pub time_label: String,
    /// Times, not decreasing.
    pub times: Vec<f64>,
    /// Panels, from top to bottom.
    pub panels: Vec<Panel>,
    /// Lines right below the axes, such as why a value is undefined.
    pub notes: Vec<String>,
    /// Paragraphs below the notes.
    pub caption: Vec<String>,
}

impl Default for SeriesFigure {
    fn default() -> Self {
        Self {
            title: String::new(),
            time_label: "*t*".to_owned(),
            times: Vec::new(),
            panels: Vec::new(),
            notes: Vec::new(),
            caption: Vec::new(),
        }
    }
}

impl SeriesFigure {
    /// Draws the figure for a width.
    ///
    /// # Errors   no time or panel, a number that is not finite, times that decrease, or a curve of another length
    pub fn svg_in(&self, room: Room) -> Result<Svg> {
        self.check()?;
        let margin = |rows: &[Row]| rows.iter().map(|row| row.axes.left_margin()).fold(0.0, f64::max);
        // lower panels may have labels of more lines
        let beside = |rows: &[Row]| margin(rows) + 16.0 + 2.0 * MARGIN;
        let own = self.rows([WIDTH, HEIGHT]);
        let between: f64 = own.iter().skip(1).map(|row| row.legend.height() + GAP).sum();
        let share = |height: f64| room.height().map_or(height, |_| (height - between) / own.len() as f64);
        let first = room.frame([WIDTH, HEIGHT], beside(&own));
        let tight = self.rows([first[0], share(first[1])]);
        let [width, height] = room.frame([WIDTH, HEIGHT], beside(&tight));
        // labels have been broken into lines as far as they can be, between words
        let longest = tight.iter().map(|row| row.axes.label_length()).fold(0.0, f64::max);
        let panel_height = room.height().map_or(height, |_| share(height).max(longest));
        let rows = self.rows([width, panel_height]);
        let margin = margin(&rows);
        let (left, inner) = (MARGIN + margin, margin + width + 16.0);
        let title = Block::title(&self.title, inner);
        let text = Block::caption(self.notes.iter().chain(&self.caption), inner);
        let mut y = MARGIN + title.height() + 4.0;
        let height: f64 = rows.iter().map(|row| row.legend.height() + panel_height + GAP).sum();
        let foot = y + height - GAP + BELOW + 8.0;
        let mut svg =
            Svg::in_room(room, (inner + 2.0 * MARGIN).ceil(), (foot + text.height() + MARGIN - 6.0).ceil());
        title.draw(&mut svg, [MARGIN, MARGIN]);
        for (mut row, panel) in rows.into_iter().zip(&self.panels) {
            row.legend.draw(&mut svg, [left, y]);
            y += row.legend.height();
            (row.axes.scale.frame.x, row.axes.scale.frame.y) = (left, y);
            svg.frame(row.axes.scale.frame);
            self.draw_panel(&mut svg, panel, &row.axes, margin);
            y += panel_height + GAP;
        }
        text.draw(&mut svg, [MARGIN, foot]);
        Ok(svg)
    }

    /// The panels with frames of a size.
    fn rows(&self, [w, h]: [f64; 2]) -> Vec<Row> {
        let x = Range::of(self.times.iter().copied()).unwrap_or(Range { min: 0.0, max: 0.0 });
        let x = if x.span() > 0.0 { x } else { x.padded(0.0) };
        let last = self.panels.len().saturating_sub(1);
        let row = |(i, panel): (usize, &Panel)| {
            let values = panel.curves.iter().flat_map(|c| c.values.iter().copied().flatten());
            let y = Range::of(values).unwrap_or(Range { min: 0.0, max: 0.0 }).resolved(panel.least);
            let y = y.padded(0.07);
            let scale = Scale { frame: Rect { x: 0.0, y: 0.0, w, h }, x, y };
            let label = (i == last).then_some(self.time_label.as_str());
            let entry = |c: &Curve| Entry::new(Mark::Line(curve_paint(c)), &c.label);
            let several = panel.curves.len() > 1;
            let entries = if several { panel.curves.iter().map(entry).collect() } else { Vec::new() };
            Row { axes: Axes::new(scale, label, &panel.label), legend: Legend::flowed(entries, w) }
        };
        self.panels.iter().enumerate().map(row).collect()
    }

    fn draw_panel(&self, svg: &mut Svg, panel: &Panel, axes: &Axes, margin: f64) {
        self.draw_gaps(svg, panel, axes);
        axes.draw_grid(svg);
        svg.clipped(axes.scale.frame, |svg| {
            for curve in &panel.curves {
                for piece in self.pieces(curve, &axes.scale) {
                    draw_piece(svg, &piece, curve);
                }
            }
        });
        axes.draw_with_margin(svg, margin);
    }

    /// Grey ground from the last defined time before a gap to the first one after it.
    fn draw_gaps(&self, svg: &mut Svg, panel: &Panel, axes: &Axes) {
        let (scale, end) = (&axes.scale, self.times.len());
        let defined = |i: &usize| panel.curves.iter().any(|c| c.values[*i].is_some());
        let mut from = 0;
        while from < end {
            let gap = (from..end).find(|i| !defined(i));
            let Some(first) = gap else { break };
            let last = (first..end).find(defined).unwrap_or(end);
            let x = |i: usize| scale.map([self.times[i], 0.0])[0];
            let (left, right) = (x(first.saturating_sub(1)), x(last.min(end - 1)));
            svg.rect(Rect { x: left, w: right - left, ..scale.frame }, &Paint::fill(PALE));
            from = last;
        }
    }

    /// The unbroken pieces of a curve, in pixels, decimated.
    fn pieces(&self, curve: &Curve, scale: &Scale) -> Vec<Vec<Point>> {
        let pairs: Vec<_> = self.times.iter().zip(&curve.values).collect();
        let pieces = pairs.split(|(_, value)| value.is_none()).filter(|piece| !piece.is_empty());
        let pixel = |(t, value): &(&f64, &Option<f64>)| value.map(|v| scale.map([**t, v]));
        pieces.map(|piece| simplify(&piece.iter().filter_map(pixel).collect::<Vec<_>>(), 0.15)).collect()
    }

    fn check(&self) -> Result<()> {
        if self.times.is_empty() {
            return Err(FigureError::Empty { what: "list of times" });
        }
        if self.panels.is_empty() {
            return Err(FigureError::Empty { what: "list of panels" });
        }
        check_finite("time", self.times.iter().copied())?;
        if let Some(i) = self.times.windows(2).position(|w| w[1] < w[0]) {
            return Err(FigureError::Unsorted { what: "time", index: i + 1 });
        }
        for curve in self.panels.iter().flat_map(|panel| &panel.curves) {
            let (expected, got) = (self.times.len(), curve.values.len());
            if expected != got {
                return Err(FigureError::Shape { what: format!("curve '{}'", curve.label), expected, got });
            }
            check_finite("curve value", curve.values.iter().copied().flatten())?;
        }
        Ok(())
    }

    /// A row per time, a column per curve.
    fn csv(&self) -> String {
        let curves =
            || self.panels.iter().flat_map(|panel| panel.curves.iter().map(move |curve| (panel, curve)));
        let name = |(panel, curve): (&Panel, &Curve)| match (curve.label.as_str(), panel.label.as_str()) {
            ("", panel) => panel.to_owned(),
            (curve, "") => curve.to_owned(),
            (curve, panel) => format!("{panel}: {curve}"),
        };
        let mut csv = Csv::new([self.time_label.clone()].into_iter().chain(curves().map(name)));
        for (row, t) in self.times.iter().enumerate() {
            csv.row(&[], [Some(*t)].into_iter().chain(curves().map(|(_, curve)| curve.values[row])));
        }
        csv.finish()
    }
}

figure!(SeriesFigure);

/// A panel's axes and legend before they are placed.
struct Row {
    axes: Axes,
    legend: Legend,
}

fn curve_paint(curve: &Curve) -> Paint {
    Paint::stroke(curve.colour, 1.4)
}

/// A single value between gaps is a dot.
fn draw_piece(svg: &mut Svg, piece: &[Point], curve: &Curve) {
    match piece {
        [one] => svg.circle(*one, 1.8, &Paint::fill(curve.colour)),
        many => svg.polyline(many, false, &curve_paint(curve)),
    }
}
